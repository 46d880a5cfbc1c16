// Derivatives in the equations of S_f that nothing depends on.
#pragma once

#include <vector>

#include "courant/core/expressions/function.hpp"

namespace courant {

// S_f is F(ξ, ξ', …, z, z', …) = 0, of which ξ, ξ' and z are asked for. Some of the others are open,
// as the derivative of a multiplier is where only that of a constraint is needed. Steps carry them
// for nothing, and their matrices are not square. Where F and its Jacobian are known at a point:
//
// * Equations can be left out that alone contain some of the others, and have a Jacobian of full row
//   rank by these. Whatever all else is, these take values that meet them. (The horizontal part of the
//   Dulmage–Mendelsohn decomposition of the Jacobian; A. Pothen, C.-J. Fan, Computing the block
//   triangular form of a sparse matrix, ACM TOMS 16 (1990) 303.)
// * Of those in the remaining equations some can be held at any value, if vectors of the Jacobian's
//   kernel move them and nothing that is asked for.
struct OpenJets {
  std::vector<Index> equations;  // to be left out, ascending
  std::vector<Index> unknowns;   // to be held, ascending, by their places in y
};

// What an unknown of F is to those who solve it.
enum class JetRole {
  asked_for,
  // Asked for, unless the equations leave it open, as the multiplier of a constraint that repeats others.
  held_where_open,
  // Derivatives of unknowns of the system, whose meaning is the same at every point.
  may_be_held,
  // Coordinates of higher derivatives in a basis that may turn.
  carried,
};

// F: y; p ↦ F with its Jacobian by y, all derivatives besides ξ, and ξ among p. `at`: y and p at a point of
// S_f. Nothing is open where F is not finite there. Ranks are those of dense matrices.
OpenJets open_jets(const Function& F, const std::vector<VectorXd>& at,
                   const std::vector<JetRole>& roles);

}  // namespace courant
