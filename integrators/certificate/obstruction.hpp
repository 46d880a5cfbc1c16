// Obstruction: whether equations have solutions in a direction in which their linearization has them.
#pragma once

#include "courant/integrators/certificate/ladder_levels.hpp"

namespace courant {

// At a zero y of F = F^[k] with the Jacobian J, the linearized equations have solutions in each direction d ∈ ker J.
// The equations themselves need not have any there: z² = 0 allows every direction at 0 when it is linearized, and has
// no zero but 0.
//
// What tells is how the part of F grows that J does not see:
//
//   g(ε) = ‖Wᵀ F(y + ε d)‖,   the columns of W a basis of {w : wᵀJ = 0}
//
// If the zeros near y are a manifold with tangent space ker J, there is a zero within O(ε²) of y + ε d. F vanishes
// there, and Wᵀ times the Jacobian there is O(ε), so g(ε) = O(ε³). If the zeros are singular, a combination wᵀF has no
// linear part at y and does not vanish along d. Then g falls like ε².
class Obstruction {
 public:
  // `rank`: of the Jacobian at y. `magnitude`: the sizes of its entries around y. Matrices are dense, so this is for up
  // to a few hundred unknowns. `blurred`: W has 53 bits, so Wᵀ F may contain up to this part of all of F by error; it
  // matters where F itself is known with more digits.
  Obstruction(const Prolongation& array, const VectorXd& y, const VectorXd& uncertainty, Index rank,
              const SparseMatrixXd& magnitude, double blurred = 0.0);

  // Whether there is an obstruction.
  enum class Answer {
    no,
    // g falls like a power below 2.5 at the smallest three ε at which it can be measured, and all of F grows there as
    // it does along a tangent.
    yes,
    // The bounds of errors are too large to say yes, but g grows like ε² over five ε in a row.
    likely,
    // Round-off hides how g grows, or W is not known, or g may consist of errors of W.
    unknown,
    // All of F grows as it does in a direction that is not tangent to the zeros. g is then of second order always.
    beside
  };
  // The answer for a direction d with J d = 0.
  Answer is_seen_along(const VectorXd& direction) const;

 private:
  // The row scales of the Jacobian. A row that vanishes at y has none; its scale is that of its entries around y, for
  // unknowns as large as those of the direction.
  VectorXd row_scale_along(const VectorXd& direction) const;
  // A size below which g counts as nothing: a part of ε² in comparable units, or of the curvature of the unseen
  // equations along this step, by the change of their derivatives. The smaller one counts; where all unknowns are 0
  // nothing tells their units.
  double least_seen(const MatrixXd& unseen, const Linearization& there, const VectorXd& step,
                    double epsilon) const;
  // Whether g is far below ε² in this direction, and above rounding errors.
  bool is_small_along(const VectorXd& direction) const;
  // The answer by the bounds of errors alone.
  Answer by_bounds_along(const VectorXd& direction) const;
  // Whether g, computed without regard to errors, grows like ε² and is more than this part of all of F, while all of F
  // grows as it does along a tangent.
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
