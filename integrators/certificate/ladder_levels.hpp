// The levels of a ladder at a solution of a prolongation.
#pragma once

#include <random>

#include "courant/core/linear/uncertain_rank.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/certificate/prolongation.hpp"

namespace courant {

// The Jacobian of a prolongation at a zero, as far as it is known, with rows and columns comparable:
// diag(r) J diag(c) equilibrated.
struct ComparableJacobian {
  UncertainMatrix scaled;
  VectorXd row_scale, column_scale;  // r, c

  ComparableJacobian(const Prolongation& array, const VectorXd& y, const VectorXd& uncertainty);
};

// dim S_k and dim M_k for k = 0 … level of y, at a zero y of the prolongation, with the ranks that
// they come from: π_A(ker J) has dimension |A| - (rank J - rank J_rest), where J_rest lacks the
// columns in A. `uncertainty`: how far from y the zero that is meant may be (see Zero).
std::vector<LadderLevel> ladder_levels(const Prolongation& array, const VectorXd& y,
                                       const VectorXd& uncertainty);

// How often each equation is differentiated for what the levels up to `index` say about point and
// velocity, by the left null vectors of the Jacobian at y. An equation whose multiplier happens to
// vanish at y is not counted: look at more than one point.
class DerivativeArray;
std::vector<int> needed_differentiations(const DerivativeArray& array, const VectorXd& y,
                                         const VectorXd& uncertainty, Index index);

// Fills in what row reduction of the Jacobian tells: constraints, differentiations, redundancies,
// gauge directions and determined auxiliary unknowns. `ladder` has its levels and index; y is of
// the last level.
void describe(ConstraintLadder& ladder, const DerivativeArray& array, const VectorXd& y,
              const VectorXd& uncertainty);

// Random tangent vectors of the zeros at y: δ with J δ = 0, entries of up to a natural unit each.
class TangentDisplacement {
 public:
  TangentDisplacement(const DerivativeArray& array, const VectorXd& y, const VectorXd& nominal);
  // Nothing tells units for certain: equations do not where unknowns vanish, and sizes do not either.
  enum class Units {
    natural,           // of the equations
    own_sizes,         // but none larger than the unknown itself, unless that vanishes
    large_where_zero,  // but up to a million times as large for each unknown that vanishes
  };
  // In natural units. Where y is no zero, even what rounding leaves of an entry may lead to one.
  VectorXd next();
  // Where y is a zero: to round-off of J δ = 0, and without entries that are round-off. Of an entry of 10⁻¹⁶ nothing
  // bends but by rounding, and a direction that is 10⁻¹³ off has numbers of its own at 10³ units.
  VectorXd next_at_zero(Units units);
  // The generic magnitude of the Jacobian at y.
  const SparseMatrixXd& magnitude() const { return magnitude_; }
  // That of time: of a coordinate by that of its velocity, in the geometric mean.
  double time_unit() const { return time_unit_; }
  // ‖δ‖ in natural units.
  double size(const VectorXd& delta) const { return delta.cwiseQuotient(units_).norm(); }

 private:
  VectorXd random();

  std::mt19937 generator_;
  VectorXd units_, sizes_;
  double time_unit_ = 1.0;
  SparseMatrixXd magnitude_, jacobian_;
};

}  // namespace courant
