// A linear map between coordinate spaces: a matrix that knows when it is the identity.
#pragma once

#include <utility>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// What frames, projectors and bases of tangent spaces are. On Rⁿ they are the identity, which takes
// no memory here and whose products cost nothing, so that n may be 10⁵; elsewhere they are matrices.
// `Scalar` is double or Expr.
//
// A matrix converts to a LinearMap and back. Products have the entries that products of the matrices
// have. Sizes are not checked.
template <class Scalar>
class LinearMap {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  LinearMap() : LinearMap(Matrix()) {}
  LinearMap(Matrix entries)  // NOLINT(google-explicit-constructor)
      : entries_(std::move(entries)) {}
  template <class Derived>
  LinearMap(const Eigen::MatrixBase<Derived>& entries)  // NOLINT(google-explicit-constructor)
      : entries_(entries) {}
  static LinearMap identity(Index size) {
    LinearMap result;
    result.size_ = size;
    return result;
  }

  // Whether it was made as the identity. A matrix that happens to have its entries is not noticed.
  bool is_identity() const { return size_ >= 0; }
  Index rows() const { return is_identity() ? size_ : entries_.rows(); }
  Index cols() const { return is_identity() ? size_ : entries_.cols(); }
  Scalar operator()(Index i, Index j) const {
    if (!is_identity()) return entries_(i, j);
    return i == j ? Scalar(1.0) : Scalar(0.0);
  }

  LinearMap transpose() const {
    return is_identity() ? *this : LinearMap(Matrix(entries_.transpose()));
  }
  // rows() × cols().
  Matrix matrix() const {
    return is_identity() ? Matrix(Matrix::Identity(size_, size_)) : entries_;
  }
  operator Matrix() const { return matrix(); }  // NOLINT(google-explicit-constructor)

  // What is stored: nothing for the identity, which functions that take a basis do not have as an
  // argument.
  const Matrix& entries() const { return entries_; }
  Matrix& entries() { return entries_; }

  friend LinearMap operator*(const LinearMap& A, const LinearMap& B) {
    if (A.is_identity()) return B;
    if (B.is_identity()) return A;
    return LinearMap(Matrix(A.entries_ * B.entries_));
  }
  template <class Other>
  friend auto operator*(const LinearMap& A, const Eigen::MatrixBase<Other>& B) {
    using Result = Eigen::Matrix<Scalar, Eigen::Dynamic, Other::ColsAtCompileTime>;
    return A.is_identity() ? Result(B.template cast<Scalar>()) : Result(A.entries_ * B.derived());
  }
  template <class Other>
  friend auto operator*(const Eigen::MatrixBase<Other>& A, const LinearMap& B) {
    using Result = Eigen::Matrix<Scalar, Other::RowsAtCompileTime, Eigen::Dynamic>;
    return B.is_identity() ? Result(A.template cast<Scalar>()) : Result(A.derived() * B.entries_);
  }

 private:
  Index size_ = -1;  // of the identity; -1 for a matrix
  Matrix entries_;
};

// |A|, entry by entry.
inline LinearMap<double> absolute(const LinearMap<double>& A) {
  return A.is_identity() ? A : LinearMap<double>(Eigen::MatrixXd(A.entries().cwiseAbs()));
}

// Numbers as expressions, and constants as numbers.
inline LinearMap<Expr> constants(const LinearMap<double>& A) {
  return A.is_identity() ? LinearMap<Expr>::identity(A.rows())
                         : LinearMap<Expr>(ExprMatrix(constants(A.entries())));
}
inline LinearMap<double> values(const LinearMap<Expr>& A) {
  return A.is_identity() ? LinearMap<double>::identity(A.rows())
                         : LinearMap<double>(Eigen::MatrixXd(values(A.entries())));
}

}  // namespace courant
