#include "courant/core/linear/sparse_rank_decision.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>

#include "courant/core/linear/equilibration.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/linear/rank_cut.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/core/linear/sparse_qr.hpp"

namespace courant {
namespace {

MatrixXd random_block(Index rows, Index columns) {
  std::mt19937 generator(20250612);
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(generator); });
}

// ‖S‖ by the power method; from a random start twelve steps are within a few per cent.
double norm(const SparseMatrixXd& S) {
  VectorXd x = random_block(S.cols(), 1);
  for (int step = 0; step < 12; ++step) x = (S.transpose() * (S * x.normalized())).eval();
  return std::sqrt(x.norm());
}

// The b smallest singular values of R, decreasing, and their left singular vectors.
struct SmallestSingular {
  VectorXd values;
  MatrixXd left;
};

// Inverse iteration with a block of b vectors, a half step with R⁻ᵀ and one with R⁻¹ in turn so
// that nothing is squared, until the smallest value moves by less than 5 % a step. Values are
// approached from above. Nothing if R is so close to singular that R⁻¹ overflows.
std::optional<SmallestSingular> smallest_singular(const SparseMatrixXd& R, Index b) {
  const auto upper = R.triangularView<Eigen::Upper>();
  const SparseMatrixXd transposed = R.transpose();
  const auto lower = transposed.triangularView<Eigen::Lower>();
  MatrixXd right = orthonormalized(random_block(R.cols(), b));
  SmallestSingular result;
  double previous = 0.0;
  for (int step = 0; step < 30; ++step) {
    MatrixXd left = lower.solve(right);
    if (!left.allFinite()) return std::nullopt;
    left = orthonormalized(left);
    right = upper.solve(left);
    if (!right.allFinite()) return std::nullopt;
    right = orthonormalized(right);

    // Of Rᵀ·left, tall, through its triangular factor.
    const auto [values, U, V] =
        singular_value_decomposition(QrDecomposition::in_order(transposed * left).R(b));
    result = {values, left * V};
    const double smallest = result.values[b - 1];
    if (std::abs(smallest - previous) <= 0.05 * smallest) break;
    previous = smallest;
  }
  return result;
}

}  // namespace

RankDecision decide_rank(const SparseMatrixXd& A, const RankOptions& options) {
  const SparseMatrixXd S =
      options.magnitude > 0.0 ? A : equilibrate(A, entry_noise(options)).scaled;
  RankDecision decision;
  decision.rows = A.rows();
  decision.columns = A.cols();
  const double largest = S.nonZeros() > 0 ? norm(S) : 0.0;
  const NoiseLevel noise = noise_level(A.rows(), A.cols(), largest, options);
  const double number = noise.number * noise.floor;
  if (S.nonZeros() == 0) {
    conclude(decision, 0, 0.0, 0.0, noise);
    return decision;
  }

  // A column that is left with a few roundings is dependent; with ten of them QR has to keep it.
  const auto [R, W, dropped] = sparse_qr(S, 10.0 * noise.floor);
  const Index r = R.rows();
  if (r == 0) {
    conclude(decision, 0, 0.0, dropped, noise);
    return decision;
  }
  Index block = std::min<Index>(8, r);
  std::optional<SmallestSingular> smallest = smallest_singular(R, block);
  while (smallest && block < r && smallest->values[0] <= number) {
    block = std::min(2 * block, r);
    smallest = smallest_singular(R, block);
  }
  if (!smallest) {  // QR saw r, R says less: ambiguous
    conclude(decision, r, 0.0, dropped, noise);
    return decision;
  }

  // The other directions u of [R W], those with uᵀR ≈ 0: uᵀW may be a number where uᵀR is not.
  const Index regular = (smallest->values.array() > number).count();
  const Index rest = block - regular;
  MatrixXd remainder(rest + W.cols(), rest);  // its transpose is [diag(σ) uᵀW]
  remainder << MatrixXd(smallest->values.tail(rest).asDiagonal()),
      W.transpose() * smallest->left.rightCols(rest);
  VectorXd values(block);
  values << smallest->values.head(regular), singular_values(remainder);
  std::sort(values.begin(), values.end(), std::greater<>());

  const Index kept = count_above_cut(values, noise);
  const Index rank = r - block + kept;
  double above = kept > 0 ? values[kept - 1] : 0.0;
  double below = std::hypot(values.tail(block - kept).norm(), dropped);
  if (rank == std::min(A.rows(), A.cols())) {  // no value comes after σ_r, which δ may make smaller
    above = std::max(0.0, above - dropped);
    below = 0.0;
  }
  conclude(decision, rank, above, below, noise);
  decision.singular_values.resize(kept + 2);
  decision.singular_values << largest, values.head(kept), below;
  return decision;
}

}  // namespace courant
