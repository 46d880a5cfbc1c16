#include "courant/integrators/certificate/staged_elimination.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "courant/integrators/certificate/binary_scales.hpp"

namespace courant {
namespace {

constexpr std::int64_t no_entry = std::numeric_limits<std::int64_t>::min();

std::size_t nonzero_count(const StagedElimination::Row& row) {
  return static_cast<std::size_t>(
      std::count_if(row.entries.begin(), row.entries.end(),
                    [](const Digits& entry) { return !entry.is_zero(); }));
}

// row - factor · pivot, in all parts.
void subtract_row(StagedElimination::Row& row, const StagedElimination::Row& pivot) {
  const auto column = static_cast<std::size_t>(pivot.pivot);
  if (row.entries[column].is_zero()) return;
  const Digits factor = row.entries[column] / pivot.entries[column];
  subtract_multiple(row.entries.data(), factor, pivot.entries.data(), row.entries.size());
  row.entries[column] = Digits();
  subtract_multiple(&row.residual, factor, &pivot.residual, 1);
  subtract_multiple(row.origin.data(), factor, pivot.origin.data(), row.origin.size());
}

}  // namespace

StagedElimination::StagedElimination(const JetEquations& equations,
                                     const JetEquations::Values<Digits>& values, const Jet& jet,
                                     bool with_origins)
    : size_(equations.point_size()) {
  const Index k = jet.k;
  const Index unknown_count = equations.unknown_count(k), N = size_;
  const auto columns = static_cast<std::size_t>(unknown_count + 1);
  stages_.assign(columns, jets);
  std::fill_n(stages_.begin(), N, point);
  stages_.back() = point;
  std::fill_n(stages_.begin() + N, N, velocities);
  std::fill_n(stages_.begin() + 2 * N, equations.auxiliary_size(), unknowns);

  const auto row_count = static_cast<std::size_t>(equations.row_count(k));
  std::vector<Row> all(row_count);
  for (std::size_t i = 0; i < row_count; ++i) {
    all[i].level = static_cast<Index>(i) / equations.row_size();
    all[i].entries.resize(columns);
    all[i].residual = values.residual[i];
    all[i].residual.settle();
    if (!with_origins) continue;
    all[i].origin.resize(row_count);
    all[i].origin[i] = 1.0;
  }
  const std::vector<JetEquations::Entry> pattern = equations.pattern(k);
  for (std::size_t e = 0; e < pattern.size(); ++e) {
    Digits entry = values.entries[e];
    all[static_cast<std::size_t>(pattern[e].row)]
        .entries[static_cast<std::size_t>(pattern[e].column)] = entry.settle();
  }
  BinaryScales scales(equations, k);
  scales.update(pattern, values.entries, jet);
  column_scale_ = scales.column;
  for (Index level = 0; level <= k; ++level) {
    const auto first = all.begin() + level * equations.row_size();
    std::vector<Row> block(std::make_move_iterator(first),
                           std::make_move_iterator(first + equations.row_size()));
    for (Row& row : block) reduce(row);
    find_pivots(block, level);
  }
}

void StagedElimination::reduce(Row& row) const {
  for (int stage = jets; stage < dependent; ++stage)
    for (const Row& before : rows_)
      if (before.stage == stage) subtract_row(row, before);
}

void StagedElimination::find_pivots(std::vector<Row>& block, Index level) {
  // Rows with few entries first, among pivots that are not much smaller than the largest.
  constexpr std::int64_t much_smaller = 10;
  for (int stage = jets; stage < dependent; ++stage) {
    for (;;) {
      std::vector<std::int64_t> row_scale(block.size(), no_entry);  // the largest entry of each row
      std::optional<std::size_t> best;
      std::size_t best_column = 0, least_entries = 0;
      std::int64_t largest = no_entry, best_exponent = no_entry;
      std::vector<std::pair<std::int64_t, std::size_t>> candidates(block.size(), {no_entry, 0});
      for (std::size_t i = 0; i < block.size(); ++i) {
        if (block[i].stage != dependent) continue;
        for (std::size_t j = 0; j < stages_.size(); ++j) {
          const Digits& entry = block[i].entries[j];
          if (entry.is_zero()) continue;
          const std::int64_t e = entry.exponent() + column_scale_[j];
          row_scale[i] = std::max(row_scale[i], e);
          if (stages_[j] == stage && e > candidates[i].first) candidates[i] = {e, j};
        }
        // Of its own row: the scale of an equation decides nothing.
        if (candidates[i].first != no_entry)
          largest = std::max(largest, candidates[i].first - row_scale[i]);
      }
      if (largest == no_entry) break;
      for (std::size_t i = 0; i < block.size(); ++i) {
        if (candidates[i].first == no_entry) continue;
        const std::int64_t e = candidates[i].first - row_scale[i];
        if (e < largest - much_smaller) continue;
        const std::size_t entries = nonzero_count(block[i]);
        if (best && entries >= least_entries) continue;
        best = i;
        best_column = candidates[i].second;
        least_entries = entries;
        best_exponent = e;
      }
      Row& pivot = block[*best];
      pivot.stage = static_cast<Stage>(stage);
      pivot.pivot = static_cast<Index>(best_column);
      smallest_pivot_ = std::min(smallest_pivot_, best_exponent);
      for (Row& row : block)
        if (row.stage == dependent) subtract_row(row, pivot);
      rows_.push_back(pivot);
      rows_.back().level = level;
    }
  }
  for (Row& row : block)
    if (row.stage == dependent) rows_.push_back(std::move(row));
}

Index StagedElimination::count(Stage stage, Index level) const {
  return std::count_if(rows_.begin(), rows_.end(),
                       [&](const Row& row) { return row.stage == stage && row.level <= level; });
}

}  // namespace courant
