#include "courant/structures/lagrangian_system.hpp"

#include "courant/structures/canonical_symplectic.hpp"

namespace courant {

std::shared_ptr<const DiracSystem> lagrangian_system(
    std::shared_ptr<const CotangentBundle> phase_space, Lagrangian::Formula lagrangian,
    const std::vector<std::string>& coordinates) {
  ImplicitSystem::Names names{coordinates, {}, {}};
  const Manifold& Q = *phase_space->base();
  if (Q.ambient_dimension() == Q.tangent_dimension()) {
    const auto n = static_cast<std::size_t>(Q.ambient_dimension());
    std::vector<std::string> momentum_rates, legendre;
    for (std::size_t i = 0; i < n; ++i) {
      const std::string &q = coordinates[i], &p = coordinates[n + i];
      names.auxiliary.push_back(q + "'");
      names.equations.push_back("velocity of " + q);
      momentum_rates.push_back(p + "' = dL/d" + q);
      legendre.push_back(p + " = dL/d" + q + "'");
    }
    names.equations.insert(names.equations.end(), momentum_rates.begin(), momentum_rates.end());
    names.equations.insert(names.equations.end(), legendre.begin(), legendre.end());
  }
  // On a group the velocity has components of its own, beside those of the momentum.
  const auto N = static_cast<std::size_t>(Q.ambient_dimension());
  if (names.auxiliary.empty() && coordinates.size() > N)
    for (std::size_t i = N; i < coordinates.size(); ++i)
      names.auxiliary.push_back("v_" +
                                coordinates[i].substr(coordinates[i].starts_with("p_") ? 2 : 0));
  return std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(phase_space),
      std::make_shared<Lagrangian>(phase_space, std::move(lagrangian)), std::move(names));
}

}  // namespace courant
