// Units in which the terms of equations are of one size.
#pragma once

#include <vector>

#include "courant/core/expressions/linear_algebra.hpp"

namespace courant {

// The unit of each of the n coordinates ξ, numbered, or Manifold::ScalingSymmetries::none for a number without one.
using UnitNumbering = std::vector<Index>;

// The units c of the columns (ξ, ξ', z), where those of ξ' are those of ξ divided by a unit of time T,
// and r of the rows that minimise
//
//   Σ (log r_i + log |a_ij| + log c_j)² + Σ (log r_i + log |b_i|)² + Σ (log |s_j| + log c_j)²
//
// over entries a of rows and columns, constants b of rows, and slopes s of numbers without a unit. Of what that
// leaves open, which is T where no equation says it, it is
//
//   Σ (log c_j - log |y_j|)²
//
// that is least, over sizes y of columns that are known. A common factor of the units of
// what the equations connect stays open; it is no matter.
class UnitEquations {
 public:
  UnitEquations(const UnitNumbering& numbering, Index rows, Index columns);

  // All of positive size. The column after the last one is that of T.
  void add_entry(Index row, Index column, double size);
  void add_constant(Index row, double size);
  void add_slope(Index column, double size);

  // c, where `sizes` of columns are known if they are positive.
  VectorXd columns(const VectorXd& sizes) const;

 private:
  struct Part {
    Index unknown;
    double factor;
  };
  std::vector<Part> column_parts(Index column) const;  // of log c
  void add_term(const std::vector<Part>& parts, double size);

  Index rows_;
  MatrixXd C_, A_;  // log c = C s for the unknowns s; A s = b where the sum is least
  VectorXd b_;
};

}  // namespace courant
