#include "courant/integrators/certificate/row_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "courant/core/numbers/uncertain.hpp"

namespace courant {
namespace {

// A row with bounds of the errors of its entries: also of entries that are zero within them.
using UncertainRow = std::vector<std::pair<Index, Uncertain>>;

// What an elimination leaves where numbers cancel is zero if it is within the bound of its error. The
// bound grows with every elimination, whether the error does or not: beyond this part of the largest
// entry that the row was made of it says nothing.
constexpr double largest_relative_bound = 1e-6;

bool is_zero(const Uncertain& entry, double scale, double most) {
  return !(std::fabs(entry.value) > std::min(entry.error, most * scale));
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
void clean(UncertainRow& row, double scale, double most) {
  for (auto& [column, entry] : row)
    if (is_zero(entry, scale, most)) entry = {0.0, entry.error + std::fabs(entry.value)};
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
                 const std::vector<Index>& column_group, RowReduction::Pivots pivots)
      : column_group_(column_group),
        pivots_(pivots),
        relative_bound_(pivots == RowReduction::Pivots::largest
                            ? std::numeric_limits<double>::infinity()
                            : largest_relative_bound),
        rows_(static_cast<std::size_t>(A.rows())),
        rows_of_column_(static_cast<std::size_t>(A.cols())),
        is_changed_(rows_.size(), false) {
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
    // The best pivot of each row that has one.
    std::set<Pivot> waiting;
    std::vector<std::optional<Pivot>> of_row(rows_.size());
    const auto look_at = [&](Index i) {
      std::optional<Pivot>& known = of_row[static_cast<std::size_t>(i)];
      if (known) waiting.erase(*known);
      known = best_pivot(g, i);
      if (known) waiting.insert(*known);
    };
    std::vector<bool> is_candidate(rows_.size(), false);
    for (const Index i : candidates) {
      is_candidate[static_cast<std::size_t>(i)] = true;
      look_at(i);
    }
    while (!waiting.empty()) {
      const Pivot best = *waiting.begin();
      Working& pivot = rows_[static_cast<std::size_t>(best.row)];
      pivot.done = true;
      pivot.row.pivot = best.column;
      clear_column(pivot, best.column);
      note_change(best.row);
      for (const Index i : std::exchange(changed_, {})) {
        is_changed_[static_cast<std::size_t>(i)] = false;
        if (is_candidate[static_cast<std::size_t>(i)]) look_at(i);
      }
      found.push_back(&pivot);
    }
  }

  const std::vector<Working>& rows() const { return rows_; }
  // The part of the largest number that went into a row up to which bounds count.
  double relative_bound() const { return relative_bound_; }

 private:
  // Better ones first: what costs least; among equals the largest.
  struct Pivot {
    double cost, size;
    Index row, column;
    bool operator<(const Pivot& other) const {
      return std::tie(cost, other.size, row, column) <
             std::tie(other.cost, size, other.row, other.column);
    }
  };

  // That of a row in the columns of group g; none if the row is done or has nothing there.
  std::optional<Pivot> best_pivot(Index g, Index i) const {
    const Working& working = rows_[static_cast<std::size_t>(i)];
    if (working.done) return std::nullopt;
    double row_max = 0.0;
    for (const auto& [column, number] : working.entries)
      if (column_group_[static_cast<std::size_t>(column)] == g)
        row_max = std::max(row_max, std::fabs(number.value));
    if (row_max == 0.0) return std::nullopt;
    std::optional<Pivot> best;
    for (const auto& [column, number] : working.entries) {
      const double size = std::fabs(number.value);
      if (column_group_[static_cast<std::size_t>(column)] != g || size < 0.1 * row_max) continue;
      const Pivot pivot = {cost(working.entries, column, number), size, i, column};
      if (!best || pivot < *best) best = pivot;
    }
    return best;
  }

  // How much it fills in, by the count of Markowitz; or whether its bound is more than a tenth of it.
  double cost(const UncertainRow& row, Index column, const Uncertain& number) const {
    constexpr double clear = 10.0;
    if (pivots_ == RowReduction::Pivots::largest)
      return std::fabs(number.value) >= clear * number.error ? 0.0 : 1.0;
    const std::vector<Index>& rows = rows_of_column_[static_cast<std::size_t>(column)];
    return (static_cast<double>(row.size()) - 1.0) * (static_cast<double>(rows.size()) - 1.0);
  }

  // Another pivot of this row may be its best one now.
  void note_change(Index i) {
    if (is_changed_[static_cast<std::size_t>(i)]) return;
    is_changed_[static_cast<std::size_t>(i)] = true;
    changed_.push_back(i);
  }

  // Eliminates `column` from all rows that come later: of the level of the pivot or above.
  void clear_column(const Working& pivot, Index column) {
    const Uncertain pivot_value = entry(pivot.entries, column);
    const std::vector<Index> targets = std::move(rows_of_column_[static_cast<std::size_t>(column)]);
    rows_of_column_[static_cast<std::size_t>(column)].clear();
    std::vector<Index> filled;
    for (const Index i : targets) {
      note_change(i);
      Working& target = rows_[static_cast<std::size_t>(i)];
      if (target.done || target.row.level < pivot.row.level) continue;
      const Uncertain value = entry(target.entries, column);
      if (value.is_exactly(0.0)) continue;
      const Uncertain factor = -value / pivot_value;
      target.scale = std::max(target.scale, std::fabs(factor.value) * pivot.scale);
      UncertainRow sum = combined(target.entries, factor, pivot.entries);
      std::erase_if(sum, [&](const auto& e) { return e.first == column; });
      clean(sum, target.scale, relative_bound_);
      for (const auto& e : sum)
        if (entry(target.entries, e.first).is_exactly(0.0)) {
          rows_of_column_[static_cast<std::size_t>(e.first)].push_back(i);
          filled.push_back(e.first);
        }
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
    // The count of a column matters to all rows that have an entry in it.
    std::sort(filled.begin(), filled.end());
    filled.erase(std::unique(filled.begin(), filled.end()), filled.end());
    for (const Index j : filled)
      for (const Index i : rows_of_column_[static_cast<std::size_t>(j)]) note_change(i);
  }

  const std::vector<Index>& column_group_;
  RowReduction::Pivots pivots_;
  double relative_bound_;
  std::vector<Working> rows_;
  std::vector<std::vector<Index>> rows_of_column_;  // those that have, or had, an entry there
  std::vector<Index> changed_;                      // see note_change()
  std::vector<bool> is_changed_;
};

// The same rows with the pivot columns of the other rows eliminated too, each with 1 in its pivot.
std::vector<RowReduction::Row> reduced(std::vector<RowReduction::Row> rows,
                                       std::vector<UncertainRow> entries, double relative_bound) {
  // The rows that have, or had, an entry in the pivot column of a row.
  std::unordered_map<Index, std::vector<std::size_t>> rows_of_pivot;
  for (const RowReduction::Row& row : rows) rows_of_pivot[row.pivot];
  const auto note = [&](Index column, std::size_t i) {
    if (const auto found = rows_of_pivot.find(column); found != rows_of_pivot.end())
      found->second.push_back(i);
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Uncertain lead = entry(entries[i], rows[i].pivot);
    for (auto& [column, number] : entries[i]) {
      number = number / lead;
      note(column, i);
    }
  }
  for (std::size_t p = rows.size(); p-- > 0;) {
    for (const std::size_t i : std::exchange(rows_of_pivot[rows[p].pivot], {})) {
      if (i >= p) continue;
      const Uncertain value = entry(entries[i], rows[p].pivot);
      if (value.is_exactly(0.0)) continue;
      const double scale =
          std::max(largest(entries[i]), std::fabs(value.value) * largest(entries[p]));
      for (const auto& [column, number] : entries[p])
        if (entry(entries[i], column).is_exactly(0.0)) note(column, i);
      entries[i] = combined(entries[i], -value, entries[p]);
      std::erase_if(entries[i], [&](const auto& e) { return e.first == rows[p].pivot; });
      clean(entries[i], scale, relative_bound);
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
                           const std::vector<Index>& column_group, Pivots pivots) {
  const Index levels =
      row_level.empty() ? 0 : 1 + *std::max_element(row_level.begin(), row_level.end());
  const Index groups =
      column_group.empty() ? 0 : 1 + *std::max_element(column_group.begin(), column_group.end());
  std::vector<std::vector<Index>> rows_of_level(static_cast<std::size_t>(levels));
  for (std::size_t i = 0; i < row_level.size(); ++i)
    rows_of_level[static_cast<std::size_t>(row_level[i])].push_back(static_cast<Index>(i));

  RowElimination elimination(A, row_level, column_group, pivots);
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
    reduced_groups_.push_back(reduced(rows, std::move(of_group), elimination.relative_bound()));
  }
  for (const auto& working : elimination.rows())
    if (!working.done) zero_rows_.push_back(working.row);
}

}  // namespace courant
