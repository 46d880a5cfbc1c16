#include "courant/structures/port_hamiltonian_system.hpp"

#include <numeric>
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

std::vector<Index> first(Index m) {
  std::vector<Index> indices(static_cast<std::size_t>(m));
  std::iota(indices.begin(), indices.end(), Index{0});
  return indices;
}

}  // namespace

PortHamiltonianSystem::PortHamiltonianSystem(Matrices matrices,
                                             std::shared_ptr<const GeneratingFamily> energy,
                                             std::optional<Input> input, Names names)
    // Braces evaluate from left to right: the check comes first.
    : PortSystem{checked(energy, matrices).manifold(), matrices.m,
                 energy->manifold()->tangent_dimension() + matrices.m, std::move(names),
                 first(matrices.m)},
      matrices_(std::move(matrices)),
      energy_(std::move(energy)),
      input_(std::move(input)) {}

bool PortHamiltonianSystem::do_is_free(Index) const { return !input_.has_value(); }

ExprVector PortHamiltonianSystem::do_output(const ExprVector& x, const ExprVector& alpha,
                                            const ExprVector& u) const {
  ExprVector y = matrices_.B(x).transpose().eval() * alpha;
  if (matrices_.D) y += matrices_.D(x) * u;
  return y;
}

Expr PortHamiltonianSystem::do_generator(const ExprVector& x, const ExprVector&,
                                         const Expr& t) const {
  return energy_->value(x, ExprVector(0), t);
}

ExprVector PortHamiltonianSystem::do_effort(const ExprVector& x, const ExprVector&,
                                            const Expr& t) const {
  return energy_->differential(x, ExprVector(0), t);
}

ExprVector PortHamiltonianSystem::do_inner_equations(const ExprVector& x, const ExprVector& v,
                                                     const ExprVector& alpha, const ExprVector& u,
                                                     const Expr&) const {
  ExprMatrix A = matrices_.J(x);
  if (matrices_.R) A -= matrices_.R(x);
  return v - A * alpha - matrices_.B(x) * u;
}

ExprVector PortHamiltonianSystem::do_port_equations(const Expr& t, const ExprVector& u,
                                                    const ExprVector& y) const {
  if (!input_) return y;
  const auto& input = *input_;
  return ExprVector(u - input(t, y));
}

EnergySystem::Powers PortHamiltonianSystem::do_inner_powers(const ExprVector& x, const ExprVector&,
                                                            const ExprVector& alpha,
                                                            const ExprVector& u,
                                                            const Expr&) const {
  Powers powers;
  if (matrices_.R)
    powers.dissipated.push_back(
        {"resistance", alpha.cwiseProduct(ExprVector(matrices_.R(x) * alpha)).sum()});
  if (matrices_.D)
    powers.dissipated.push_back(
        {"feedthrough", u.cwiseProduct(ExprVector(matrices_.D(x) * u)).sum()});
  return powers;
}

}  // namespace courant
