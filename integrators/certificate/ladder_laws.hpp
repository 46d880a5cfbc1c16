// The laws of ConstraintLadder, measured.
#pragma once

#include <vector>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/manifolds/law_result.hpp"

namespace courant {

// What holds of every ladder of a system on a manifold of dimension n:
//
//   N1  dim S_k and dim M_k do not increase with k: the sets are nested
//   N2  0 ≤ dim M_k ≤ n, and the fibres dim S_k - dim M_k are between 0 and n
//   N3  M_k has n - dim M_k constraints of level k or less: what elimination finds agrees with the
//       ranks (levels up to the index, of regular and gauge ladders)
//   N4  the last two levels are equal if the verdict is regular or gauge, and its gauge dimension
//       and degrees of freedom are theirs
//
// Defects are by how much the numbers are off; the bounds are 0.
std::vector<LawResult> check_ladder(const ConstraintLadder& ladder, Index manifold_dimension);

}  // namespace courant
