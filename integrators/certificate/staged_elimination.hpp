// StagedElimination: one elimination that gives all levels of a ladder.
#pragma once

#include <cstdint>
#include <vector>

#include "courant/integrators/certificate/jet_equations.hpp"
#include "courant/integrators/certificate/sparse_row.hpp"

namespace courant {

// Row echelon form of the Jacobian of F^[k] at a point, by stages of columns and levels of rows. Stages, in the order
// in which pivots are looked for:
//
//   jets        x_2, x_3, …, z_1, …       unknowns    z_0
//   velocities  x_1                       point       x_0, and t where F depends on it
//
// A row is reduced by all rows of its level and of those before, and its pivot is in the first stage in which
// something is left of it. So with r_s(l) the number of pivots of stage s among the rows of levels ≤ l
//
//   rank J_l = Σ r_s(l),   rank without (x, v) = r_jets + r_unknowns,   rank without x = that + r_velocities
//   dim S_l = 2N - r_velocities - r_point,   dim M_l = N - r_point                 (of an instant, where t is one)
//
// A row with a pivot in `point` is the differential of a constraint, a row of which nothing is left a
// dependence; origin() says of which equations. If its residual is not zero the equations
// contradict each other at this point, to first order.
//
// Entries that shrink are zero (Digits); pivots are chosen by powers of two that make rows and columns alike, and by
// what they leave of rows that are nearly empty, which decides nothing. Rows are sparse: a chain takes a time in
// proportion to its length, but for the choice of pivots.
class StagedElimination {
 public:
  enum Stage : std::uint8_t { jets, unknowns, velocities, point, dependent };
  static constexpr int stage_count = 5;

  struct Row {
    Index level = 0;
    Stage stage = dependent;
    Index pivot = -1;   // column
    SparseRow entries;  // by column
    Digits residual;    // of the same combination of equations
    // What it was made by: row `source` of F^[k], and less `factor` times these of rows().
    Index source = -1;
    struct Step {
      std::size_t row;
      Digits factor;
    };
    std::vector<Step> steps;
  };

  StagedElimination(const JetEquations& equations, const JetEquations::Values<Digits>& values,
                    const Jet& jet);

  const std::vector<Row>& rows() const { return rows_; }  // in the order in which they were found
  // The combination of rows of F^[k] that one of rows() is: coefficients, by row.
  SparseRow origin(const Row& row) const;
  Index count(Stage stage, Index level) const;  // of rows of levels ≤ level
  // In which a column is: an unknown of the jet, or t as the last.
  Stage stage_of(Index column) const { return stages_[static_cast<std::size_t>(column)]; }

  Index dim_S(Index level) const { return dim_M(level) + size_ - count(velocities, level); }
  Index dim_M(Index level) const { return size_ - count(point, level); }

 private:
  class Block;
  void reduce(Row& row) const;
  void subtract(Row& row, std::size_t pivot, std::vector<Index>& filled) const;

  Index size_;  // N
  std::vector<Stage> stages_;
  std::vector<std::int64_t> column_scale_;
  std::vector<Row> rows_;
  std::vector<std::size_t> row_of_pivot_;  // by column; no_row
};

}  // namespace courant
