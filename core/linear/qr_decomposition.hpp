// A P = Q R.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace courant {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A matrix A (m × n, sizes may be 0) with its columns permuted, as the product of an orthogonal Q
// (m × m) and an upper trapezoid R (m × n), by Householder reflections.
//
//   in_order   the columns as they are
//   pivoted    each column the longest of what the earlier ones leave: |r_11| ≥ |r_22| ≥ …, close
//              to the singular values of A
//
// No rank is decided here: see CompleteOrthogonalDecomposition.
class QrDecomposition {
 public:
  QrDecomposition() = default;  // of the 0 × 0 matrix
  static QrDecomposition in_order(const Eigen::Ref<const MatrixXd>& A);
  static QrDecomposition pivoted(const Eigen::Ref<const MatrixXd>& A);

  Index rows() const { return factors_.rows(); }
  Index cols() const { return factors_.cols(); }

  // Column order()[j] of A is column j of A P.
  const std::vector<Index>& order() const { return order_; }
  VectorXd diagonal() const { return factors_.diagonal(); }  // of R, min(m, n) entries

  // The first k rows of R, k × n.
  MatrixXd R(Index k) const;
  // The first k columns of Q. Those of a matrix with independent columns, k = n, span its range.
  MatrixXd Q(Index k) const;
  MatrixXd Q() const { return Q(rows()); }

  // Qᵀ B and Q B, B with m rows.
  MatrixXd transposed_product(const Eigen::Ref<const MatrixXd>& B) const;
  MatrixXd product(const Eigen::Ref<const MatrixXd>& B) const;

  // argmin ‖A X - B‖ for an A with n ≤ m independent columns, B with m rows. n × k.
  MatrixXd solve(const Eigen::Ref<const MatrixXd>& B) const;

 private:
  QrDecomposition(const Eigen::Ref<const MatrixXd>& A, bool pivots);

  MatrixXd factors_;       // R, and the reflections' vectors below its diagonal
  VectorXd coefficients_;  // of the reflections
  std::vector<Index> order_;
};

// Orthonormal columns with the span of those of A, which are independent.
MatrixXd orthonormalized(const Eigen::Ref<const MatrixXd>& A);

}  // namespace courant
