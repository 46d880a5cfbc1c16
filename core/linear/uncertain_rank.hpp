// The rank of a matrix with bounds of the errors of its entries.
#pragma once

#include "courant/core/linear/rank_decision.hpp"
#include "courant/core/linear/uncertain_matrix.hpp"

namespace courant {

// The least rank that all matrices in the set have, as far as these bounds prove it.
//
//   1. An entry that is alone in its row or column is a pivot: the rank is one more than that of the
//      rest without this row and column. Nothing is computed, so that units do not matter. One
//      whose elimination would hide numbers in errors is left to the blocks.
//   2. What is left falls into blocks that share no row and no column. Each is scaled with diag(r),
//      diag(c); its rank is the number of singular values
//
//        σ > ε = ‖diag(r) error diag(c)‖ + rounding of the decomposition,    ‖E‖² ≤ ‖E‖₁ ‖E‖_∞
//
//      For every matrix of the set has a singular value within ‖E‖ of each σ (Weyl). That is a proof
//      in any scales, so the highest rank of three counts: Equilibration makes all entries as equal as
//      can be, ProductScaling heeds the large ones alone, and the equilibration of the larger of
//      entries and 10⁸ times their errors heeds errors. Where these do not settle it, the pivots of an
//      UncertainElimination may prove more: there each entry has its own error, and no unit.
//
// Singular values, `above`, `below` and `threshold` of the result are in units of ε of their block, so that the
// threshold is 1; gap = σ_r / max(σ_{r+1}, 1), with pivots among the σ by how many times they are their error, also
// those of an elimination that proves more. Ambiguous where a σ counted is hardly more than the threshold, or one that
// does not count is not far below it: a zero comes out at a small part of the bound. An error that is not finite makes
// the decision ambiguous with gap 0.
//
// Laws: R1 the rank of PAQ is that of A, for permutations P, Q. R2 the rank of D₁AD₂ is that of A,
// for diagonal D₁, D₂ > 0, of powers of two. R3 rank Aᵀ = rank A. R4 the rank falls only where
// errors grow.
RankDecision decide_rank(const UncertainMatrix& A);

}  // namespace courant
