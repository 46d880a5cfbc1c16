#include "courant/integrators/certificate/staged_elimination.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <queue>

#include "courant/integrators/certificate/binary_scales.hpp"

namespace courant {
namespace {

constexpr std::int64_t no_entry = std::numeric_limits<std::int64_t>::min();
constexpr std::size_t no_row = std::numeric_limits<std::size_t>::max();

}  // namespace

// The rows of a level while their pivots are looked for.
class StagedElimination::Block {
 public:
  Block(StagedElimination& elimination, std::vector<Row> rows)
      : of_(elimination), rows_(std::move(rows)), known_(rows_.size()) {
    rows_with_.resize(of_.stages_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (const SparseRow::Entry& entry : rows_[i].entries) rows_with(entry.column).push_back(i);
      look_at(i);
    }
  }

  void find_pivots() {
    for (int stage = jets; stage < dependent; ++stage)
      while (take_pivot(static_cast<Stage>(stage))) {
      }
    for (Row& row : rows_)
      if (row.stage == dependent) of_.rows_.push_back(std::move(row));
  }

 private:
  // Of a row: the largest exponent of its entries, and of those of each stage with its column.
  struct Known {
    std::int64_t scale = no_entry;
    std::array<std::int64_t, dependent> exponent;
    std::array<Index, dependent> column;
  };

  // The rows that had an entry in the column at some time.
  std::vector<std::size_t>& rows_with(Index column) {
    return rows_with_[static_cast<std::size_t>(column)];
  }

  void look_at(std::size_t i) {
    Known& known = known_[i];
    known.scale = no_entry;
    known.exponent.fill(no_entry);
    for (const SparseRow::Entry& entry : rows_[i].entries) {
      const auto j = static_cast<std::size_t>(entry.column);
      const std::int64_t e = entry.value.exponent() + of_.column_scale_[j];
      known.scale = std::max(known.scale, e);
      if (e <= known.exponent[of_.stages_[j]]) continue;
      // Time comes last, so that constraints at equal times are combined no further than they have to be.
      if (j + 1 == of_.stages_.size() && known.exponent[point] != no_entry) continue;
      known.exponent[of_.stages_[j]] = e;
      known.column[of_.stages_[j]] = entry.column;
    }
  }

  // Rows with few entries first, among pivots that are not much smaller than the largest, each next to the
  // largest entry of its own row: the scale of an equation decides nothing.
  bool take_pivot(Stage stage) {
    constexpr std::int64_t much_smaller = 10;
    std::int64_t largest = no_entry;
    const auto is_open = [&](std::size_t i) {
      return rows_[i].stage == dependent && known_[i].exponent[stage] != no_entry;
    };
    const auto size = [&](std::size_t i) { return known_[i].exponent[stage] - known_[i].scale; };
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (is_open(i)) largest = std::max(largest, size(i));
    if (largest == no_entry) return false;
    std::size_t best = no_row;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (is_open(i) && size(i) >= largest - much_smaller &&
          (best == no_row || rows_[i].entries.size() < rows_[best].entries.size()))
        best = i;
    Row& pivot = rows_[best];
    pivot.stage = stage;
    pivot.pivot = known_[best].column[stage];
    of_.row_of_pivot_[static_cast<std::size_t>(pivot.pivot)] = of_.rows_.size();
    of_.rows_.push_back(pivot);
    std::vector<Index> filled;
    // The list of the pivot's own column does not grow meanwhile.
    for (const std::size_t i : rows_with(pivot.pivot)) {
      if (rows_[i].stage != dependent || rows_[i].entries[pivot.pivot].is_zero()) continue;
      filled.clear();
      of_.subtract(rows_[i], of_.rows_.size() - 1, filled);
      for (const Index column : filled) rows_with(column).push_back(i);
      look_at(i);
    }
    return true;
  }

  StagedElimination& of_;
  std::vector<Row> rows_;
  std::vector<Known> known_;
  std::vector<std::vector<std::size_t>> rows_with_;
};

StagedElimination::StagedElimination(const JetEquations& equations,
                                     const JetEquations::Values<Digits>& values, const Jet& jet)
    : size_(equations.point_size()) {
  const Index k = jet.k;
  const Index unknown_count = equations.unknown_count(k), N = size_;
  const auto columns = static_cast<std::size_t>(unknown_count + 1);
  stages_.assign(columns, jets);
  std::fill_n(stages_.begin(), N, point);
  stages_.back() = point;
  std::fill_n(stages_.begin() + N, N, velocities);
  std::fill_n(stages_.begin() + 2 * N, equations.auxiliary_size(), unknowns);
  row_of_pivot_.assign(columns, no_row);

  const auto row_count = static_cast<std::size_t>(equations.row_count(k));
  std::vector<Row> all(row_count);
  for (std::size_t i = 0; i < row_count; ++i) {
    all[i].level = static_cast<Index>(i) / equations.row_size();
    all[i].residual = values.residual[i];
    all[i].residual.settle();
    all[i].source = static_cast<Index>(i);
  }
  const std::vector<JetEquations::Entry> pattern = equations.pattern(k);
  for (std::size_t e = 0; e < pattern.size(); ++e)
    all[static_cast<std::size_t>(pattern[e].row)].entries.append(pattern[e].column,
                                                                 values.entries[e]);
  BinaryScales scales(equations, k);
  scales.update(pattern, values.entries, jet);
  column_scale_ = scales.column;
  for (Index level = 0; level <= k; ++level) {
    const auto first = all.begin() + level * equations.row_size();
    std::vector<Row> block(std::make_move_iterator(first),
                           std::make_move_iterator(first + equations.row_size()));
    for (Row& row : block) reduce(row);
    Block(*this, std::move(block)).find_pivots();
  }
}

// Stage by stage, and in each in the order in which pivots were found: a row has no entry in the pivots before it.
void StagedElimination::reduce(Row& row) const {
  using Place = std::pair<Stage, std::size_t>;
  std::priority_queue<Place, std::vector<Place>, std::greater<>> waiting;
  const auto wait_for = [&](Index column) {
    const std::size_t found = row_of_pivot_[static_cast<std::size_t>(column)];
    if (found != no_row) waiting.emplace(rows_[found].stage, found);
  };
  for (const SparseRow::Entry& entry : row.entries) wait_for(entry.column);
  std::vector<Index> filled;
  while (!waiting.empty()) {
    const std::size_t pivot = waiting.top().second;
    waiting.pop();
    filled.clear();
    subtract(row, pivot, filled);
    for (const Index column : filled) wait_for(column);
  }
}

// row - factor · pivot, in all parts. Columns that are filled are appended.
void StagedElimination::subtract(Row& row, std::size_t pivot, std::vector<Index>& filled) const {
  const Row& other = rows_[pivot];
  const Digits& entry = row.entries[other.pivot];
  if (entry.is_zero()) return;
  const Digits factor = entry / other.entries[other.pivot];
  row.entries.eliminate(other.pivot, factor, other.entries, filled);
  subtract_multiple(&row.residual, factor, &other.residual, 1);
  row.steps.push_back({pivot, factor});
}

// From the row back to those that it was made of, each when all that were made of it have been.
SparseRow StagedElimination::origin(const Row& row) const {
  std::map<std::size_t, Digits, std::greater<>> open;  // by place in rows_
  std::map<Index, Digits> found;                       // by row of F^[k]
  const auto replace = [&](const Row& part, const Digits& weight) {
    if (weight.is_zero()) return;
    found[part.source] = weight;
    for (const Row::Step& step : part.steps)
      subtract_multiple(&open[step.row], step.factor, &weight, 1);
  };
  replace(row, 1.0);
  while (!open.empty()) {
    const auto [place, weight] = *open.begin();
    open.erase(open.begin());
    replace(rows_[place], weight);
  }
  SparseRow result;
  for (const auto& [source, weight] : found) result.append(source, weight);
  return result;
}

Index StagedElimination::count(Stage stage, Index level) const {
  return std::count_if(rows_.begin(), rows_.end(),
                       [&](const Row& row) { return row.stage == stage && row.level <= level; });
}

}  // namespace courant
