#include "courant/structures/port_hamiltonian_system.hpp"

#include <stdexcept>

namespace courant {
namespace {

const GeneratingFamily& checked(const std::shared_ptr<const GeneratingFamily>& energy,
                                const PortHamiltonianSystem::Matrices& matrices) {
  if (!energy || energy->parameter_size() != 0)
    throw std::invalid_argument(
        "PortHamiltonianSystem: the energy is missing or has parameters; expected a function on "
        "M.");
  if (!matrices.J || !matrices.B)
    throw std::invalid_argument("PortHamiltonianSystem: J or B is missing; expected both.");
  return *energy;
}

}  // namespace

PortHamiltonianSystem::PortHamiltonianSystem(Matrices matrices,
                                             std::shared_ptr<const GeneratingFamily> energy,
                                             std::optional<Input> input, Names names)
    // Braces evaluate from left to right: the check comes first.
    : ImplicitSystem{checked(energy, matrices).manifold(), matrices.m,
                     energy->manifold()->tangent_dimension() + matrices.m, std::move(names)},
      matrices_(std::move(matrices)),
      energy_(std::move(energy)),
      input_(std::move(input)) {}

ExprVector PortHamiltonianSystem::output(const ExprVector& x, const ExprVector& u,
                                         const Expr& t) const {
  ExprVector y = matrices_.B(x).transpose().eval() * energy_->differential(x, ExprVector(0), t);
  if (matrices_.D) y += matrices_.D(x) * u;
  return y;
}

ExprVector PortHamiltonianSystem::do_residual(const ExprVector& x, const ExprVector& v,
                                              const ExprVector& u, const Expr& t) const {
  const ExprVector dH = energy_->differential(x, ExprVector(0), t);
  ExprMatrix A = matrices_.J(x);
  if (matrices_.R) A -= matrices_.R(x);
  const ExprVector y = output(x, u, t);
  ExprVector residual(equation_count());
  residual << v - A * dH - matrices_.B(x) * u, input_ ? ExprVector(u - (*input_)(t, y)) : y;
  return residual;
}

std::optional<Expr> PortHamiltonianSystem::do_energy(const ExprVector& x, const ExprVector&,
                                                     const Expr& t) const {
  return energy_->value(x, ExprVector(0), t);
}

}  // namespace courant
