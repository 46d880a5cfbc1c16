#include "courant/structures/lagrangian_system.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/structures/canonical_symplectic.hpp"

namespace courant {
namespace {

using Names = std::vector<std::string>;

void append(Names& names, const Names& more) {
  names.insert(names.end(), more.begin(), more.end());
}

// Multipliers, and the equations of the constraints: those of the family, then the others.
void add_constraints(ImplicitSystem::Names& names, const Mechanics& mechanics) {
  const Index count = mechanics.holonomic.count() + mechanics.nonholonomic.count();
  for (Index a = 0; a < count; ++a)
    names.auxiliary.push_back(count == 1 ? "lambda" : "lambda[" + std::to_string(a) + "]");
  append(names.equations, mechanics.holonomic.names);
  append(names.equations, mechanics.nonholonomic.names);
}

// What is said of the equations of a structure: their number.
void add_structure(ImplicitSystem::Names& names, const DiracStructure& structure) {
  for (Index i = 0; i < structure.equation_count(); ++i)
    names.equations.push_back("equation[" + std::to_string(i) + "]");
}

}  // namespace

std::shared_ptr<const DiracSystem> lagrangian_system(
    std::shared_ptr<const CotangentBundle> phase_space, Lagrangian::Formula lagrangian,
    const std::vector<std::string>& coordinates, const Mechanics& mechanics,
    std::shared_ptr<const DiracStructure> structure) {
  ImplicitSystem::Names names{coordinates, {}, {}};
  const Manifold& Q = *phase_space->base();
  const bool same = Q.has_velocities_as_vectors();
  const auto N = static_cast<std::size_t>(Q.ambient_dimension());
  const auto n = static_cast<std::size_t>(Q.tangent_dimension());
  const bool canonical = structure == nullptr;
  if (canonical) structure = std::make_shared<CanonicalSymplectic>(phase_space);
  Names momentum_rates, legendre;
  for (std::size_t i = 0; i < n; ++i) {
    const std::string& p = coordinates[N + i];
    // p_R[0] is the momentum of the velocity v_R[0].
    const bool has_word = p.starts_with("p_") &&
                          std::ranges::find(coordinates, "v_" + p.substr(2)) == coordinates.end();
    const std::string velocity = same       ? coordinates[i] + "'"
                                 : has_word ? "v_" + p.substr(2)
                                            : "v[" + std::to_string(i) + "]";
    names.auxiliary.push_back(velocity);
    names.equations.push_back("velocity of " + (same ? coordinates[i] : p));
    momentum_rates.push_back(p + "' = dL/d" + (same ? coordinates[i] : "q along " + velocity));
    legendre.push_back(p + " = dL/d" + velocity);
  }
  append(names.equations, momentum_rates);
  if (!canonical) {
    names.equations.clear();
    add_structure(names, *structure);
  }
  append(names.equations, legendre);
  add_constraints(names, mechanics);
  append(names.auxiliary, structure->port_names());
  return std::make_shared<DiracSystem>(
      std::move(structure),
      constrained_family(std::make_shared<Lagrangian>(phase_space, std::move(lagrangian)),
                         mechanics),
      mechanical_exterior(phase_space, mechanics), std::move(names));
}

std::shared_ptr<const DiracSystem> hamiltonian_system(
    std::shared_ptr<const DiracStructure> structure, std::shared_ptr<const GeneratingFamily> family,
    const std::vector<std::string>& coordinates, const Mechanics& mechanics,
    const std::vector<std::string>& parameters) {
  const auto phase_space = std::dynamic_pointer_cast<const CotangentBundle>(structure->manifold());
  if (!phase_space && (mechanics.force || mechanics.damping || mechanics.nonholonomic.count() > 0))
    throw std::invalid_argument("hamiltonian_system: there are velocities of configurations on " +
                                structure->manifold()->name() + "; expected a cotangent bundle.");
  ImplicitSystem::Names names{coordinates, {}, {}};
  add_structure(names, *structure);
  for (const std::string& parameter : parameters) {
    names.auxiliary.push_back(parameter);
    names.equations.push_back("dE/d" + parameter);
  }
  add_constraints(names, mechanics);
  append(names.auxiliary, structure->port_names());
  return std::make_shared<DiracSystem>(
      std::move(structure), constrained_family(std::move(family), mechanics),
      mechanical_exterior(phase_space, mechanics), std::move(names));
}

}  // namespace courant
