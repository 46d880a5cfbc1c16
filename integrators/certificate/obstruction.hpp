// Whether solutions exist in all directions in which linearized equations have them.
#pragma once

#include "courant/integrators/certificate/ladder_levels.hpp"

namespace courant {

// How the part of F^[k] that its Jacobian J at a zero y does not see grows along a direction d of the
// zeros, J d = 0:
//
//   g(ε) = ‖Wᵀ F^[k](y + ε d)‖,   the columns of W a basis of {w : wᵀJ = 0}
//
// Where the zeros near y are a manifold with tangent space ker J, there is a zero within O(ε²) of
// y + ε d; there the equations unseen by J vanish, and so do their derivatives unseen by J, so that
// g(ε) = O(ε³). Where the zeros are singular, as for z² = 0 at 0, g falls like ε²: a combination of
// the equations has no linear part and does not vanish either.
class Obstruction {
 public:
  // `rank`: of the Jacobian at y; `magnitude`: what its entries are around y. Dense: for up to a few hundred
  // unknowns. `blurred`: the part of all of F that W, which has 53 bits, may mix into what it does not see. It counts
  // where F is known better than that.
  Obstruction(const Prolongation& array, const VectorXd& y, const VectorXd& uncertainty, Index rank,
              const SparseMatrixXd& magnitude, double blurred = 0.0);

  // yes: g falls like a power below 2.5 at the smallest three ε at which it is measurable, and all of F
  // grows as along a tangent there. likely: the bounds are too large to tell, but the numbers are squares at
  // five ε. unknown: round-off hides either, or W is not known, or the squares may be what errors of W make of
  // all of F. beside: all of F grows as it does beside a
  // tangent, where g is of second order everywhere.
  enum class Answer { no, yes, likely, unknown, beside };
  Answer is_seen_along(const VectorXd& direction) const;

 private:
  // The row scales of the Jacobian. Rows that vanish at y have none there: theirs are of what they are around
  // y, in the units of the direction.
  VectorXd row_scale_along(const VectorXd& direction) const;
  // What of g need not be seen: a part of ε², in comparable units, or of what bends the unseen equations on
  // this step, by the change of their derivatives. Where all unknowns are 0 nothing tells their units.
  double least_seen(const MatrixXd& unseen, const Linearization& there, const VectorXd& step,
                    double epsilon) const;
  // Whether g is far below ε² in this direction, and above rounding errors.
  bool is_small_along(const VectorXd& direction) const;
  // What the bounds of errors say.
  Answer by_bounds_along(const VectorXd& direction) const;
  // Whether the numbers themselves grow like ε² and are more than this part of all of F, which grows as along a
  // tangent.
  bool is_square_along(const VectorXd& direction, double part) const;

  const Prolongation& array_;
  VectorXd y_, uncertainty_, row_scale_;
  MatrixXd unseen_;                    // the transpose of W, for F in units of the rows
  Linearization at_;                   // y
  SparseMatrixXd magnitude_of_empty_;  // of the rows that vanish at y alone
  bool is_known_ = true;               // W
  double blurred_ = 0.0;
  double turned_ = 0.0;  // by how much rounding errors turn W, in radians
};

}  // namespace courant
