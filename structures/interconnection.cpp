#include "courant/structures/interconnection.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "courant/core/expr_vectors.hpp"
#include "courant/core/rank_decision.hpp"
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

// Block diagonal, each block of its part of the point.
MatrixField in_blocks(const std::shared_ptr<const Product>& M, std::vector<MatrixField> fields,
                      const std::vector<Index>& rows, const std::vector<Index>& columns) {
  if (std::none_of(fields.begin(), fields.end(), [](const MatrixField& A) { return bool(A); }))
    return {};
  Index height = 0, width = 0;
  for (const Index n : rows) height += n;
  for (const Index n : columns) width += n;
  return [=](const ExprVector& x) {
    ExprMatrix all = ExprMatrix::Zero(height, width);
    Index row = 0, column = 0;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i])
        all.block(row, column, rows[i], columns[i]) = fields[i](ExprVector(M->point_part(x, i)));
      row += rows[i];
      column += columns[i];
    }
    return all;
  };
}

}  // namespace

Joint::Joint(std::vector<Index> ports, MatrixXd F, MatrixXd E)
    : ports_(std::move(ports)), F_(std::move(F)), E_(std::move(E)) {
  const Index p = std::ssize(ports_);
  if (F_.rows() != p || F_.cols() != p || E_.rows() != p || E_.cols() != p)
    throw std::invalid_argument("Joint: F is " + std::to_string(F_.rows()) + " × " +
                                std::to_string(F_.cols()) + " and E " + std::to_string(E_.rows()) +
                                " × " + std::to_string(E_.cols()) + "; expected both " +
                                std::to_string(p) + " × " + std::to_string(p) + " for the ports.");
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

std::shared_ptr<const PortHamiltonianSystem> interconnected(
    const std::vector<std::shared_ptr<const PortHamiltonianSystem>>& systems,
    const std::vector<Joint>& joints, ImplicitSystem::Names names) {
  std::vector<std::shared_ptr<const Manifold>> factors;
  std::vector<MatrixField> J, R, B, D;
  std::vector<Index> sizes, ports, owner;
  for (const auto& system : systems) {
    if (!system) throw std::invalid_argument("interconnected: a system is missing; expected each.");
    const PortHamiltonianSystem::Matrices& of = system->matrices();
    factors.push_back(system->manifold());
    J.push_back(of.J);
    R.push_back(of.R);
    B.push_back(of.B);
    D.push_back(of.D);
    sizes.push_back(system->manifold()->tangent_dimension());
    ports.push_back(of.m);
    owner.insert(owner.end(), static_cast<std::size_t>(of.m), std::ssize(factors) - 1);
  }
  const Index m = std::ssize(owner);
  std::vector<bool> is_joined(static_cast<std::size_t>(m), false);
  for (const Joint& joint : joints)
    for (const Index port : joint.ports()) {
      if (port < 0 || port >= m)
        throw std::invalid_argument("interconnected: there is no port " + std::to_string(port) +
                                    "; expected one of the " + std::to_string(m) + ", from 0 on.");
      const auto at = static_cast<std::size_t>(port);
      if (is_joined[at] || !systems[static_cast<std::size_t>(owner[at])]->is_closed())
        throw std::invalid_argument("interconnected: port " + std::to_string(port) +
                                    (is_joined[at] ? " is joined twice; expected one joint a port."
                                                   : " obeys an equation of its system; expected "
                                                     "a system with closed ports."));
      is_joined[at] = true;
    }
  const auto M = std::make_shared<Product>(factors);
  const auto energy =
      std::make_shared<Hamiltonian>(M, [M, systems](const ExprVector& x, const Expr& t) {
        Expr H = 0.0;
        for (std::size_t i = 0; i < systems.size(); ++i)
          H = H + systems[i]->generator(ExprVector(M->point_part(x, i)), ExprVector(0), t);
        return H;
      });
  const auto relation = [systems, joints, ports, is_joined, m](const Expr& t, const ExprVector& u,
                                                               const ExprVector& y) {
    ExprVector all(m);
    Index count = 0, first = 0;
    for (std::size_t i = 0; i < systems.size(); first += ports[i++]) {
      const ExprVector own = systems[i]->port_equations(t, ExprVector(u.segment(first, ports[i])),
                                                        ExprVector(y.segment(first, ports[i])));
      for (Index a = 0; a < ports[i]; ++a)
        if (!is_joined[static_cast<std::size_t>(first + a)]) all[count++] = own[a];
    }
    for (const Joint& joint : joints) {
      const ExprVector equations = joint.equations(t, u, y);
      all.segment(count, equations.size()) = equations;
      count += equations.size();
    }
    return all;
  };
  return std::make_shared<PortHamiltonianSystem>(
      PortHamiltonianSystem::Matrices{in_blocks(M, J, sizes, sizes), in_blocks(M, R, sizes, sizes),
                                      in_blocks(M, B, sizes, ports), m,
                                      in_blocks(M, D, ports, ports)},
      energy, PortHamiltonianSystem::Relation(relation), std::move(names));
}

}  // namespace courant
