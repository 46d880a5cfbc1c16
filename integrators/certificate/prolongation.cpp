#include "courant/integrators/certificate/prolongation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace courant {

bool is_finite(const Linearization& at) {
  if (!at.value.allFinite()) return false;
  for (Index j = 0; j < at.jacobian.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(at.jacobian, j); it; ++it)
      if (!std::isfinite(it.value())) return false;
  return true;
}

void UncertainEntries::add(Index row, Index column, const Uncertain& entry) {
  if (!entry.is_exactly(0.0)) entries_.push_back({row, column, entry});
}

void UncertainEntries::fill(Linearization& result, Index rows, Index columns) {
  // By column in the order in which they came, then by row within each: columns are short.
  std::vector<std::size_t> start(static_cast<std::size_t>(columns) + 1, 0);
  for (const Entry& entry : entries_) ++start[static_cast<std::size_t>(entry.column) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Entry> sorted(entries_.size());
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for (const Entry& entry : entries_)
    sorted[next[static_cast<std::size_t>(entry.column)]++] = entry;

  for (SparseMatrixXd* matrix : {&result.jacobian, &result.error}) {
    matrix->resize(rows, columns);
    matrix->reserve(static_cast<Index>(entries_.size()));
  }
  for (Index column = 0; column < columns; ++column) {
    const auto first =
        sorted.begin() + static_cast<std::ptrdiff_t>(start[static_cast<std::size_t>(column)]);
    const auto last =
        sorted.begin() + static_cast<std::ptrdiff_t>(start[static_cast<std::size_t>(column) + 1]);
    std::stable_sort(first, last, [](const Entry& a, const Entry& b) { return a.row < b.row; });
    result.jacobian.startVec(column);
    result.error.startVec(column);
    for (auto at = first; at != last;) {
      const Index row = at->row;
      Uncertain sum = at->number;
      for (++at; at != last && at->row == row; ++at) sum += at->number;
      // What is not finite stays for whoever uses the matrix to see.
      const bool is_zero = std::fabs(sum.value) <= sum.error && std::isfinite(sum.error);
      if (!is_zero) result.jacobian.insertBack(row, column) = sum.value;
      result.error.insertBack(row, column) = sum.error + (is_zero ? std::fabs(sum.value) : 0.0);
    }
  }
  result.jacobian.finalize();
  result.error.finalize();
}

VectorXd Prolongation::rounding(const VectorXd& y) {
  return y.unaryExpr([](double number) { return Uncertain::rounded(number).error; });
}

Index Prolongation::level_of(const VectorXd& y) const {
  const Index block = base_size_ + auxiliary_size_;
  const Index blocks = block == 0 ? 1 : (y.size() - base_size_) / block;
  if (blocks < 1 || y.size() != base_size_ + blocks * block)
    throw std::invalid_argument(
        "Prolongation::level_of: y has " + std::to_string(y.size()) +
        " entries; expected n + (k+1)(n+m) with n = " + std::to_string(base_size_) +
        ", m = " + std::to_string(auxiliary_size_) + ".");
  return blocks - 1;
}

}  // namespace courant
