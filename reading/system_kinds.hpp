// The systems that an experiment can ask for.
#pragma once

#include "courant/reading/model.hpp"
#include "courant/reading/registry.hpp"

namespace courant {

// The kinds of `system`: descriptions by formulas, and the catalogue.
Registry<Model>& system_kinds();

// The keys of a system with those that every kind has: `parameters` and `definitions`, which
// read_vocabulary reads.
std::vector<Key> system_keys(std::vector<Key> keys);

// Of files read_<kind>.cpp; those with a Lagrangian share one, so do those with a Morse family and
// the vortices.
std::optional<Model> read_hamiltonian(ObjectReader& system);
std::optional<Model> read_lagrangian(ObjectReader& system);
std::optional<Model> read_mechanical(ObjectReader& system);
std::optional<Model> read_vakonomic(ObjectReader& system);
std::optional<Model> read_morse_family(ObjectReader& system);
std::optional<Model> read_optimal_control(ObjectReader& system);
std::optional<Model> read_euler_poincare(ObjectReader& system);
std::optional<Model> read_port_hamiltonian(ObjectReader& system);
std::optional<Model> read_stokes_dirac(ObjectReader& system);
std::optional<Model> read_interconnection(ObjectReader& system);
std::optional<Model> read_implicit(ObjectReader& system);
std::optional<Model> read_network(ObjectReader& system);
std::optional<Model> read_mechanism(ObjectReader& system);
std::optional<Model> read_point_vortices(ObjectReader& system);
std::optional<Model> read_spherical_vortices(ObjectReader& system);

}  // namespace courant
