#include "courant/structures/port_system.hpp"

namespace courant {
namespace {

// "motor" of "u_motor", "0" of "u[0]", "u" where there is one port.
std::string port_name(const std::string& input) {
  if (input.starts_with("u_")) return input.substr(2);
  if (input.starts_with("u[")) return input.substr(2, input.size() - 3);
  return input;
}

}  // namespace

ExprVector PortSystem::do_equations(const ExprVector& x, const ExprVector& v,
                                    const ExprVector& alpha, const ExprVector& z, const Expr& t,
                                    const ExprVector&, const Expr&) const {
  ExprVector equations(equation_count());
  equations << inner_equations(x, v, alpha, z, t),
      port_equations(t, z(inputs_), output(x, alpha, z));
  return equations;
}

EnergySystem::Powers PortSystem::do_powers(const ExprVector& x, const ExprVector& v,
                                           const ExprVector& alpha, const ExprVector& z,
                                           const Expr& t) const {
  Powers powers = inner_powers(x, v, alpha, z, t);
  const ExprVector y = output(x, alpha, z);
  for (Index a = 0; a < port_count(); ++a) {
    const Index input = inputs_[static_cast<std::size_t>(a)];
    powers.supplied.push_back(
        {port_name(names().auxiliary[static_cast<std::size_t>(input)]), y[a] * z[input]});
  }
  return powers;
}

}  // namespace courant
