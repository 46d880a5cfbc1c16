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

// "motor" of "u_motor", "0" of "u[0]", "u" where there is one port.
std::string port_name(const std::string& input) {
  if (input.starts_with("u_")) return input.substr(2);
  if (input.starts_with("u[")) return input.substr(2, input.size() - 3);
  return input;
}

PortHamiltonianSystem::Relation relation(std::optional<PortHamiltonianSystem::Input> input) {
  if (!input) return [](const Expr&, const ExprVector&, const ExprVector& y) { return y; };
  return [input = std::move(*input)](const Expr& t, const ExprVector& u, const ExprVector& y) {
    return ExprVector(u - input(t, y));
  };
}

}  // namespace

PortHamiltonianSystem::PortHamiltonianSystem(Matrices matrices,
                                             std::shared_ptr<const GeneratingFamily> energy,
                                             std::optional<Input> input, Names names)
    : PortHamiltonianSystem(std::move(matrices), std::move(energy), relation(input),
                            std::move(names)) {
  is_closed_ = !input.has_value();
}

PortHamiltonianSystem::PortHamiltonianSystem(Matrices matrices,
                                             std::shared_ptr<const GeneratingFamily> energy,
                                             Relation relation, Names names)
    // Braces evaluate from left to right: the check comes first.
    : EnergySystem{checked(energy, matrices).manifold(), matrices.m,
                   energy->manifold()->tangent_dimension() + matrices.m, std::move(names)},
      matrices_(std::move(matrices)),
      energy_(std::move(energy)),
      relation_(std::move(relation)) {}

ExprVector PortHamiltonianSystem::output(const ExprVector& x, const ExprVector& alpha,
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

ExprVector PortHamiltonianSystem::do_equations(const ExprVector& x, const ExprVector& v,
                                               const ExprVector& alpha, const ExprVector& u,
                                               const Expr& t, const ExprVector&,
                                               const Expr&) const {
  ExprMatrix A = matrices_.J(x);
  if (matrices_.R) A -= matrices_.R(x);
  const ExprVector y = output(x, alpha, u);
  ExprVector equations(equation_count());
  equations << v - A * alpha - matrices_.B(x) * u, relation_(t, u, y);
  return equations;
}

EnergySystem::Powers PortHamiltonianSystem::do_powers(const ExprVector& x, const ExprVector&,
                                                      const ExprVector& alpha, const ExprVector& u,
                                                      const Expr&) const {
  Powers powers;
  const ExprVector y = output(x, alpha, u);
  for (Index a = 0; a < u.size(); ++a)
    powers.supplied.push_back(
        {port_name(names().auxiliary[static_cast<std::size_t>(a)]), y[a] * u[a]});
  if (matrices_.R)
    powers.dissipated.push_back(
        {"resistance", alpha.cwiseProduct(ExprVector(matrices_.R(x) * alpha)).sum()});
  if (matrices_.D)
    powers.dissipated.push_back(
        {"feedthrough", u.cwiseProduct(ExprVector(matrices_.D(x) * u)).sum()});
  return powers;
}

}  // namespace courant
