#include "courant/extensions/spice/netlist_operating_point.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "courant/core/linear/sparse_lu.hpp"
#include "courant/core/numbers/as_size.hpp"
#include "courant/structures/kirchhoff.hpp"

namespace courant::netlist {
namespace {

using StaticKind = StaticElement::Kind;

constexpr double kHoldingResistance = 1e-10;

// A row of the equations that says what is open otherwise: a sum over elements that is 0, of the
// charges of capacitors or the fluxes of inductors.
struct Balance {
  std::size_t element;                              // whose row it is
  std::vector<std::pair<std::size_t, double>> sum;  // elements with their signs
};

class StaticEquations {
 public:
  explicit StaticEquations(const StaticCircuit& circuit) : circuit_(circuit) {
    balance_.assign(circuit.elements.size(), -1);
    find_balances();
    unknown_.assign(circuit.elements.size(), -1);
    size_ = static_cast<Index>(circuit.nodes) - 1;
    for (std::size_t k = 0; k < circuit.elements.size(); ++k) {
      const StaticKind kind = circuit.elements[k].kind;
      if (kind == StaticKind::voltage || kind == StaticKind::inductor || balance_of(k))
        unknown_[k] = size_++;
    }
    first_held_ = size_;
    first_guessed_ = first_held_ + static_cast<Index>(circuit.held.size());
    size_ = first_guessed_ + static_cast<Index>(circuit.guessed.size());
    y_ = VectorXd::Zero(size_);
    at_ = VectorXd::Zero(static_cast<Index>(circuit.elements.size()));
  }

  std::variant<OperatingPoint, NoOperatingPoint> solve() {
    is_guessing_ = !circuit_.guessed.empty();
    if (is_guessing_ && !newton(0.0, 1.0)) go_to_zero();
    is_guessing_ = false;
    if (!(newton(0.0, 1.0) || by_conductances() || by_sources()))
      return NoOperatingPoint{"no operating point was found", {}};
    const OperatingPoint point = result();
    const double largest = std::max(point.current.cwiseAbs().maxCoeff(), 1e-12);
    for (const Balance& balance : balances_) {
      const StaticElement& element = circuit_.elements[balance.element];
      NoOperatingPoint none;
      if (element.kind == StaticKind::inductor) {
        if (std::abs(voltage(element)) <= 1e-9 * std::max(1.0, y_.cwiseAbs().maxCoeff())) continue;
        none.why = "a loop with a direct voltage, which makes its current grow forever";
      } else {
        if (std::abs(y_[unknown_[balance.element]]) <= 1e-9 * largest) continue;
        none.why = "a cut-set with a direct current, which charges the capacitors forever";
      }
      for (const auto& [member, sign] : balance.sum) none.elements.push_back(member);
      return none;
    }
    return point;
  }

 private:
  const Balance* balance_of(std::size_t element) const {
    const Index number = balance_[element];
    return number < 0 ? nullptr : &balances_[as_size(number)];
  }

  // Whether the current of a source of current depends on its own voltage, as that of a switch does.
  bool conducts(const StaticElement& source) const {
    const auto is_own = [&](std::size_t node) {
      return node != 0 && (node == source.from || node == source.to);
    };
    if (source.gain != 0.0 && !source.control &&
        (is_own(source.control_from) || is_own(source.control_to)))
      return true;
    return source.law && std::ranges::any_of(source.law->controls, [&](const auto& control) {
             if (control.element) return false;
             if (!control.junction) return is_own(control.node);
             const StaticElement& junction = circuit_.elements[*control.junction];
             return is_own(junction.from) || is_own(junction.to);
           });
  }

  // Capacitors in a spanning forest that takes all that conducts first: each is in a cut-set of
  // capacitors and sources of current. Inductors outside a forest of sources of voltage and
  // inductors: each closes a loop of them.
  void find_balances() {
    CircuitGraph all(circuit_.nodes), ideal(circuit_.nodes);
    std::vector<std::size_t> of_ideal;
    for (std::size_t k = 0; k < circuit_.elements.size(); ++k) {
      const StaticElement& element = circuit_.elements[k];
      const double weight = element.kind == StaticKind::capacitor                       ? 1.0
                            : element.kind == StaticKind::current && !conducts(element) ? 2.0
                                                                                        : 0.0;
      add_edge(element.from, element.to, CircuitElement{"", weight}, all);
      if (element.kind != StaticKind::voltage && element.kind != StaticKind::inductor) continue;
      add_edge(element.from, element.to,
               CircuitElement{"", element.kind == StaticKind::inductor ? 1.0 : 0.0}, ideal);
      of_ideal.push_back(k);
    }
    for (const StaticCircuit::Held& held : circuit_.held)
      add_edge(held.node, 0, CircuitElement{}, all);
    const auto add = [&](std::size_t element, const SparseMatrixXd& columns, Index column,
                         const auto& number) {
      Balance balance{element, {}};
      for (SparseMatrixXd::InnerIterator it(columns, column); it; ++it) {
        const std::size_t member = number(as_size(it.row()));
        if (member < circuit_.elements.size()) balance.sum.emplace_back(member, it.value());
      }
      balance_[element] = static_cast<Index>(balances_.size());
      balances_.push_back(std::move(balance));
    };
    const Kirchhoff whole(all), sources(ideal);
    const SparseMatrixXd loops = sources.loops();
    std::optional<SparseMatrixXd> cut_sets;  // which may be long, and are seldom asked for
    for (std::size_t k = 0; k < whole.tree().size(); ++k) {
      const std::size_t element = as_size(whole.tree()[k]);
      if (element >= circuit_.elements.size() ||
          circuit_.elements[element].kind != StaticKind::capacitor)
        continue;
      if (!cut_sets) cut_sets = whole.cut_sets();
      add(element, *cut_sets, static_cast<Index>(k), [](std::size_t member) { return member; });
    }
    for (std::size_t k = 0; k < sources.links().size(); ++k) {
      const std::size_t element = of_ideal[as_size(sources.links()[k])];
      if (circuit_.elements[element].kind == StaticKind::inductor)
        add(element, loops, static_cast<Index>(k),
            [&](std::size_t member) { return of_ideal[member]; });
    }
  }

  double potential(std::size_t node) const {
    return node == 0 ? 0.0 : y_[static_cast<Index>(node) - 1];
  }
  double voltage(const StaticElement& element) const {
    return potential(element.from) - potential(element.to);
  }

  // A y = b, the equations at the voltages at_ of the diodes, with a conductance from every node to
  // the ground and beside every diode, and with a part of the sources.
  struct Linear {
    std::vector<Eigen::Triplet<double>> entries;
    VectorXd b;

    void add(Index row, Index column, double value) {
      if (row >= 0 && column >= 0) entries.emplace_back(row, column, value);
    }
    void add(Index row, double value) {
      if (row >= 0) b[row] += value;
    }
  };

  Linear equations(double conductance, double part) const {
    Linear linear{{}, VectorXd::Zero(size_)};
    const auto row_of = [](std::size_t node) { return static_cast<Index>(node) - 1; };
    const auto stamp = [&](const StaticElement& element, double g) {
      const Index from = row_of(element.from), to = row_of(element.to);
      linear.add(from, from, g);
      linear.add(to, to, g);
      linear.add(from, to, -g);
      linear.add(to, from, -g);
    };
    for (Index node = 0; node + 1 < static_cast<Index>(circuit_.nodes); ++node)
      linear.add(node, node, conductance);
    for (std::size_t k = 0; k < circuit_.elements.size(); ++k) {
      const StaticElement& element = circuit_.elements[k];
      const Index from = row_of(element.from), to = row_of(element.to), own = unknown_[k];
      if (own >= 0) {
        linear.add(from, own, 1.0);
        linear.add(to, own, -1.0);
      }
      // Those of a row for sources, with the sign of the voltage in it.
      const auto control = [&](Index row, double factor) {
        if (element.control) {
          linear.add(row, unknown_[*element.control], factor);
        } else if (element.gain != 0.0) {
          linear.add(row, row_of(element.control_from), factor);
          linear.add(row, row_of(element.control_to), -factor);
        }
      };
      // What a law says at y_, for the two rows that it enters with these signs.
      const auto law = [&](Index row, Index other, double sign) {
        if (!element.law) return;
        const auto [value, gradient] = value_of(*element.law);
        double rest = value;
        const auto add = [&](Index column, double slope) {
          linear.add(row, column, sign * slope);
          linear.add(other, column, -sign * slope);
        };
        for (std::size_t c = 0; c < element.law->controls.size(); ++c) {
          const StaticLaw::Control& by = element.law->controls[c];
          const double slope = gradient[static_cast<Index>(c)];
          if (by.junction) {
            const StaticElement& junction = circuit_.elements[*by.junction];
            add(row_of(junction.from), slope);
            add(row_of(junction.to), -slope);
          } else {
            add(column_of(by), slope);
          }
          rest -= slope * value_of(by);
        }
        linear.add(row, -sign * rest);
        linear.add(other, sign * rest);
      };
      switch (element.kind) {
        case StaticKind::resistor:
          stamp(element, 1.0 / element.value);
          break;
        case StaticKind::current:
          control(from, element.gain);
          control(to, -element.gain);
          linear.add(from, -part * element.value);
          linear.add(to, part * element.value);
          law(from, to, 1.0);
          break;
        case StaticKind::diode: {
          const double v = at_[static_cast<Index>(k)];
          const double power = element.value * std::exp(v / element.scale);
          const double reverse = breakdown_current(element, v);
          const double g = (power + reverse) / element.scale + element.leak + conductance;
          const double offset =
              power - element.value - reverse - (power + reverse) / element.scale * v;
          stamp(element, g);
          linear.add(from, -offset);
          linear.add(to, offset);
          break;
        }
        case StaticKind::voltage:
          linear.add(own, from, 1.0);
          linear.add(own, to, -1.0);
          control(own, -element.gain);
          linear.add(own, part * element.value);
          law(own, -1, -1.0);
          break;
        case StaticKind::inductor:
        case StaticKind::capacitor:
          if (const Balance* balance = balance_of(k)) {
            add_balance(linear, own, *balance);
          } else if (element.kind == StaticKind::inductor) {
            linear.add(own, from, 1.0);
            linear.add(own, to, -1.0);
          }
          break;
      }
    }
    const auto hold = [&](const StaticCircuit::Held& held, Index own) {
      const Index node = row_of(held.node);
      linear.add(node, own, 1.0);
      linear.add(own, node, 1.0);
      linear.add(own, own, -kHoldingResistance);
      linear.add(own, part * held.potential);
    };
    for (std::size_t k = 0; k < circuit_.held.size(); ++k)
      hold(circuit_.held[k], first_held_ + static_cast<Index>(k));
    for (std::size_t k = 0; k < circuit_.guessed.size(); ++k) {
      const Index own = first_guessed_ + static_cast<Index>(k);
      if (is_guessing_)
        hold(circuit_.guessed[k], own);
      else
        linear.add(own, own, 1.0);  // no current
    }
    return linear;
  }

  void add_balance(Linear& linear, Index row, const Balance& balance) const {
    const double unit = circuit_.elements[balance.element].value;  // so that entries are near 1
    for (const auto& [member, sign] : balance.sum) {
      const StaticElement& element = circuit_.elements[member];
      const double factor = sign * element.value / unit;
      if (element.kind == StaticKind::capacitor) {
        linear.add(row, static_cast<Index>(element.from) - 1, factor);
        linear.add(row, static_cast<Index>(element.to) - 1, -factor);
      } else if (element.kind == StaticKind::inductor) {
        linear.add(row, unknown_[member], factor);
        for (const StaticCircuit::Coupling& coupling : circuit_.couplings)
          if (coupling.first == member || coupling.second == member)
            linear.add(row, unknown_[coupling.first == member ? coupling.second : coupling.first],
                       sign * coupling.mutual / unit);
      }
    }
  }

  // One step: y from the equations at at_. False if they determine none.
  bool step(double conductance, double part) {
    if (size_ == 0) return true;
    const Linear linear = equations(conductance, part);
    if (!linear.b.allFinite()) return false;
    SparseLu::Matrix A(size_, size_);
    A.setFromTriplets(linear.entries.begin(), linear.entries.end());
    A.makeCompressed();
    // Rows in their own units: conductances of 1e-12 S stand beside voltages.
    VectorXd largest = VectorXd::Zero(size_);
    for (Index column = 0; column < size_; ++column)
      for (SparseLu::Matrix::InnerIterator it(A, column); it; ++it)
        largest[it.row()] = std::max(largest[it.row()], std::abs(it.value()));
    if (!(largest.minCoeff() > 0.0) || !largest.allFinite()) return false;
    const SparseLu::Matrix scaled = largest.cwiseInverse().asDiagonal() * A;
    const VectorXd b = linear.b.cwiseQuotient(largest);
    SparseLu factors(scaled);
    if (!factors.factorize(scaled)) return false;
    VectorXd y = b;
    factors.solve(y.data());
    VectorXd rest = b - scaled * y;
    factors.solve(rest.data());
    y += rest;
    // A singular matrix that round-off made regular.
    const double size = y.cwiseAbs().maxCoeff();
    if (!y.allFinite() || size > 1e15 || rest.cwiseAbs().maxCoeff() > 1e-3 * size) return false;
    y_ = y;
    return true;
  }

  static double breakdown_current(const StaticElement& diode, double v) {
    return diode.breakdown > 0.0
               ? diode.breakdown * std::exp(-(v + diode.breakdown_voltage) / diode.scale)
               : 0.0;
  }

  Index column_of(const StaticLaw::Control& control) const {
    return control.element ? unknown_[*control.element] : static_cast<Index>(control.node) - 1;
  }
  // At y_.
  std::pair<double, VectorXd> value_of(const StaticLaw& law) const {
    VectorXd u(static_cast<Index>(law.controls.size()));
    for (Index c = 0; c < u.size(); ++c) u[c] = value_of(law.controls[as_size(c)]);
    return law.value(u);
  }
  double value_of(const StaticLaw::Control& control) const {
    if (control.junction) return at_[static_cast<Index>(*control.junction)];
    const Index column = column_of(control);
    return column < 0 ? 0.0 : y_[column];
  }

  // The next voltage of a diode on the way to v: that of SPICE, which grows no faster than the
  // logarithm of the current; in breakdown too.
  static double limited(const StaticElement& diode, double v, double last) {
    if (diode.breakdown > 0.0 && v < std::min(0.0, -diode.breakdown_voltage + 10.0 * diode.scale)) {
      StaticElement mirror = diode;
      mirror.breakdown = 0.0;
      mirror.value = diode.breakdown;
      return -diode.breakdown_voltage -
             limited(mirror, -(v + diode.breakdown_voltage), -(last + diode.breakdown_voltage));
    }
    const double s = diode.scale, critical = s * std::log(s / (std::sqrt(2.0) * diode.value));
    if (v <= critical || std::abs(v - last) <= 2.0 * s) return v;
    if (last <= 0.0) return s * std::log(std::max(v / s, 1.0));
    const double ratio = 1.0 + (v - last) / s;
    return ratio > 0.0 ? last + s * std::log(ratio) : critical;
  }

  bool newton(double conductance, double part) {
    constexpr int most = 200, polish = 2;
    int settled = 0;
    for (int i = 0; i < most; ++i) {
      const VectorXd last = y_;
      if (!step(conductance, part)) return false;
      double change = 0.0;  // of diodes, in units of their own
      for (std::size_t k = 0; k < circuit_.elements.size(); ++k) {
        const StaticElement& element = circuit_.elements[k];
        if (element.kind != StaticKind::diode) continue;
        double& at = at_[static_cast<Index>(k)];
        const double v = voltage(element), next = limited(element, v, at);
        change = std::max(change, std::abs(v - at) / (element.scale + std::abs(v)));
        at = next;
      }
      // Three such steps in a row end at round-off, since each squares the error. Round-off itself
      // may be 1e-6 of a diode's unit: where its conductance of 1e-12 S is beside resistors.
      const bool small =
          change <= 1e-4 && (y_ - last).cwiseAbs().maxCoeff() <= 1e-6 * y_.cwiseAbs().maxCoeff();
      settled = small ? settled + 1 : 0;
      if (settled > polish) return true;
    }
    return false;
  }

  struct Place {
    VectorXd y, at;
  };
  Place place() const { return {y_, at_}; }
  void go_to(const Place& place) {
    y_ = place.y;
    at_ = place.at;
  }
  void go_to_zero() { go_to({VectorXd::Zero(y_.size()), VectorXd::Zero(at_.size())}); }

  bool by_conductances() {
    go_to_zero();
    double conductance = 0.1, factor = 10.0;
    if (!newton(conductance, 1.0)) return false;
    Place last = place();
    while (conductance > 1e-14) {
      if (newton(conductance / factor, 1.0)) {
        conductance /= factor;
        last = place();
        factor = std::min(10.0, factor * factor);
      } else {
        go_to(last);
        factor = std::sqrt(factor);
        if (factor < 1.0001) return false;
      }
    }
    return newton(0.0, 1.0);
  }

  bool by_sources() {
    go_to_zero();
    double part = 0.0, more = 0.1;
    Place last = place();
    while (part < 1.0) {
      const double next = std::min(1.0, part + more);
      if (newton(0.0, next)) {
        part = next;
        last = place();
        more *= 2.0;
      } else {
        go_to(last);
        more /= 4.0;
        if (more < 1e-6) return false;
      }
    }
    return true;
  }

  OperatingPoint result() const {
    OperatingPoint point{VectorXd::Zero(static_cast<Index>(circuit_.nodes)),
                         VectorXd::Zero(static_cast<Index>(circuit_.elements.size()))};
    for (std::size_t node = 1; node < circuit_.nodes; ++node)
      point.potential[static_cast<Index>(node)] = potential(node);
    for (std::size_t k = 0; k < circuit_.elements.size(); ++k) {
      const StaticElement& element = circuit_.elements[k];
      double& current = point.current[static_cast<Index>(k)];
      const double v = voltage(element);
      if (element.kind == StaticKind::resistor)
        current = v / element.value;
      else if (element.kind == StaticKind::diode)
        current = element.value * std::expm1(v / element.scale) + element.leak * v -
                  breakdown_current(element, v);
      else if (element.kind == StaticKind::current)
        current = element.value +
                  element.gain * (element.control ? y_[unknown_[*element.control]]
                                                  : potential(element.control_from) -
                                                        potential(element.control_to)) +
                  (element.law ? value_of(*element.law).first : 0.0);
      else if (element.kind != StaticKind::capacitor)
        current = y_[unknown_[k]];
    }
    return point;
  }

  const StaticCircuit& circuit_;
  std::vector<Balance> balances_;
  std::vector<Index> balance_;  // of each element: its number, or -1
  std::vector<Index> unknown_;  // of each element: that of its current, or -1
  Index size_ = 0, first_held_ = 0, first_guessed_ = 0;
  bool is_guessing_ = false;
  VectorXd y_;   // potentials but that of the ground, then currents
  VectorXd at_;  // of each element: where a diode is linearised
};

}  // namespace

std::variant<OperatingPoint, NoOperatingPoint> operating_point(const StaticCircuit& circuit) {
  return StaticEquations(circuit).solve();
}

}  // namespace courant::netlist
