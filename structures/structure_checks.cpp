#include "courant/structures/structure_checks.hpp"

#include <stdexcept>

namespace courant {

const DiracStructure& not_null(const std::shared_ptr<const DiracStructure>& structure,
                               const std::string& where) {
  if (!structure) throw std::invalid_argument(where + ": a structure is null.");
  return *structure;
}

void require_equal(const std::string& where, const std::string& what, Index size, Index expected) {
  if (size == expected) return;
  throw std::invalid_argument(where + ": " + what + " is " + std::to_string(size) + "; expected " +
                              std::to_string(expected) + ".");
}

}  // namespace courant
