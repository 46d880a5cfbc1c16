#include "courant/integrators/certificate/ladder_proof.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "courant/core/numbers/ball.hpp"
#include "courant/integrators/certificate/elimination_reading.hpp"

namespace courant {
namespace {

using Balls = std::vector<Ball>;

Ball ball_of(const Digits& number) {
  Ball sum;
  for (const double term : number.terms()) sum += term;
  return sum.midpoint();
}

// The elimination once more, with the same pivots, of the Jacobian on all of a ball.
class BallElimination {
 public:
  // `pivots`: rows in the order in which they were found. `residual`: F^[k] at the midpoint.
  BallElimination(const std::vector<JetEquations::Entry>& pattern, const Balls& entries,
                  const std::vector<StagedElimination::Row>& pivots, const Balls& residual)
      : pivots_(pivots) {
    std::vector<Row> rows(residual.size());
    for (std::size_t e = 0; e < pattern.size(); ++e)
      rows[index(pattern[e].row)].entries[pattern[e].column] = entries[e];
    for (const StagedElimination::Row& pivot : pivots) {
      Row& row = rows[index(pivot.source)];
      row.residual = residual[index(pivot.source)];
      reduce(row);
      rows_.push_back(std::move(row));
    }
  }

  // What is left of the i-th of the pivots' rows; columns that are not there are zero.
  const std::map<Index, Ball>& entries(std::size_t i) const { return rows_[i].entries; }
  const Ball& residual(std::size_t i) const { return rows_[i].residual; }
  // The first of the pivots that may be zero somewhere in the ball; the number of pivots if there is none.
  std::size_t first_doubtful() const {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (is_pivot(i) && pivot(i).contains_zero()) return i;
    return rows_.size();
  }

  // All Δ with J Δ = -F of matrices in the ball, by the column of a pivot.
  std::map<Index, Ball> newton_step() const {
    std::map<Index, Ball> step;
    for (std::size_t i = rows_.size(); i-- > 0;) {
      if (!is_pivot(i)) continue;
      Ball sum = -rows_[i].residual;
      for (const auto& [column, entry] : rows_[i].entries)
        if (const auto known = step.find(column); known != step.end()) sum -= entry * known->second;
      step[pivots_[i].pivot] = sum / pivot(i);
    }
    return step;
  }

 private:
  struct Row {
    std::map<Index, Ball> entries;
    Ball residual;
  };

  static std::size_t index(Index i) { return static_cast<std::size_t>(i); }
  bool is_pivot(std::size_t i) const { return pivots_[i].stage != StagedElimination::dependent; }
  Ball pivot(std::size_t i) const {
    const auto found = rows_[i].entries.find(pivots_[i].pivot);
    return found == rows_[i].entries.end() ? Ball() : found->second;
  }

  // Rows that were found first have no entry in the columns of the pivots before them, nor will this one.
  void reduce(Row& row) const {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (!is_pivot(i)) continue;
      const auto entry = row.entries.find(pivots_[i].pivot);
      if (entry == row.entries.end()) continue;
      const Ball factor = entry->second / pivot(i);
      for (const auto& [column, value] : rows_[i].entries) row.entries[column] -= factor * value;
      row.residual -= factor * rows_[i].residual;
      row.entries.erase(pivots_[i].pivot);
      std::erase_if(row.entries, [](const auto& one) { return one.second.is_zero(); });
    }
  }

  const std::vector<StagedElimination::Row>& pivots_;
  std::vector<Row> rows_;
};

// The unknowns of a jet as balls, and t as the last of them: the order of columns.
Balls balls_of(const Jet& jet) {
  Balls result;
  for (const Digits& number : jet.y) result.push_back(ball_of(number));
  result.push_back(ball_of(jet.t));
  return result;
}

// How many numbers are not zero, and how many count as zero: in the columns of the groups before that of a row's pivot.
void count_numbers(const JetEquations& equations, const StagedElimination& elimination,
                   const BallElimination& there, LadderProof& result) {
  const std::vector<StagedElimination::Row>& rows = elimination.rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool is_dependent = rows[i].stage == StagedElimination::dependent;
    if (!is_dependent) ++result.not_zero;
    if (is_dependent && !there.residual(i).is_zero()) ++result.zero;
    for (const auto& [column, entry] : there.entries(i)) {
      if (elimination.stage_of(column) >= rows[i].stage) continue;
      ++result.zero;
      if (!entry.contains_zero())
        result.missing = "A number that counts as zero is not, of " +
                         in_words(equations_of(equations, elimination, rows[i])) + ".";
    }
  }
}

}  // namespace

LadderProof proof(const JetEquations& equations, const StagedElimination& elimination,
                  const Jet& jet) {
  LadderProof result;
  if (!Ball::is_available()) {
    result.missing = "This build of Courant has no arithmetic with balls (Arb).";
    return result;
  }
  const auto at = [&](const Balls& numbers) {
    return equations.at(numbers.back(), Balls(numbers.begin(), numbers.end() - 1), jet.k);
  };
  const std::vector<StagedElimination::Row>& rows = elimination.rows();
  const std::vector<JetEquations::Entry> pattern = equations.pattern(jet.k);
  const Balls midpoint = balls_of(jet);
  const Balls residual = at(midpoint).residual;
  Balls ball = midpoint;
  constexpr int most_balls = 12;
  for (int tried = 0; tried < most_balls; ++tried) {
    const auto values = at(ball);
    if (values.is_at_edge) {
      result.missing = "A switch (abs, sign, min, max or a comparison) may be at its edge.";
      return result;
    }
    if (!std::ranges::all_of(values.entries, &Ball::is_finite)) {
      result.missing =
          "A derivative has no bounds near the point: a function is not defined around it, or is "
          "one whose "
          "series has no bound here.";
      return result;
    }
    const BallElimination there(pattern, values.entries, rows, residual);
    if (const std::size_t i = there.first_doubtful(); i < rows.size()) {
      result.missing = "It is not proved that a number is not zero, of " +
                       in_words(equations_of(equations, elimination, rows[i])) + ".";
      return result;
    }
    const std::map<Index, Ball> step = there.newton_step();
    const auto is_inside = [&](const auto& one) {
      const auto j = static_cast<std::size_t>(one.first);
      return ball[j].contains_inside(midpoint[j] + one.second);
    };
    if (tried > 0 && std::ranges::all_of(step, is_inside)) {
      result.has_point = true;
      count_numbers(equations, elimination, there, result);
      for (Index j = 0; j < equations.point_size(); ++j)
        result.radius = std::max(result.radius, ball[static_cast<std::size_t>(j)].radius());
      return result;
    }
    // A ball that is larger than the step on all of it.
    constexpr int twice = 1, least = -400;
    for (const auto& [column, change] : step) {
      const auto j = static_cast<std::size_t>(column);
      ball[j] = midpoint[j].widened_by(change, twice).widened_by(midpoint[j], least);
      if (ball[j].is_exact()) ball[j] = ball[j].widened_by(1.0, least);
    }
  }
  result.missing =
      "It is not proved that there is a consistent point: no ball was found that Newton's method "
      "maps into itself.";
  return result;
}

}  // namespace courant
