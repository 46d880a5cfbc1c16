// StagedElimination: one elimination that gives all levels of a ladder.
#pragma once

#include <cstdint>
#include <vector>

#include "courant/integrators/certificate/jet_equations.hpp"

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
// dependence; `origin` says of which equations. If its residual is not zero the equations
// contradict each other at this point, to first order.
//
// Entries that shrink are zero (Digits); pivots are chosen by powers of two that make rows and columns alike, which
// decide nothing.
class StagedElimination {
 public:
  enum Stage : std::uint8_t { jets, unknowns, velocities, point, dependent };
  static constexpr int stage_count = 5;

  struct Row {
    Index level = 0;
    Stage stage = dependent;
    Index pivot = -1;             // column
    std::vector<Digits> entries;  // by column
    Digits residual;              // of the same combination of equations
    std::vector<Digits> origin;   // coefficients, by row of F^[k]; empty if not asked for
  };

  StagedElimination(const JetEquations& equations, const JetEquations::Values<Digits>& values,
                    const Jet& jet, bool with_origins);

  const std::vector<Row>& rows() const { return rows_; }  // in the order in which they were found
  Index count(Stage stage, Index level) const;            // of rows of levels ≤ level

  Index dim_S(Index level) const { return dim_M(level) + size_ - count(velocities, level); }
  Index dim_M(Index level) const { return size_ - count(point, level); }

  // The exponent of two of the smallest pivot next to the largest possible one, 0 or less: what would have to
  // change for another rank.
  std::int64_t smallest_pivot() const { return smallest_pivot_; }

 private:
  void reduce(Row& row) const;
  void find_pivots(std::vector<Row>& block, Index level);
  Stage stage_of(Index column) const { return stages_[static_cast<std::size_t>(column)]; }

  Index size_;  // N
  std::vector<Stage> stages_;
  std::vector<std::int64_t> column_scale_;
  std::vector<Row> rows_;
  std::int64_t smallest_pivot_ = 0;
};

}  // namespace courant
