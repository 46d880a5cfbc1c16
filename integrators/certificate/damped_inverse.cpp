#include "courant/integrators/certificate/damped_inverse.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

DampedInverse::DampedInverse(const SparseMatrixXd& S, const VectorXd& cost, double mu)
    : m_(S.rows()), cost_(cost) {
  const Index n = S.cols();
  // Scales of numbers that are 10²⁰⁰ apart leave the range of doubles.
  is_finite_ = S.coeffs().isFinite().all() && std::isfinite(mu);
  if (!is_finite_) return;
  if (!is_factored_dense(S)) {
    const double root = std::sqrt(std::max(mu, 1e-10));
    saddle_.emplace(sparse_diagonal(root * cost.cwiseAbs2()), S, root);
  } else if (mu == 0.0) {
    least_norm_.emplace(MatrixXd(S * cost.cwiseInverse().asDiagonal()), kNegligible);
  } else {
    MatrixXd stacked = MatrixXd::Zero(m_ + n, n);
    stacked.topRows(m_) = S;
    stacked.bottomRows(n).diagonal() = std::sqrt(mu) * cost;
    damped_.emplace(QrDecomposition::in_order(stacked));
  }
}

VectorXd DampedInverse::step(const VectorXd& g) const {
  if (!is_finite_ || !g.allFinite()) return VectorXd();
  if (saddle_) return saddle_->solve(VectorXd::Zero(saddle_->columns()), -g);
  if (least_norm_) return cost_.cwiseInverse().asDiagonal() * least_norm_->solve(-g);
  VectorXd right = VectorXd::Zero(damped_->rows());
  right.head(m_) = -g;
  return damped_->solve(right);
}

VectorXd kernel_part(const SparseMatrixXd& S, const VectorXd& direction) {
  const VectorXd normal = DampedInverse(S, VectorXd::Ones(S.cols()), 0.0).step(-(S * direction));
  return normal.size() == 0 ? VectorXd(VectorXd::Zero(direction.size())) : direction - normal;
}

}  // namespace courant
