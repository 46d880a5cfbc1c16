#include "courant/structures/interconnection.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/words/message.hpp"
#include "courant/manifolds/product.hpp"

namespace courant {
namespace {

// Of products of entries of F and E, what is round-off.
constexpr double kRoundOff = 1e-12;

MatrixXd differences(Index p) {
  MatrixXd A = MatrixXd::Zero(p, p);
  for (Index i = 0; i + 1 < p; ++i) {
    A(i, i) = 1.0;
    A(i, i + 1) = -1.0;
  }
  return A;
}

MatrixXd sum(Index p) {
  MatrixXd A = MatrixXd::Zero(p, p);
  A.row(p - 1).setOnes();
  return A;
}

// "u_motor" of the part "circuit" is "u_circuit_motor", "u[1]" is "u_circuit[1]"; what is no input begins
// with the part.
std::string name_in_whole(const std::string& part, const std::string& unknown, bool is_input) {
  const bool is_named = is_input && unknown.starts_with("u");
  return is_named ? "u_" + part + unknown.substr(1) : part + "_" + unknown;
}

}  // namespace

Joint::Joint(std::vector<Index> ports, MatrixXd F, MatrixXd E)
    : ports_(std::move(ports)), F_(std::move(F)), E_(std::move(E)) {
  const Index p = std::ssize(ports_);
  if (F_.rows() != p || F_.cols() != p || E_.rows() != p || E_.cols() != p)
    throw std::invalid_argument("Joint: F is " + size_text(F_.rows(), F_.cols()) + " and E " +
                                size_text(E_.rows(), E_.cols()) + "; expected both " +
                                size_text(p, p) + " for the ports.");
  if (std::set<Index>(ports_.begin(), ports_.end()).size() != ports_.size())
    throw std::invalid_argument("Joint: a port is there twice; expected each once.");
  if (p == 0) return;
  MatrixXd both(p, 2 * p);
  both << F_, E_;
  const MatrixXd power = F_ * E_.transpose();
  const double size = both.rowwise().norm().maxCoeff();
  if (!((power + power.transpose()).cwiseAbs().maxCoeff() <= kRoundOff * size * size))
    throw std::invalid_argument(
        "Joint: F Eᵀ + E Fᵀ is not zero, so the joint makes or takes power; expected a Dirac "
        "structure.");
  if (decide_rank(both).rank < p)
    throw std::invalid_argument(
        "Joint: the equations F u + E y = 0 depend on each other; expected " + std::to_string(p) +
        " independent ones.");
}

Joint Joint::shared_input(std::vector<Index> ports) {
  const Index p = std::ssize(ports);
  return Joint(std::move(ports), differences(p), sum(p));
}

Joint Joint::shared_output(std::vector<Index> ports) {
  const Index p = std::ssize(ports);
  return Joint(std::move(ports), sum(p), differences(p));
}

Joint Joint::gyrator(std::vector<Index> ports, const MatrixXd& K) {
  const Index p = std::ssize(ports);
  return Joint(std::move(ports), MatrixXd::Identity(p, p), -K);
}

Joint Joint::source(Index port, Source s) {
  Joint joint({port}, MatrixXd::Identity(1, 1), MatrixXd::Zero(1, 1));
  joint.source_ = std::move(s);
  return joint;
}

ExprVector Joint::equations(const Expr& t, const ExprVector& u, const ExprVector& y) const {
  ExprVector all = constants(F_) * u(ports_) + constants(E_) * y(ports_);
  if (source_) all[0] -= source_(t, y);
  return all;
}

// Offsets, one more than there are parts.
struct Interconnection::Layout {
  std::shared_ptr<const Product> manifold;
  std::vector<Index> unknown{0}, port{0};
  std::vector<Index> inputs;     // in the unknowns of the whole
  std::vector<bool> is_joined;   // of each port
  std::vector<Index> equations;  // of each part, without those of its ports

  Layout(const std::vector<Part>& parts, const std::vector<Joint>& joints) {
    std::vector<std::shared_ptr<const Manifold>> factors;
    std::vector<bool> is_free;
    for (const Part& part : parts) {
      if (!part.system)
        throw std::invalid_argument("Interconnection: a system is missing; expected each.");
      const PortSystem& system = *part.system;
      factors.push_back(system.manifold());
      for (const Index input : system.inputs()) inputs.push_back(unknown.back() + input);
      for (Index a = 0; a < system.port_count(); ++a) is_free.push_back(system.is_free(a));
      unknown.push_back(unknown.back() + system.auxiliary_size());
      port.push_back(port.back() + system.port_count());
      equations.push_back(system.equation_count() - system.port_count());
    }
    manifold = std::make_shared<Product>(std::move(factors));
    is_joined.assign(inputs.size(), false);
    for (const Joint& joint : joints)
      for (const Index a : joint.ports()) {
        if (a < 0 || a >= port.back())
          throw std::invalid_argument("Interconnection: there is no port " + std::to_string(a) +
                                      "; expected one of the " + std::to_string(port.back()) +
                                      ", from 0 on.");
        const auto at = static_cast<std::size_t>(a);
        if (is_joined[at] || !is_free[at])
          throw std::invalid_argument("Interconnection: port " + std::to_string(a) +
                                      (is_joined[at]
                                           ? " is joined twice; expected one joint a port."
                                           : " obeys an equation of its system; expected a free "
                                             "one."));
        is_joined[at] = true;
      }
  }

  Index equation_count() const {
    return std::accumulate(equations.begin(), equations.end(), port.back());
  }
  // How many equations of a part come in the first block.
  Index leading(std::size_t part) const {
    return std::min(equations[part], manifold->factors()[part]->tangent_dimension());
  }
  ExprVector unknowns_of(const ExprVector& z, std::size_t part) const {
    return z.segment(unknown[part], unknown[part + 1] - unknown[part]);
  }
  ExprVector ports_of(const ExprVector& u, std::size_t part) const {
    return u.segment(port[part], port[part + 1] - port[part]);
  }

  Names names(const std::vector<Part>& parts, const std::vector<Joint>& joints) const {
    Names all;
    const auto own = [&](std::size_t i, Index equation) {
      return parts[i].name + ": " +
             parts[i].system->names().equations[static_cast<std::size_t>(equation)];
    };
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Names& of = parts[i].system->names();
      for (const std::string& name : of.coordinates)
        all.coordinates.push_back(parts[i].name + "_" + name);
      const std::vector<Index>& its = parts[i].system->inputs();
      for (std::size_t k = 0; k < of.auxiliary.size(); ++k)
        all.auxiliary.push_back(name_in_whole(
            parts[i].name, of.auxiliary[k],
            std::find(its.begin(), its.end(), std::ssize(all.auxiliary) - unknown[i]) !=
                its.end()));
      for (Index k = 0; k < leading(i); ++k) all.equations.push_back(own(i, k));
    }
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (Index k = leading(i); k < equations[i]; ++k) all.equations.push_back(own(i, k));
    const auto first_of_ports = std::ssize(all.equations);
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (Index a = 0; a < port[i + 1] - port[i]; ++a)
        all.equations.push_back(own(i, equations[i] + a));
    for (std::size_t k = 0; k < joints.size(); ++k)
      for (std::size_t a = 0; a < joints[k].ports().size(); ++a)
        all.equations[static_cast<std::size_t>(first_of_ports + joints[k].ports()[a])] =
            "joint " + std::to_string(k) + ", equation " + std::to_string(a);
    return all;
  }
};

Interconnection::Interconnection(std::vector<Part> parts, std::vector<Joint> joints)
    : Interconnection(parts, joints, std::make_shared<const Layout>(parts, joints)) {}

Interconnection::Interconnection(std::vector<Part> parts, std::vector<Joint> joints,
                                 std::shared_ptr<const Layout> layout)
    : PortSystem(layout->manifold, layout->unknown.back(), layout->equation_count(),
                 layout->names(parts, joints), layout->inputs),
      parts_(std::move(parts)),
      joints_(std::move(joints)),
      layout_(std::move(layout)) {}

Interconnection::~Interconnection() = default;

Index Interconnection::tangent_blocks() const {
  return std::all_of(parts_.begin(), parts_.end(),
                     [](const Part& part) { return part.system->tangent_blocks() > 0; });
}

Expr Interconnection::do_generator(const ExprVector& x, const ExprVector& z, const Expr& t) const {
  Expr sum = 0.0;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    sum = sum + parts_[i].system->generator(ExprVector(layout_->manifold->point_part(x, i)),
                                            layout_->unknowns_of(z, i), t);
  return sum;
}

ExprVector Interconnection::do_effort(const ExprVector& x, const ExprVector& z,
                                      const Expr& t) const {
  ExprVector effort(manifold()->tangent_dimension());
  for (std::size_t i = 0; i < parts_.size(); ++i)
    layout_->manifold->tangent_part(effort, i) = parts_[i].system->effort(
        ExprVector(layout_->manifold->point_part(x, i)), layout_->unknowns_of(z, i), t);
  return effort;
}

VectorXd Interconnection::do_auxiliary_guess(const VectorXd& x, const VectorXd& v) const {
  VectorXd guess(auxiliary_size());
  for (std::size_t i = 0; i < parts_.size(); ++i)
    guess.segment(layout_->unknown[i], layout_->unknown[i + 1] - layout_->unknown[i]) =
        parts_[i].system->auxiliary_guess(
            VectorXd(layout_->manifold->point_part(x, i)),
            v.size() == 0 ? v : VectorXd(layout_->manifold->tangent_part(v, i)));
  return guess;
}

bool Interconnection::do_is_free(Index port) const {
  const auto part =
      static_cast<std::size_t>(std::upper_bound(layout_->port.begin(), layout_->port.end(), port) -
                               layout_->port.begin() - 1);
  return !layout_->is_joined[static_cast<std::size_t>(port)] &&
         parts_[part].system->is_free(port - layout_->port[part]);
}

ExprVector Interconnection::do_output(const ExprVector& x, const ExprVector& alpha,
                                      const ExprVector& z) const {
  ExprVector y(port_count());
  for (std::size_t i = 0; i < parts_.size(); ++i)
    y.segment(layout_->port[i], layout_->port[i + 1] - layout_->port[i]) = parts_[i].system->output(
        ExprVector(layout_->manifold->point_part(x, i)),
        ExprVector(layout_->manifold->tangent_part(alpha, i)), layout_->unknowns_of(z, i));
  return y;
}

ExprVector Interconnection::do_inner_equations(const ExprVector& x, const ExprVector& v,
                                               const ExprVector& alpha, const ExprVector& z,
                                               const Expr& t) const {
  ExprVector all(equation_count() - port_count());
  Index first = 0, other = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) other += layout_->leading(i);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Product& M = *layout_->manifold;
    const ExprVector own = parts_[i].system->inner_equations(
        ExprVector(M.point_part(x, i)), ExprVector(M.tangent_part(v, i)),
        ExprVector(M.tangent_part(alpha, i)), layout_->unknowns_of(z, i), t);
    const Index leading = layout_->leading(i), rest = own.size() - leading;
    all.segment(first, leading) = own.head(leading);
    all.segment(other, rest) = own.tail(rest);
    first += leading;
    other += rest;
  }
  return all;
}

ExprVector Interconnection::do_port_equations(const Expr& t, const ExprVector& u,
                                              const ExprVector& y) const {
  ExprVector all(port_count());
  for (std::size_t i = 0; i < parts_.size(); ++i)
    all.segment(layout_->port[i], layout_->port[i + 1] - layout_->port[i]) =
        parts_[i].system->port_equations(t, layout_->ports_of(u, i), layout_->ports_of(y, i));
  for (const Joint& joint : joints_) all(joint.ports()) = joint.equations(t, u, y);
  return all;
}

EnergySystem::Powers Interconnection::do_inner_powers(const ExprVector& x, const ExprVector& v,
                                                      const ExprVector& alpha, const ExprVector& z,
                                                      const Expr& t) const {
  Powers powers;
  const Product& M = *layout_->manifold;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Powers own = parts_[i].system->inner_powers(
        ExprVector(M.point_part(x, i)), ExprVector(M.tangent_part(v, i)),
        ExprVector(M.tangent_part(alpha, i)), layout_->unknowns_of(z, i), t);
    for (const PortPower& power : own.supplied)
      powers.supplied.push_back({parts_[i].name + "_" + power.port, power.power});
    for (const PortPower& power : own.dissipated)
      powers.dissipated.push_back({parts_[i].name + "_" + power.port, power.power});
  }
  return powers;
}

}  // namespace courant
