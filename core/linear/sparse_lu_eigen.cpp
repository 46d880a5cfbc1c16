#include <Eigen/SparseLU>

#include "courant/core/linear/sparse_lu.hpp"

namespace courant {

struct SparseLu::Factors : Eigen::SparseLU<SparseLu::Matrix, Eigen::COLAMDOrdering<int>> {
  Eigen::VectorXd rotated;

  // u_jj stands in the supernode of column j.
  Eigen::VectorXd pivots() const {
    Eigen::VectorXd result(cols());
    for (Eigen::Index j = 0; j < cols(); ++j)
      for (typename SCMatrix::InnerIterator entry(m_Lstore, j); entry; ++entry)
        if (entry.index() == j) result[j] = entry.value();
    return result;
  }
};

SparseLu::SparseLu(const Matrix& S) : factors_(std::make_unique<Factors>()) {
  if (S.rows() > 0) factors_->analyzePattern(S);
}
SparseLu::~SparseLu() = default;

bool SparseLu::factorize(const Matrix& S) {
  if (S.rows() == 0) return true;
  factors_->factorize(S);
  return factors_->info() == Eigen::Success;
}

void SparseLu::forget() {}  // keeps no pivots

double SparseLu::pivot_ratio() const {
  if (factors_->cols() == 0) return 1.0;
  const Eigen::VectorXd pivots = factors_->pivots().cwiseAbs();
  return pivots.minCoeff() / pivots.maxCoeff();
}

int SparseLu::orientation() const {
  if (factors_->cols() == 0) return 1;
  const double sign = factors_->signDeterminant();
  return sign > 0.0 ? 1 : sign < 0.0 ? -1 : 0;
}

void SparseLu::solve(double* b) const {
  if (factors_->cols() == 0) return;
  Eigen::Map<Eigen::VectorXd> x(b, factors_->cols());
  factors_->rotated = x;
  x = factors_->solve(factors_->rotated);
}

}  // namespace courant
