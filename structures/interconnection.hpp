// Interconnection: port-Hamiltonian systems that are joined at their ports.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "courant/structures/port_hamiltonian_system.hpp"

namespace courant {

// What p ports have in common: p equations of their inputs u and outputs y,
//
//   F u + E y = s(t, y)
//
// Where s = 0, (u, y) lies in the Dirac structure {F u + E y = 0} ⊂ Rᵖ ⊕ Rᵖ*, so that the joint
// neither makes nor takes power, Σ u_a y_a = 0. A source is one port whose input is given.
class Joint {
 public:
  // A formula of t and the outputs of all ports of the interconnection, in their order.
  using Source = std::function<Expr(const Expr& t, const ExprVector& y)>;

  // Ports are numbered through all systems, in their order. F, E: p × p. Throws
  // std::invalid_argument unless F Eᵀ + E Fᵀ = 0 and [F E] has rank p, up to 1e-12 of their entries,
  // or if a port is there twice.
  Joint(std::vector<Index> ports, MatrixXd F, MatrixXd E);
  // u₁ = … = u_p, Σ y = 0.
  static Joint shared_input(std::vector<Index> ports);
  // y₁ = … = y_p, Σ u = 0.
  static Joint shared_output(std::vector<Index> ports);
  // u = K y with a skew-symmetric K.
  static Joint gyrator(std::vector<Index> ports, const MatrixXd& K);
  // u_port = s(t, y).
  static Joint source(Index port, Source s);

  const std::vector<Index>& ports() const { return ports_; }
  // p equations, where u and y are those of all ports.
  ExprVector equations(const Expr& t, const ExprVector& u, const ExprVector& y) const;

 private:
  std::vector<Index> ports_;
  MatrixXd F_, E_;
  Source source_;
};

// The systems side by side on the product of their manifolds, with the sum of their energies, J, R, B
// and D in blocks and all of their ports, in their order. Ports of joints obey these; a port without
// a joint stays as it is in its system, closed or with its input.
//
// Throws std::invalid_argument if a system is null, or a port does not exist, belongs to two joints or
// to a system with inputs of its own.
std::shared_ptr<const PortHamiltonianSystem> interconnected(
    const std::vector<std::shared_ptr<const PortHamiltonianSystem>>& systems,
    const std::vector<Joint>& joints, ImplicitSystem::Names names = {});

}  // namespace courant
