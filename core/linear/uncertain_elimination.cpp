#include "courant/core/linear/uncertain_elimination.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "courant/core/numbers/uncertain.hpp"

namespace courant {
namespace {

// A pivot that is fewer times its error is taken where there is no other.
constexpr double kClear = 10.0;

double margin(const Uncertain& number) {
  return number.error == 0.0 ? std::numeric_limits<double>::infinity()
                             : std::fabs(number.value) / number.error;
}

// The matrix by rows, and what is left of it.
class PivotedRows {
 public:
  explicit PivotedRows(const UncertainMatrix& A)
      : rows_(static_cast<std::size_t>(A.rows()),
              std::vector<Uncertain>(static_cast<std::size_t>(A.cols()))),
        columns_(static_cast<std::size_t>(A.cols())) {
    each(A.value, [&](Uncertain& place, double value) { place.value = value; });
    each(A.error, [&](Uncertain& place, double error) { place.error = error; });
  }

  // Brings the largest pivot to its place; returns it, or 0 where nothing is for certain.
  Uncertain next_pivot() {
    std::size_t row = done_, column = done_;
    bool is_clear = false;
    double largest = 0.0;
    for (std::size_t i = done_; i < rows_.size(); ++i)
      for (std::size_t j = done_; j < columns_; ++j) {
        const Uncertain& entry = rows_[i][j];
        if (!entry.is_nonzero()) continue;
        const bool clear = margin(entry) >= kClear;
        if (clear < is_clear || (clear == is_clear && std::fabs(entry.value) <= largest)) continue;
        is_clear = clear;
        largest = std::fabs(entry.value);
        row = i;
        column = j;
      }
    if (largest == 0.0) return 0.0;
    std::swap(rows_[done_], rows_[row]);
    for (auto& entries : rows_) std::swap(entries[done_], entries[column]);
    return rows_[done_][done_];
  }

  void eliminate() {
    const std::vector<Uncertain>& pivot_row = rows_[done_];
    for (std::size_t i = done_ + 1; i < rows_.size(); ++i) {
      std::vector<Uncertain>& row = rows_[i];
      if (row[done_].is_exactly(0.0)) continue;
      const Uncertain factor = row[done_] / pivot_row[done_];
      for (std::size_t j = done_ + 1; j < columns_; ++j)
        if (!pivot_row[j].is_exactly(0.0)) row[j] -= factor * pivot_row[j];
    }
    ++done_;
  }

  double largest_left() const {
    double largest = 0.0;
    for (std::size_t i = done_; i < rows_.size(); ++i)
      for (std::size_t j = done_; j < columns_; ++j)
        if (rows_[i][j].value != 0.0) largest = std::max(largest, margin(rows_[i][j]));
    return largest;
  }

 private:
  template <class Set>
  void each(const SparseMatrixXd& M, const Set& set) {
    for (Index j = 0; j < M.outerSize(); ++j)
      for (SparseMatrixXd::InnerIterator it(M, j); it; ++it)
        set(rows_[static_cast<std::size_t>(it.row())][static_cast<std::size_t>(j)], it.value());
  }

  std::vector<std::vector<Uncertain>> rows_;
  std::size_t columns_, done_ = 0;
};

}  // namespace

UncertainElimination::UncertainElimination(const UncertainMatrix& A) {
  PivotedRows matrix(A);
  while (rank < std::min(A.rows(), A.cols())) {
    const Uncertain pivot = matrix.next_pivot();
    if (pivot.value == 0.0) break;
    margins.push_back(margin(pivot));
    matrix.eliminate();
    ++rank;
  }
  left = matrix.largest_left();
}

}  // namespace courant
