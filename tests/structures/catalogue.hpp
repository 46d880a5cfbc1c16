// Every kind of Dirac structure, on several manifolds.
#pragma once

#include <memory>
#include <vector>

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/integrability.hpp"

namespace courant::test {

using StructurePointer = std::shared_ptr<const DiracStructure>;

// A structure, and what is known of it.
struct StructureEntry {
  std::string description;
  StructurePointer structure;
  bool integrable;  // meaningful for Dirac structures only
  Index rank_of_F;  // dim F_D at a generic point
};

// Every class of structures/ that is a DiracStructure.
const std::vector<StructureEntry>& structure_catalogue();

// The skew matrix with hat(a) b = a × b.
ExprMatrix hat(const ExprVector& a);
// A matrix field from numbers.
MatrixField constant_field(const MatrixXd& matrix);

}  // namespace courant::test
