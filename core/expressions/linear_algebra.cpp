#include "courant/core/expressions/linear_algebra.hpp"

#include <bit>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace courant {
namespace {

constexpr Index kMostRows = 16;  // bits of the minors; they are too many before that

// Determinants of parts of X by expansion along the first row, each computed once.
class Minors {
 public:
  explicit Minors(const ExprMatrix& X) : X_(X) {}
  // Of the rows and columns whose bits are set, as many of both.
  Expr operator()(unsigned rows, unsigned columns) {
    if (rows == 0) return 1.0;
    const auto key = std::pair(rows, columns);
    if (const auto known = known_.find(key); known != known_.end()) return known->second;
    const int row = std::countr_zero(rows);
    Expr sum = 0.0;
    bool is_plus = true;
    for (unsigned left = columns; left != 0; left &= left - 1, is_plus = !is_plus) {
      const int column = std::countr_zero(left);
      const Expr& entry = X_(row, column);
      if (entry.is_constant(0.0)) continue;
      const Expr term = entry * (*this)(rows & (rows - 1), columns & ~(1U << column));
      sum = is_plus ? sum + term : sum - term;
    }
    known_.emplace(key, sum);
    return sum;
  }

 private:
  const ExprMatrix& X_;
  std::map<std::pair<unsigned, unsigned>, Expr> known_;
};

unsigned all_rows(const ExprMatrix& A, const char* function) {
  if (A.rows() != A.cols() || A.rows() > kMostRows)
    throw std::invalid_argument(std::string(function) + ": A is " + std::to_string(A.rows()) +
                                " x " + std::to_string(A.cols()) +
                                "; expected a square matrix of at most " +
                                std::to_string(kMostRows) + " rows.");
  return (1U << A.rows()) - 1U;
}

void require_square(const ExprMatrix& A, const ExprMatrix& b, const char* function) {
  if (A.cols() != A.rows() || b.rows() != A.rows())
    throw std::invalid_argument(std::string(function) + ": A is " + std::to_string(A.rows()) +
                                " x " + std::to_string(A.cols()) + " and b has " +
                                std::to_string(b.rows()) +
                                " rows; expected a square A with as many rows as b.");
}

// Takes unknown k out of the rows below row k; false, and nothing is done, if its pivot is identically zero.
bool eliminate(Index k, ExprMatrix& A, ExprMatrix& b) {
  if (A(k, k).is_constant(0.0)) return false;
  for (Index i = k + 1; i < A.rows(); ++i) {
    const Expr factor = A(i, k) / A(k, k);
    if (factor.is_constant(0.0)) continue;
    for (Index j = k + 1; j < A.rows(); ++j) A(i, j) -= factor * A(k, j);
    for (Index j = 0; j < b.cols(); ++j) b(i, j) -= factor * b(k, j);
  }
  return true;
}

// U⁻¹ b, of the upper triangle U of A.
ExprMatrix back_substituted(const ExprMatrix& A, ExprMatrix b) {
  for (Index k = A.rows() - 1; k >= 0; --k) {
    for (Index i = k + 1; i < A.rows(); ++i) {
      if (A(k, i).is_constant(0.0)) continue;
      for (Index j = 0; j < b.cols(); ++j) b(k, j) -= A(k, i) * b(i, j);
    }
    for (Index j = 0; j < b.cols(); ++j) b(k, j) = b(k, j) / A(k, k);
  }
  return b;
}

}  // namespace

Expr determinant(const ExprMatrix& A) {
  const unsigned all = all_rows(A, "determinant");
  return Minors(A)(all, all);
}

ExprMatrix adjugate(const ExprMatrix& A) {
  const unsigned all = all_rows(A, "adjugate");
  Minors minors(A);
  ExprMatrix result(A.rows(), A.rows());
  for (Index i = 0; i < A.rows(); ++i)
    for (Index j = 0; j < A.rows(); ++j) {
      const Expr minor = minors(all & ~(1U << j), all & ~(1U << i));
      result(i, j) = (i + j) % 2 == 0 ? minor : -minor;
    }
  return result;
}

ExprMatrix solve(ExprMatrix A, ExprMatrix b) {
  require_square(A, b, "solve");
  for (Index k = 0; k < A.rows(); ++k)
    if (!eliminate(k, A, b))
      throw std::domain_error("solve: pivot " + std::to_string(k) +
                              " is identically zero; expected regular leading minors.");
  return back_substituted(A, std::move(b));
}

ExprMatrix solve_semidefinite(ExprMatrix A, ExprMatrix b) {
  require_square(A, b, "solve_semidefinite");
  for (Index k = 0; k < A.rows(); ++k)
    if (!eliminate(k, A, b)) {  // then row k of what is left is zero
      A.row(k).setConstant(0.0);
      A(k, k) = 1.0;
      b.row(k).setConstant(0.0);
    }
  return back_substituted(A, std::move(b));
}

}  // namespace courant
