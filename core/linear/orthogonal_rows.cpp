#include "courant/core/linear/orthogonal_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace courant {
namespace {

DoubleDouble dot(const std::vector<DoubleDouble>& a, const std::vector<DoubleDouble>& b) {
  DoubleDouble sum;
  for (std::size_t j = 0; j < a.size(); ++j)
    if (!a[j].is_zero() && !b[j].is_zero()) sum += a[j] * b[j];
  return sum;
}

double largest(const std::vector<DoubleDouble>& row) {
  double size = 0.0;
  for (const DoubleDouble& entry : row) size = std::max(size, std::fabs(entry.high));
  return size;
}

}  // namespace

OrthogonalRows::OrthogonalRows(Rows rows, double negligible)
    : rows_(std::move(rows)), is_pivot_(rows_.size(), false) {
  std::vector<double> sizes;
  for (const auto& row : rows_) sizes.push_back(largest(row));
  for (;;) {
    std::size_t best = rows_.size();
    double size = negligible;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (!is_pivot_[i] && sizes[i] > size) {
        size = sizes[i];
        best = i;
      }
    if (best == rows_.size()) return;
    is_pivot_[best] = true;
    const std::vector<DoubleDouble>& q = rows_[best];
    Pivot pivot{
        .row = best, .square = dot(q, q), .factors = std::vector<DoubleDouble>(rows_.size())};
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (is_pivot_[i]) continue;
      const DoubleDouble product = dot(rows_[i], q);
      if (product.is_zero()) continue;
      const DoubleDouble factor = product / pivot.square;
      for (std::size_t j = 0; j < q.size(); ++j)
        if (!q[j].is_zero()) rows_[i][j] -= factor * q[j];
      pivot.factors[i] = factor;
      sizes[i] = largest(rows_[i]);
    }
    pivots_.push_back(std::move(pivot));
  }
}

OrthogonalRows::Solution OrthogonalRows::solve(std::vector<DoubleDouble> right) const {
  Solution solution;
  solution.x.resize(rows_.empty() ? 0 : rows_.front().size());
  for (const Pivot& pivot : pivots_) {
    const DoubleDouble part = right[pivot.row];
    if (part.is_zero()) continue;
    const std::vector<DoubleDouble>& q = rows_[pivot.row];
    const DoubleDouble along = part / pivot.square;
    for (std::size_t j = 0; j < q.size(); ++j)
      if (!q[j].is_zero()) solution.x[j] += along * q[j];
    for (std::size_t i = 0; i < right.size(); ++i)
      if (!pivot.factors[i].is_zero()) right[i] -= pivot.factors[i] * part;
  }
  for (std::size_t i = 0; i < right.size(); ++i)
    if (!is_pivot_[i]) solution.left = std::max(solution.left, std::fabs(right[i].high));
  return solution;
}

}  // namespace courant
