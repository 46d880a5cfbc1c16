#include "courant/integrators/ladder/row_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace courant {
namespace {

constexpr double relative_zero = 1e-9;

// a + factor · b, without entries below `least`.
SparseEntries combined(const SparseEntries& a, double factor, const SparseEntries& b,
                       double least) {
  SparseEntries sum;
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
    if (std::abs(sum.back().second) <= least) sum.pop_back();
  }
  return sum;
}

double entry(const SparseEntries& row, Index column) {
  const auto found = std::lower_bound(row.begin(), row.end(), column,
                                      [](const auto& e, Index c) { return e.first < c; });
  return found != row.end() && found->first == column ? found->second : 0.0;
}

double largest(const SparseEntries& row) {
  double size = 0.0;
  for (const auto& [column, value] : row) size = std::max(size, std::abs(value));
  return size;
}

// The matrix while it is reduced.
class Elimination {
 public:
  struct Working {
    RowReduction::Row row;
    double scale = 0.0;  // largest entry that went into it
    bool done = false;
  };

  Elimination(const Eigen::SparseMatrix<double>& S, const std::vector<Index>& row_level,
              const std::vector<Index>& column_group)
      : column_group_(column_group),
        rows_(static_cast<std::size_t>(S.rows())),
        rows_of_column_(static_cast<std::size_t>(S.cols())) {
    for (Index j = 0; j < S.cols(); ++j)
      for (Eigen::SparseMatrix<double>::InnerIterator it(S, j); it; ++it) {
        if (it.value() == 0.0) continue;
        rows_[static_cast<std::size_t>(it.row())].row.entries.emplace_back(j, it.value());
        rows_of_column_[static_cast<std::size_t>(j)].push_back(it.row());
      }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows_[i].row.level = row_level[i];
      rows_[i].row.pivot = -1;
      rows_[i].row.multipliers = {{static_cast<Index>(i), 1.0}};
      rows_[i].scale = largest(rows_[i].row.entries);
    }
  }

  // Finds pivots in the columns of group g among the given rows while there are any.
  void eliminate(Index g, const std::vector<Index>& candidates,
                 std::vector<RowReduction::Row>& found) {
    while (true) {
      const auto [pivot_row, column] = cheapest_pivot(g, candidates);
      if (pivot_row < 0) return;
      Working& pivot = rows_[static_cast<std::size_t>(pivot_row)];
      pivot.done = true;
      pivot.row.pivot = column;
      clear_column(pivot, column);
      found.push_back(pivot.row);
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
      for (const auto& [column, value] : working.row.entries)
        if (column_group_[static_cast<std::size_t>(column)] == g)
          row_max = std::max(row_max, std::abs(value));
      if (row_max == 0.0) continue;
      const auto row_count = static_cast<double>(working.row.entries.size());
      for (const auto& [column, value] : working.row.entries) {
        if (column_group_[static_cast<std::size_t>(column)] != g || std::abs(value) < 0.1 * row_max)
          continue;
        const auto column_count =
            static_cast<double>(rows_of_column_[static_cast<std::size_t>(column)].size());
        const double cost = (row_count - 1.0) * (column_count - 1.0);
        if (cost < least_cost || (cost == least_cost && std::abs(value) > best_size)) {
          best = {i, column};
          least_cost = cost;
          best_size = std::abs(value);
        }
      }
    }
    return best;
  }

  // Eliminates `column` from all rows that come later: of the level of the pivot or above.
  void clear_column(const Working& pivot, Index column) {
    const double pivot_value = entry(pivot.row.entries, column);
    const std::vector<Index> targets = std::move(rows_of_column_[static_cast<std::size_t>(column)]);
    rows_of_column_[static_cast<std::size_t>(column)].clear();
    for (const Index i : targets) {
      Working& target = rows_[static_cast<std::size_t>(i)];
      if (target.done || target.row.level < pivot.row.level) continue;
      const double value = entry(target.row.entries, column);
      if (value == 0.0) continue;
      const double factor = -value / pivot_value;
      target.scale = std::max(target.scale, std::abs(factor) * pivot.scale);
      SparseEntries sum =
          combined(target.row.entries, factor, pivot.row.entries, relative_zero * target.scale);
      std::erase_if(sum, [&](const auto& e) { return e.first == column; });
      for (const auto& e : sum)
        if (entry(target.row.entries, e.first) == 0.0)
          rows_of_column_[static_cast<std::size_t>(e.first)].push_back(i);
      target.row.entries = std::move(sum);
      const SparseEntries& m = pivot.row.multipliers;
      const double size = std::max(largest(target.row.multipliers), std::abs(factor) * largest(m));
      target.row.multipliers = combined(target.row.multipliers, factor, m, relative_zero * size);
    }
  }

  const std::vector<Index>& column_group_;
  std::vector<Working> rows_;
  std::vector<std::vector<Index>> rows_of_column_;  // those that have, or had, an entry there
};

}  // namespace

RowReduction::RowReduction(const Eigen::SparseMatrix<double>& A,
                           const std::vector<Index>& row_level,
                           const std::vector<Index>& column_group) {
  const Index levels =
      row_level.empty() ? 0 : 1 + *std::max_element(row_level.begin(), row_level.end());
  const Index groups =
      column_group.empty() ? 0 : 1 + *std::max_element(column_group.begin(), column_group.end());
  std::vector<std::vector<Index>> rows_of_level(static_cast<std::size_t>(levels));
  for (std::size_t i = 0; i < row_level.size(); ++i)
    rows_of_level[static_cast<std::size_t>(row_level[i])].push_back(static_cast<Index>(i));

  Elimination elimination(A, row_level, column_group);
  groups_.resize(static_cast<std::size_t>(groups));
  for (Index g = 0; g < groups; ++g)
    for (const std::vector<Index>& candidates : rows_of_level)
      elimination.eliminate(g, candidates, groups_[static_cast<std::size_t>(g)]);
  for (const auto& working : elimination.rows())
    if (!working.done) zero_rows_.push_back(working.row);
}

std::vector<RowReduction::Row> RowReduction::reduced_group(Index g) const {
  std::vector<Row> rows = group(g);
  for (Row& row : rows) {
    row.multipliers.clear();
    const double lead = entry(row.entries, row.pivot);
    for (auto& [column, value] : row.entries) value /= lead;
  }
  for (std::size_t p = rows.size(); p-- > 0;) {
    for (std::size_t i = 0; i < p; ++i) {
      const double value = entry(rows[i].entries, rows[p].pivot);
      if (value == 0.0) continue;
      const double size =
          std::max(largest(rows[i].entries), std::abs(value) * largest(rows[p].entries));
      rows[i].entries = combined(rows[i].entries, -value, rows[p].entries, relative_zero * size);
    }
  }
  return rows;
}

}  // namespace courant
