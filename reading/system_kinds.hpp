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

// One file each, read_<kind>.cpp; the vortices share one.
std::optional<Model> read_hamiltonian(ObjectReader& system);
std::optional<Model> read_lagrangian(ObjectReader& system);
std::optional<Model> read_port_hamiltonian(ObjectReader& system);
std::optional<Model> read_implicit(ObjectReader& system);
std::optional<Model> read_network(ObjectReader& system);
std::optional<Model> read_point_vortices(ObjectReader& system);
std::optional<Model> read_spherical_vortices(ObjectReader& system);

}  // namespace courant
