// The Dirac structures that an experiment can ask for.
#pragma once

#include <memory>

#include "courant/reading/matrix_fields.hpp"
#include "courant/reading/registry.hpp"
#include "courant/reading/space.hpp"
#include "courant/structures/dirac_structure.hpp"

namespace courant {

// The kinds of `structure`.
Registry<std::shared_ptr<const DiracStructure>, StructureSite>& structure_kinds();

// The keys `coordinates` and `manifold` of an object with a `structure`, see read_space. The
// manifold is by default T*Rⁿ for the canonical structure and Rⁿ for others. A product or composed
// structure has a manifold made of its parts, so none may be given. The space then has one that is only
// as large as the coordinates; take DiracStructure::manifold() once the structure is read.
std::optional<Space> read_structure_space(ObjectReader& object, const Vocabulary& vocabulary,
                                          SymbolTable& taken);

}  // namespace courant
