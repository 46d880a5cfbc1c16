// What is asked of the structures that another one is made of.
#pragma once

#include <memory>
#include <string>

#include "courant/structures/dirac_structure.hpp"

namespace courant {

// For the first argument of a base in braces, which evaluate from left to right: what is null is
// refused before it is used.
const DiracStructure& not_null(const std::shared_ptr<const DiracStructure>& structure,
                               const std::string& where);

// Throws std::invalid_argument: `where`: `what` is ...; expected ....
void require_equal(const std::string& where, const std::string& what, Index size, Index expected);

}  // namespace courant
