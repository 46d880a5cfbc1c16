#include "courant/integrators/integrator_laws.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>

#include "courant/core/rank_decision.hpp"
#include "courant/integrators/order_measurement.hpp"
#include "courant/integrators/step_energies.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/structures/dirac_interconnection.hpp"
#include "courant/structures/system_in_units.hpp"

namespace courant {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A symplectic form is preserved to about ten digits where it is preserved: differences of order 4
// know differentials no better.
constexpr double kSymplectic = 1e-8;
constexpr double kSameDifferential = 1e-7;
// Two ways to the same state: they differ by what Newton's method leaves and by round-off.
constexpr double kSame = 1e-9;
// What round-off leaves of a balance of energies.
constexpr double kEnergy = 1e-12;
// The order may be off by so much.
constexpr double kOrder = 0.15;

// An order is one of short steps: those of the setting may be too long for it where a system is stiff, and such a
// system may not go back by more than its shortest time. Such parts of the step are tried.
constexpr double kShorter[] = {0.125, 0.125 / 8, 0.125 / 64, 0.125 / 512, 0.125 / 4096};
// And it is one of errors above round-off: where those of the setting are that, such multiples are.
constexpr double kLonger[] = {8.0, 64.0};

class IntegratorLaws {
 public:
  IntegratorLaws(const Integrator& integrator, const IntegratorSetting& setting,
                 const IntegratorLawOptions& options)
      : integrator_(integrator),
        setting_(setting),
        options_(options),
        M_(*setting.system->manifold()),
        units_(integrator.units()),
        scale_(std::max(in_units(setting.initial.x).norm(), 1e-300)),
        orders_(integrator, setting.initial,
                [this](const State& a, const State& b) { return separation(a, b); }) {}

  IntegratorReport run() {
    attempt([&] { return gather_states(); });
    report_.order = finite(attempt([&] { return orders_.errors(setting_.step).order; }));
    report_.asymmetry = attempt([&] { return asymmetry(); });
    order_law();
    symmetry_law();
    symplecticity_laws();
    restart_law();
    backward_law();
    failure_law();
    empty_law();
    time_law();
    energy_law();
    differential_law();
    return std::move(report_);
  }

 private:
  LawMeasurement law(const std::string& text, double bound) const {
    return LawMeasurement(integrator_.name() + " on " + M_.name(), text, bound);
  }
  void add(const LawMeasurement& measured) { report_.laws.push_back(measured.result()); }
  std::string where() const { return describe("x", setting_.initial.x); }

  static std::optional<double> attempt(const std::function<double()>& measure) {
    try {
      return measure();
    } catch (const std::exception&) {
      return std::nullopt;
    }
  }
  static std::optional<double> finite(std::optional<double> value) {
    return value && std::isfinite(*value) ? value : std::nullopt;
  }

  // The state after so many steps of h by one stepper.
  State advanced(const State& from, double h, int steps) const {
    return integrator_.advance(from, h, steps);
  }
  double separation(const State& a, const State& b) const {
    const double apart = units_ ? in_units(a.x - b.x).norm() : M_.separation(a.x, b.x);
    return apart / scale_;
  }

  // Numbers of steps that are made in other units are compared in those.
  VectorXd in_units(const VectorXd& x) const {
    return units_ ? VectorXd(x.cwiseQuotient(units_->coordinates)) : x;
  }

  double gather_states() {
    const auto stepper = integrator_.stepper();
    State state = setting_.initial;
    for (int i = 0; i < 4; ++i) {
      stepper->step(state, setting_.step);
      report_.states.push_back(state.x);
      // A system that starts at zero has the size of where it goes.
      if (setting_.initial.x.isZero(0.0)) scale_ = std::max(scale_, in_units(state.x).norm());
    }
    return 0.0;
  }

  double asymmetry() const {
    const State there = advanced(setting_.initial, setting_.step, 1);
    return separation(advanced(there, -setting_.step, 1), setting_.initial);
  }

  // The order measured with h next to the claim. With other steps than that of the setting it has to be
  // the claim: on the way to short ones it may be any. Infinite, which is exact, is a defect there, where
  // it may be round-off, and of both_ways, where what is measured is to be seen.
  double order_defect(double h, bool is_other) {
    if (M_.dimension() == 0 || setting_.is_gauge) return 0.0;
    const double order = orders_.errors(h).order;
    const bool is_exactly = options_.both_ways || is_other;
    if (std::isinf(order)) return is_exactly ? kInfinity : 0.0;
    const double low = integrator_.order() - order;
    return is_exactly ? std::abs(low) : std::max(0.0, low);
  }

  // Whether the order with the setting's step is.
  bool is_hidden_by_round_off() {
    try {
      return orders_.errors(setting_.step).are_round_off;
    } catch (const std::exception&) {
      return false;
    }
  }

  // The first of defect(h, is_other) that is none, or else the least: with the setting's step, and other
  // ones. Throws what the first one throws, if all do.
  template <class Defect>
  double with_other_steps(const Defect& defect) {
    double least = kInfinity;
    std::exception_ptr failure;
    bool is_measured = false;
    const auto try_step = [&](double h, bool is_other) {
      try {
        least = std::min(least, defect(h, is_other));
        is_measured = true;
      } catch (const std::exception&) {
        if (!failure) failure = std::current_exception();
      }
    };
    const double h = setting_.step;
    try_step(h, false);
    for (const double part : kShorter)
      if (!(least <= kOrder)) try_step(part * h, true);
    if (!(least <= kOrder) && is_hidden_by_round_off())
      for (const double multiple : kLonger)
        if (!(least <= kOrder)) try_step(multiple * h, true);
    if (!is_measured) std::rethrow_exception(failure);
    return least;
  }

  void order_law() {
    auto measured = law("P1 measured order is order() = " + std::to_string(integrator_.order()) +
                            (options_.both_ways ? "" : " or more"),
                        kOrder);
    measured.add(
        [&] {
          return with_other_steps([&](double h, bool is_other) {
            const double defect = order_defect(h, is_other);
            if (is_other && defect <= kOrder) report_.order = orders_.errors(h).order;
            return defect;
          });
        },
        where());
    add(measured);
  }

  void backward_law() {
    auto measured = law("P6 a step h < 0 goes back in time, with the order claimed", kOrder);
    const auto defect = [&](double h, bool is_other) {
      const State before = advanced(setting_.initial, -h, 1);
      if (!(before.t - setting_.initial.t < 0.0) != (h < 0.0)) return kInfinity;
      // Forward again is where it came from, up to the error of the step.
      const State there = advanced(before, h, 1);
      if (!setting_.is_gauge &&
          separation(there, setting_.initial) > 0.5 * separation(before, setting_.initial) + kSame)
        return kInfinity;
      return order_defect(-h, is_other);
    };
    measured.add([&] { return with_other_steps(defect); }, where());
    add(measured);
  }

  void symmetry_law() {
    if (integrator_.is_symmetric()) {
      auto measured = law("P2 Φ_{-h} ∘ Φ_h = id, as said", kSame);
      measured.add([&] { return asymmetry(); }, where());
      add(measured);
    } else if (options_.both_ways && M_.dimension() > 0) {
      auto measured = law("P2 not symmetric, as said", 0.0);
      measured.add([&] { return std::max(0.0, 1e-9 - asymmetry()); }, where());
      add(measured);
    }
  }

  // One step from the initial point, y = Φ_h(x), with TΦ_h on T M_f: the columns of `image` are the
  // images of those of `tangent`, in the bases of T_xM and T_yM.
  struct Differential {
    VectorXd y;
    MatrixXd tangent, image;
  };
  // That of a step of the setting, which several laws ask for.
  const Differential& differential() {
    if (!differential_) differential_ = differential(setting_.step);
    return *differential_;
  }
  Differential differential(double h) const {
    const VectorXd& x = setting_.initial.x;
    const MatrixXd basis = M_.tangent_basis(x);
    MatrixXd directions = MatrixXd::Identity(basis.cols(), basis.cols());
    if (units_) directions = chart_units(*units_, M_, x).asDiagonal();
    const auto step_from = [&](const VectorXd& from) {
      State start = setting_.initial;
      start.x = from;
      return advanced(start, h, 1).x;
    };
    Differential result;
    result.tangent = directions;
    if (setting_.conormals.rows() > 0)
      result.tangent *= kernel(setting_.conormals * basis * directions, {.data_error = 1e-9});
    result.y = step_from(x);
    const MatrixXd back = M_.tangent_basis(result.y).transpose() * M_.coframe(result.y);
    const double epsilon = 1e-3 * scale_;
    result.image.resize(basis.cols(), result.tangent.cols());
    for (Index k = 0; k < result.tangent.cols(); ++k) {
      const VectorXd direction = basis * result.tangent.col(k);
      const auto at = [&](double s) {
        return step_from(M_.retract(x, VectorXd(s * epsilon * direction)));
      };
      const VectorXd velocity =
          (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * epsilon);
      result.image.col(k) = back * velocity;
    }
    return result;
  }

  // The same by the method's own StepDifferential.
  MatrixXd exact_image(const StepDifferential& differential, const MatrixXd& tangent) const {
    const auto stepper = integrator_.stepper();
    stepper->tell_parts();
    State state = setting_.initial;
    stepper->step(state, setting_.step);
    const VectorXd& x = setting_.initial.x;
    const MatrixXd directions = M_.frame(x) * (M_.tangent_basis(x) * tangent);
    return M_.tangent_basis(state.x).matrix().transpose() *
           (M_.coframe(state.x) * differential(stepper->last(), directions));
  }

  void differential_law() {
    if (setting_.is_gauge || M_.dimension() == 0 || !options_.both_ways) return;
    auto measured = law("P11 the differential is that of the steps", kSameDifferential);
    measured.add(
        [&] {
          const auto exact = integrator_.differential();
          if (!exact) return 0.0;
          const Differential& step = differential();
          const MatrixXd image = exact_image(*exact, step.tangent);
          return (image - step.image).norm() / std::max(image.norm(), 1e-300);
        },
        where());
    add(measured);
  }

  // ω_D at x as a matrix in the basis of T_xM.
  MatrixXd form_at(const VectorXd& x) const {
    const auto [F, omega] = setting_.structure->linear(x).form();
    return F * omega * F.transpose();
  }

  double symplecticity_defect(const Differential& step) const {
    const auto& [y, tangent, image] = step;
    const MatrixXd before = tangent.transpose() * form_at(setting_.initial.x) * tangent;
    const MatrixXd after = image.transpose() * form_at(y) * image;
    if (before.size() == 0 || before.norm() == 0.0)
      throw std::domain_error("the form vanishes on the constraint set");
    return (after - before).norm() / before.norm();
  }

  double preservation_defect(const Differential& step) const {
    const auto& [y, tangent, image] = step;
    const DiracStructure& D = *setting_.structure;
    return distance(forward_image(image * tangent.transpose(), D.linear(setting_.initial.x)),
                    D.linear(y));
  }

  // The structure is the graph of a symplectic form.
  bool has_form() const {
    const Index n = M_.dimension();
    if (!setting_.structure || n == 0) return false;
    const PairedSubspace D = setting_.structure->fibre(setting_.initial.x);
    return D.is_dirac() && D.vector_range().cols() == n && D.covector_range().cols() == n;
  }

  void symplecticity_laws() {
    const bool claimed = integrator_.is_symplectic().value_or(false);
    const Differential* step = nullptr;
    attempt([&] {
      step = &differential();
      return 0.0;
    });
    if (step && has_form())
      report_.symplecticity = attempt([&] { return symplecticity_defect(*step); });
    // The distance of two structures means nothing where numbers are far apart.
    if (step && setting_.structure && setting_.conormals.rows() == 0 && !units_)
      report_.preservation = attempt([&] { return preservation_defect(*step); });
    if (!claimed) return;
    auto symplectic = law("P3 Φ_h*ω = ω, as said", kSymplectic);
    if (report_.symplecticity)
      symplectic.add(*report_.symplecticity, where());
    else if (M_.dimension() == 0)
      symplectic.add(0.0, where());
    else
      symplectic.add(kInfinity, where() + ": no symplectic form, or no step, to measure it with");
    add(symplectic);
    if (!report_.preservation) return;
    auto preserves = law("P4 Φ_h preserves D, as said", kSymplectic);
    preserves.add(*report_.preservation, where());
    add(preserves);
  }

  void restart_law() {
    auto measured = law("P5 going on is the same as starting again from the state", kSame);
    if (setting_.is_gauge) return;
    measured.add(
        [&] {
          const auto stepper = integrator_.stepper();
          State state = setting_.initial;
          double worst = 0.0;
          for (int i = 0; i < 20; ++i) {
            const State again = advanced(state, setting_.step, 1);
            stepper->step(state, setting_.step);
            worst = std::max(worst, separation(again, state));
          }
          return worst;
        },
        where());
    add(measured);
  }

  // With steps that grow until one fails; nothing fails for a method that can make any step.
  void failure_law() {
    auto measured = law("P7 a step that fails throws SolveError and leaves no trace", 0.0);
    for (const double factor : {1e3, 1e8, 1e150}) {
      measured.add(
          [&] {
            const auto stepper = integrator_.stepper();
            State state = setting_.initial;
            const State before = state;
            for (int attempts = 0; attempts < 2; ++attempts) {
              try {
                stepper->step(state, factor * setting_.step);
              } catch (const SolveError&) {
                if (!(state == before)) return kInfinity;
                State next = state;
                stepper->step(next, setting_.step);
                if (setting_.is_gauge) continue;
                const State again = advanced(before, setting_.step, 1);
                if (!(separation(next, again) <= kSame)) return kInfinity;
                continue;
              }
              return is_finite(state) ? 0.0 : kInfinity;
            }
            return 0.0;
          },
          "a step " + describe("h", VectorXd::Constant(1, factor * setting_.step)));
    }
    add(measured);
  }

  void empty_law() {
    if (setting_.is_gauge || !options_.both_ways) return;
    auto measured = law("P8 v and z of the initial state may be empty", kSame);
    measured.add(
        [&] {
          State bare = setting_.initial;
          bare.v.resize(0);
          bare.z.resize(0);
          return separation(advanced(bare, setting_.step, 1),
                            advanced(setting_.initial, setting_.step, 1));
        },
        where());
    add(measured);
  }

  void time_law() {
    auto measured = law("P9 the time after k steps is t₀ + k h, and k are counted", 1e-14);
    measured.add(
        [&] {
          const auto stepper = integrator_.stepper();
          State state = setting_.initial;
          double worst = 0.0;
          for (int k = 1; k <= 10; ++k) {
            stepper->step(state, setting_.step);
            const double t = setting_.initial.t + k * setting_.step;
            worst = std::max(worst, std::abs(state.t - t) / (1.0 + std::abs(t)));
            if (stepper->statistics().steps != k) return kInfinity;
          }
          return worst;
        },
        where());
    add(measured);
  }

  // Next to the greatest energies that take part in a step: H at both ends and what moves.
  double imbalance(double h) const {
    const auto system = std::dynamic_pointer_cast<const EnergySystem>(setting_.system);
    if (!system || !system->has_explicit_energy())
      throw std::domain_error("the system has no energy that is a function on M");
    const StepEnergies energies(system);
    const auto stepper = integrator_.stepper();
    stepper->tell_parts();
    State state = setting_.initial;
    stepper->prepare(state, h);
    // Multipliers do not count in H.
    const auto H = [&](State at) {
      at.z.setZero();
      return energies.energy(at);
    };
    double worst = 0.0, size = 0.0;
    // Back in time a system with losses does not go far.
    const int steps = h * setting_.step > 0.0 ? 20 : 5;
    for (int k = 0; k < steps; ++k) {
      stepper->step(state, h);
      const Step& step = stepper->last();
      const StepEnergies::Energies through = energies(step);
      const double before = H(step.before), after = H(step.after);
      size = std::max(size, std::abs(before) + std::abs(after) + through.moved);
      const double defect = std::abs(after - before - through.supply() + through.loss());
      if (!(defect <= worst)) worst = defect;
    }
    return size > 0.0 ? worst / size : worst;
  }

  void energy_law() {
    report_.imbalance = attempt([&] { return imbalance(setting_.step); });
    if (!integrator_.has_exact_energy()) return;
    auto measured =
        law("P10 H changes by what is supplied less what is dissipated, as said", kEnergy);
    for (const double factor : {1.0, -0.1, 1e-3})
      measured.add([&] { return imbalance(factor * setting_.step); },
                   "steps of " + describe("h", VectorXd::Constant(1, factor * setting_.step)));
    add(measured);
  }

  const Integrator& integrator_;
  const IntegratorSetting& setting_;
  const IntegratorLawOptions& options_;
  const Manifold& M_;
  const Units* units_;  // in which numbers are compared, or null
  double scale_;
  IntegratorReport report_;
  OrderMeasurement orders_;
  std::optional<Differential> differential_;
};

}  // namespace

IntegratorReport check_integrator(const Integrator& integrator, const IntegratorSetting& setting,
                                  const IntegratorLawOptions& options) {
  return IntegratorLaws(integrator, setting, options).run();
}

}  // namespace courant
