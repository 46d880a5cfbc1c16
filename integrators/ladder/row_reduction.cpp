#include "courant/integrators/ladder/row_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace courant {
namespace {

// A row with bounds of the errors of its entries: also of entries that are zero within them.
using UncertainRow = std::vector<std::pair<Index, Uncertain>>;

// What an elimination leaves where numbers cancel is zero if it is within the bound of its error. The
// bound grows with every elimination, whether the error does or not: beyond this part of the largest
// entry that the row was made of it says nothing.
constexpr double relative_bound = 1e-6;

bool is_zero(const Uncertain& entry, double scale) {
  return std::fabs(entry.value) <= std::min(entry.error, relative_bound * scale);
}

// a + factor · b; `scale` is the size of the entries that go into it.
template <class Number>
std::vector<std::pair<Index, Number>> combined(const std::vector<std::pair<Index, Number>>& a,
                                               const Number& factor,
                                               const std::vector<std::pair<Index, Number>>& b) {
  std::vector<std::pair<Index, Number>> sum;
  sum.reserve(a.size() + b.size());
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() || j != b.end()) {
    if (j == b.end() || (i != a.end() && i->first < j->first)) {
      sum.push_back(*i++);
    } else if (i == a.end() || j->first < i->first) {
      sum.emplace_back(j->first, factor * j->second);
      ++j;
    } else {
      sum.emplace_back(i->first, i->second + factor * j->second);
      ++i, ++j;
    }
  }
  return sum;
}

// Entries that are zero are set to it, with their error, or left out where there is none.
void clean(UncertainRow& row, double scale) {
  for (auto& [column, entry] : row)
    if (is_zero(entry, scale)) entry = {0.0, entry.error + std::fabs(entry.value)};
  std::erase_if(row, [](const auto& e) { return e.second.is_exactly(0.0); });
}

Uncertain entry(const UncertainRow& row, Index column) {
  const auto found = std::lower_bound(row.begin(), row.end(), column,
                                      [](const auto& e, Index c) { return e.first < c; });
  return found != row.end() && found->first == column ? found->second : Uncertain(0.0);
}

double largest(const UncertainRow& row) {
  double size = 0.0;
  for (const auto& [column, number] : row) size = std::max(size, std::fabs(number.value));
  return size;
}

SparseEntries numbers(const UncertainRow& row) {
  SparseEntries result;
  for (const auto& [column, number] : row)
    if (number.value != 0.0) result.emplace_back(column, number.value);
  return result;
}

SparseEntries errors(const UncertainRow& row) {
  SparseEntries result;
  for (const auto& [column, number] : row)
    if (number.error != 0.0) result.emplace_back(column, number.error);
  return result;
}

// The matrix while it is reduced.
class RowElimination {
 public:
  struct Working {
    RowReduction::Row row;  // without entries
    UncertainRow entries;
    double scale = 0.0;  // largest entry that went into it
    bool done = false;
  };

  RowElimination(const UncertainMatrix& A, const std::vector<Index>& row_level,
                 const std::vector<Index>& column_group)
      : column_group_(column_group),
        rows_(static_cast<std::size_t>(A.rows())),
        rows_of_column_(static_cast<std::size_t>(A.cols())) {
    for (Index j = 0; j < A.cols(); ++j) {
      SparseMatrixXd::InnerIterator value(A.value, j), error(A.error, j);
      while (value || error) {
        const Index i = std::min(value ? value.row() : A.rows(), error ? error.row() : A.rows());
        Uncertain number;
        if (value && value.row() == i) {
          number.value = value.value();
          ++value;
        }
        if (error && error.row() == i) {
          number.error = error.value();
          ++error;
        }
        if (number.is_exactly(0.0)) continue;
        rows_[static_cast<std::size_t>(i)].entries.emplace_back(j, number);
        rows_of_column_[static_cast<std::size_t>(j)].push_back(i);
      }
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows_[i].row.level = row_level[i];
      rows_[i].row.pivot = -1;
      rows_[i].row.multipliers = {{static_cast<Index>(i), 1.0}};
      rows_[i].scale = largest(rows_[i].entries);
    }
  }

  // Finds pivots in the columns of group g among the given rows while there are any.
  void eliminate(Index g, const std::vector<Index>& candidates,
                 std::vector<const Working*>& found) {
    while (true) {
      const auto [pivot_row, column] = cheapest_pivot(g, candidates);
      if (pivot_row < 0) return;
      Working& pivot = rows_[static_cast<std::size_t>(pivot_row)];
      pivot.done = true;
      pivot.row.pivot = column;
      clear_column(pivot, column);
      found.push_back(&pivot);
    }
  }

  const std::vector<Working>& rows() const { return rows_; }

 private:
  // The pivot that fills in least, by the count of Markowitz; among equals the largest.
  std::pair<Index, Index> cheapest_pivot(Index g, const std::vector<Index>& candidates) const {
    std::pair<Index, Index> best = {-1, -1};
    double least_cost = std::numeric_limits<double>::infinity(), best_size = 0.0;
    for (const Index i : candidates) {
      const Working& working = rows_[static_cast<std::size_t>(i)];
      if (working.done) continue;
      double row_max = 0.0;
      for (const auto& [column, number] : working.entries)
        if (column_group_[static_cast<std::size_t>(column)] == g)
          row_max = std::max(row_max, std::fabs(number.value));
      if (row_max == 0.0) continue;
      const auto row_count = static_cast<double>(working.entries.size());
      for (const auto& [column, number] : working.entries) {
        const double size = std::fabs(number.value);
        if (column_group_[static_cast<std::size_t>(column)] != g || size < 0.1 * row_max) continue;
        const auto column_count =
            static_cast<double>(rows_of_column_[static_cast<std::size_t>(column)].size());
        const double cost = (row_count - 1.0) * (column_count - 1.0);
        if (cost < least_cost || (cost == least_cost && size > best_size)) {
          best = {i, column};
          least_cost = cost;
          best_size = size;
        }
      }
    }
    return best;
  }

  // Eliminates `column` from all rows that come later: of the level of the pivot or above.
  void clear_column(const Working& pivot, Index column) {
    const Uncertain pivot_value = entry(pivot.entries, column);
    const std::vector<Index> targets = std::move(rows_of_column_[static_cast<std::size_t>(column)]);
    rows_of_column_[static_cast<std::size_t>(column)].clear();
    for (const Index i : targets) {
      Working& target = rows_[static_cast<std::size_t>(i)];
      if (target.done || target.row.level < pivot.row.level) continue;
      const Uncertain value = entry(target.entries, column);
      if (value.is_exactly(0.0)) continue;
      const Uncertain factor = -value / pivot_value;
      target.scale = std::max(target.scale, std::fabs(factor.value) * pivot.scale);
      UncertainRow sum = combined(target.entries, factor, pivot.entries);
      std::erase_if(sum, [&](const auto& e) { return e.first == column; });
      clean(sum, target.scale);
      for (const auto& e : sum)
        if (entry(target.entries, e.first).is_exactly(0.0))
          rows_of_column_[static_cast<std::size_t>(e.first)].push_back(i);
      target.entries = std::move(sum);
      if (factor.value == 0.0) continue;
      target.row.multipliers =
          combined(target.row.multipliers, factor.value, pivot.row.multipliers);
      double size = 0.0;
      for (const auto& [row, number] : target.row.multipliers)
        size = std::max(size, std::fabs(number));
      std::erase_if(target.row.multipliers,
                    [&](const auto& e) { return std::fabs(e.second) <= 1e-12 * size; });
    }
  }

  const std::vector<Index>& column_group_;
  std::vector<Working> rows_;
  std::vector<std::vector<Index>> rows_of_column_;  // those that have, or had, an entry there
};

// The same rows with the pivot columns of the other rows eliminated too, each with 1 in its pivot.
std::vector<RowReduction::Row> reduced(std::vector<RowReduction::Row> rows,
                                       std::vector<UncertainRow> entries) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Uncertain lead = entry(entries[i], rows[i].pivot);
    for (auto& [column, number] : entries[i]) number = number / lead;
  }
  for (std::size_t p = rows.size(); p-- > 0;) {
    for (std::size_t i = 0; i < p; ++i) {
      const Uncertain value = entry(entries[i], rows[p].pivot);
      if (value.is_exactly(0.0)) continue;
      const double scale =
          std::max(largest(entries[i]), std::fabs(value.value) * largest(entries[p]));
      entries[i] = combined(entries[i], -value, entries[p]);
      std::erase_if(entries[i], [&](const auto& e) { return e.first == rows[p].pivot; });
      clean(entries[i], scale);
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].multipliers.clear();
    rows[i].entries = numbers(entries[i]);
    rows[i].errors = errors(entries[i]);
  }
  return rows;
}

}  // namespace

RowReduction::RowReduction(const UncertainMatrix& A, const std::vector<Index>& row_level,
                           const std::vector<Index>& column_group) {
  const Index levels =
      row_level.empty() ? 0 : 1 + *std::max_element(row_level.begin(), row_level.end());
  const Index groups =
      column_group.empty() ? 0 : 1 + *std::max_element(column_group.begin(), column_group.end());
  std::vector<std::vector<Index>> rows_of_level(static_cast<std::size_t>(levels));
  for (std::size_t i = 0; i < row_level.size(); ++i)
    rows_of_level[static_cast<std::size_t>(row_level[i])].push_back(static_cast<Index>(i));

  RowElimination elimination(A, row_level, column_group);
  for (Index g = 0; g < groups; ++g) {
    std::vector<const RowElimination::Working*> found;
    for (const std::vector<Index>& candidates : rows_of_level)
      elimination.eliminate(g, candidates, found);
    std::vector<Row>& rows = groups_.emplace_back();
    std::vector<UncertainRow> of_group;
    for (const auto* working : found) {
      rows.push_back(working->row);
      rows.back().entries = numbers(working->entries);
      rows.back().errors = errors(working->entries);
      of_group.push_back(working->entries);
    }
    reduced_groups_.push_back(reduced(rows, std::move(of_group)));
  }
  for (const auto& working : elimination.rows())
    if (!working.done) zero_rows_.push_back(working.row);
}

}  // namespace courant
