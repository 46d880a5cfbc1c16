#include "courant/integrators/certificate/ladder_watch.hpp"

#include <algorithm>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/core/linear/sparse_rank_decision.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/certificate/derivative_array.hpp"
#include "courant/integrators/certificate/natural_scaling.hpp"

namespace courant {
namespace {

std::string number(double value) { return number_text(value, 4); }

std::string dimensions(const ConstraintLadder& ladder) {
  std::string text;
  for (const LadderLevel& level : ladder.levels)
    text += (text.empty() ? "(" : ", (") +
            (level.is_empty ? "empty"
                            : std::to_string(level.dim_S) + ", " + std::to_string(level.dim_M)) +
            ")";
  return text;
}

// Sizes of the unknowns of a jet: that of the point for the chart coordinates, which are 0.
VectorXd nominal_sizes(const DerivativeArray& array, const VectorXd& y) {
  VectorXd size = y.cwiseAbs();
  size.head(array.base_size()) = array.origin_size();
  return size;
}

}  // namespace

LadderWatch::LadderWatch(std::shared_ptr<const ImplicitSystem> system,
                         const ConstraintLadder& start)
    : system_(std::move(system)),
      start_(start),
      array_(std::make_shared<const DerivativeArray>(system_, start.point.t, start.point.x)) {
  const GenericScaling scaling(*array_, start.jet, nominal_sizes(*array_, start.jet));
  row_scale_ = scaling.row_scale;
  column_scale_ = scaling.column_scale;
}

VectorXd LadderWatch::smallest_counted(const ConstraintLadder& now) const {
  const DerivativeArray there = array_->at(now.point.t, now.point.x);
  const SparseMatrixXd J =
      row_scale_.asDiagonal() * there.linearize(now.jet).jacobian * column_scale_.asDiagonal();
  const Index n = there.base_size();
  VectorXd values(3 * static_cast<Index>(start_.levels.size()));
  Index entry = 0;
  for (const LadderLevel& level : start_.levels) {
    const Index rows = there.row_count(level.k), columns = there.unknown_count(level.k);
    const SparseMatrixXd block = J.topLeftCorner(rows, columns);
    const auto smallest = [&](Index left_out, Index rank) {
      if (rank == 0) return 1.0;
      const SparseMatrixXd part = block.rightCols(columns - left_out);
      if (std::max(rows, columns) > 200) return decide_rank(part, {.magnitude = 1.0}).above;
      return singular_values(MatrixXd(part))[rank - 1];
    };
    values[entry++] = smallest(0, level.all.rank);
    values[entry++] = smallest(2 * n, level.without_tangent.rank);
    values[entry++] = smallest(n, level.without_point.rank);
  }
  return values;
}

std::string LadderWatch::examine(const State& state) {
  const ConstraintLadder now =
      ConstraintAlgorithm().run(system_, {.t = state.t, .x = state.x, .v = state.v, .z = state.z});
  if (now.verdict == Verdict::rank_change)
    return "The ranks change at t = " + number(state.t) + ": " + now.reason +
           " The point is singular, and the equations alone do not say how to go on.";
  if (dimensions(now) != dimensions(start_) || now.verdict != start_.verdict)
    return "At t = " + number(state.t) + " the ladder is " + to_string(now.verdict) + ", " +
           dimensions(now) + "; at the start it was " + to_string(start_.verdict) + ", " +
           dimensions(start_) + ", which is what the method was made for." +
           (now.reason.empty() ? "" : " " + now.reason);

  const VectorXd values = smallest_counted(now);
  auto& [largest, last, before_last, last_time] = memory_;
  largest = largest.size() == 0 ? values : largest.cwiseMax(values);
  std::string finding;
  for (Index i = 0; i < values.size() && before_last.size() > 0 && finding.empty(); ++i) {
    if (values[i] > 0.5 * largest[i] || values[i] > last[i]) continue;
    const bool falls_to_zero =
        values[i] < 0.05 * largest[i] && values[i] < 0.5 * last[i] && last[i] < before_last[i];
    if (!falls_to_zero) break;
    const double rate = (last[i] - values[i]) / (state.t - last_time);
    finding = "The ranks change near t = " + number(state.t + values[i] / rate) +
              ": a singular value that counts at level " + std::to_string(i / 3) + " fell from " +
              number(last[i]) + " at t = " + number(last_time) + " to " + number(values[i]) +
              " at t = " + number(state.t) + " (it was up to " + number(largest[i]) +
              "). Equations become dependent there: the configuration is singular, and they alone "
              "do not say how to go on.";
  }
  before_last = last;
  last = values;
  last_time = state.t;
  return finding;
}

std::string LadderWatch::decline() const {
  const auto& [largest, last, before_last, last_time] = memory_;
  for (Index i = 0; i < last.size(); ++i)
    if (last[i] < 0.5 * largest[i])
      return " The constraint algorithm, examined last at t = " + number(last_time) +
             ": a singular value that counts at level " + std::to_string(i / 3) +
             " had fallen from " + number(largest[i]) + " to " + number(last[i]) +
             ". Where it is zero the ranks change, and the configuration is singular.";
  return "";
}

}  // namespace courant
