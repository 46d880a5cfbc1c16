#include "courant/core/linear/equilibration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "courant/core/linear/plain_products.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

// Of the powers of two that scales are.
constexpr double kMostExponent = 1022.0;

// An entry a_ij ≠ 0 of the matrix, by its size log₂|a_ij|.
struct Entry {
  Index row, column;
  double size;
};

// Sizes of the entries and logarithms of the scales, r = 2^row and c = 2^column.
class Scaling {
 public:
  Scaling(Index rows, Index columns)
      : row_(VectorXd::Zero(rows)), column_(VectorXd::Zero(columns)) {}

  void add(Index row, Index column, double value) {
    if (!std::isfinite(value)) {
      throw std::domain_error("equilibrate: entry (" + std::to_string(row) + ", " +
                              std::to_string(column) + ") of the matrix is " + number_text(value) +
                              "; expected a finite number.");
    }
    // The scale of a subnormal number may be none itself.
    if (std::abs(value) >= std::numeric_limits<double>::min())
      entries_.push_back({row, column, std::log2(std::abs(value))});
  }

  // Brings every row and column maximum to 1. The distance from that halves in each sweep: entries
  // as far apart as 1e±24 are within a factor of 1.3 after eight.
  void level_maxima() {
    for (int sweep = 0; sweep < 8; ++sweep) {
      constexpr double none = -std::numeric_limits<double>::infinity();
      VectorXd row_max = VectorXd::Constant(row_.size(), none);
      VectorXd column_max = VectorXd::Constant(column_.size(), none);
      for (const Entry& entry : entries_) {
        const double size = scaled_size(entry);
        row_max[entry.row] = std::max(row_max[entry.row], size);
        column_max[entry.column] = std::max(column_max[entry.column], size);
      }
      row_ -= 0.5 * row_max.array().isFinite().select(row_max, 0.0).matrix();
      column_ -= 0.5 * column_max.array().isFinite().select(column_max, 0.0).matrix();
    }
  }

  void forget_entries_below(double noise) {
    const double least = std::log2(noise);
    std::erase_if(entries_, [&](const Entry& entry) { return scaled_size(entry) <= least; });
  }

  // The least squares problem of Curtis and Reid by conjugate gradients, whose products programs in C repeat. Half a bit is all that
  // rounding to powers of two leaves of the result, and on a graph of m + n vertices whose diameter
  // is beyond the limit of iterations, far ends need not be comparable to that accuracy.
  void level_sizes() {
    const Index m = row_.size(), n = column_.size();
    VectorXd count = VectorXd::Zero(m + n), residual = VectorXd::Zero(m + n);
    for (const Entry& entry : entries_) {
      for (const Index vertex : {entry.row, m + entry.column}) {
        count[vertex] += 1.0;
        residual[vertex] -= scaled_size(entry);
      }
    }
    count = count.cwiseMax(1.0);

    VectorXd step = VectorXd::Zero(m + n), direction = VectorXd::Zero(m + n);
    double previous = 1.0;
    for (int iteration = 0; iteration < 300; ++iteration) {
      const VectorXd preconditioned = residual.cwiseQuotient(count);
      if (preconditioned.size() == 0 || preconditioned.lpNorm<Eigen::Infinity>() < 0.05) break;
      const double current = plain_product(residual.data(), preconditioned.data(), m + n);
      direction = preconditioned + (current / previous) * direction;
      VectorXd image = VectorXd::Zero(m + n);
      for (const Entry& entry : entries_) {
        const double sum = direction[entry.row] + direction[m + entry.column];
        image[entry.row] += sum;
        image[m + entry.column] += sum;
      }
      const double length = current / plain_product(direction.data(), image.data(), m + n);
      step += length * direction;
      residual -= length * image;
      previous = current;
    }
    row_ += step.head(m);
    column_ += step.tail(n);
  }

  VectorXd row_scale() const { return powers_of_two(row_); }
  VectorXd column_scale() const { return powers_of_two(column_); }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  double scaled_size(const Entry& entry) const {
    return entry.size + row_[entry.row] + column_[entry.column];
  }

  static VectorXd powers_of_two(const VectorXd& exponent) {
    return exponent.unaryExpr([](double e) {
      return std::exp2(std::clamp(std::round(e), -kMostExponent, kMostExponent));
    });
  }

  std::vector<Entry> entries_;
  VectorXd row_, column_;
};

void balance(Scaling& scaling, double noise) {
  scaling.level_maxima();
  scaling.forget_entries_below(noise);
  scaling.level_sizes();
  scaling.level_maxima();
}

}  // namespace

Equilibration<MatrixXd> equilibrate(const Eigen::Ref<const MatrixXd>& A, double noise) {
  Scaling scaling(A.rows(), A.cols());
  for (Index j = 0; j < A.cols(); ++j) {
    for (Index i = 0; i < A.rows(); ++i) scaling.add(i, j, A(i, j));
  }
  balance(scaling, noise);
  Equilibration<MatrixXd> result{MatrixXd::Zero(A.rows(), A.cols()), scaling.row_scale(),
                                 scaling.column_scale()};
  for (const auto& [i, j, size] : scaling.entries()) {
    result.scaled(i, j) = A(i, j) * result.row_scale[i] * result.column_scale[j];
  }
  return result;
}

Equilibration<SparseMatrixXd> equilibrate(const SparseMatrixXd& A, double noise) {
  Scaling scaling(A.rows(), A.cols());
  for (Index j = 0; j < A.cols(); ++j) {
    for (SparseMatrixXd::InnerIterator it(A, j); it; ++it) scaling.add(it.row(), j, it.value());
  }
  balance(scaling, noise);
  Equilibration<SparseMatrixXd> result{SparseMatrixXd(A.rows(), A.cols()), scaling.row_scale(),
                                       scaling.column_scale()};
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(scaling.entries().size());
  for (const auto& [i, j, size] : scaling.entries()) {
    triplets.emplace_back(static_cast<int>(i), static_cast<int>(j),
                          A.coeff(i, j) * result.row_scale[i] * result.column_scale[j]);
  }
  result.scaled.setFromTriplets(triplets.begin(), triplets.end());
  return result;
}

}  // namespace courant
