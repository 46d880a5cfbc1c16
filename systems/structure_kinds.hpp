// The Dirac structures that an experiment can ask for.
#pragma once

#include <memory>

#include "courant/structures/dirac_structure.hpp"
#include "courant/systems/registry.hpp"
#include "courant/systems/vocabulary.hpp"

namespace courant {

// Where a structure lives, and the names that its formulas may use (coordinates, parameters and
// definitions of them).
struct StructureSite {
  std::shared_ptr<const Manifold> manifold;
  Vocabulary vocabulary;
};

// The kinds of `structure`.
const Registry<std::shared_ptr<const DiracStructure>, StructureSite>& structure_kinds();

}  // namespace courant
