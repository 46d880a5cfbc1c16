#include "courant/core/linear/generalized_eigenvalues.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

namespace courant {
namespace {

// How often the pencil is turned where QZ does not end.
constexpr int kTurns = 8;

// The power of two that brings the geometric mean of the entries that are not zero near 1.
template <class A, class B>
double power_of_two(const A& a, const B& b) {
  double exponents = 0.0;
  int count = 0;
  const auto add = [&](double entry) {
    if (entry == 0.0) return;
    exponents += std::log2(std::abs(entry));
    ++count;
  };
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    add(a[i]);
    add(b[i]);
  }
  return count > 0 ? std::exp2(-std::round(exponents / count)) : 1.0;
}

// Rows and columns of about one size, by powers of two: an equivalent pencil, which has the same eigenvalues. Where units of
// columns differ by 10⁻⁹, as those of charges and fluxes do, QZ may not converge. Source: R. C. Ward (1981), with the mean
// logarithms taken of rows and columns in turn.
void balance(Eigen::MatrixXd& A, Eigen::MatrixXd& B) {
  constexpr int most_rounds = 50;
  bool changes = true;
  for (int round = 0; changes && round < most_rounds; ++round) {
    changes = false;
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      const double scale = power_of_two(A.row(i), B.row(i));
      changes = changes || scale != 1.0;
      A.row(i) *= scale;
      B.row(i) *= scale;
    }
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      const double scale = power_of_two(A.col(j), B.col(j));
      changes = changes || scale != 1.0;
      A.col(j) *= scale;
      B.col(j) *= scale;
    }
  }
}

// (1 - 2 u uᵀ) M (1 - 2 w wᵀ)
void turn(Eigen::MatrixXd& M, const Eigen::VectorXd& u, const Eigen::VectorXd& w) {
  M -= 2.0 * u * (u.transpose() * M).eval();
  M -= 2.0 * (M * w).eval() * w.transpose();
}

}  // namespace

GeneralizedEigenvalues generalized_eigenvalues(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                               const Eigen::Ref<const Eigen::MatrixXd>& B) {
  if (A.rows() != A.cols() || B.rows() != B.cols() || A.rows() != B.rows())
    throw std::invalid_argument("generalized_eigenvalues: A is " + std::to_string(A.rows()) +
                                " × " + std::to_string(A.cols()) + " and B " +
                                std::to_string(B.rows()) + " × " + std::to_string(B.cols()) +
                                "; expected square matrices of one size.");
  if (A.rows() == 0) return {Eigen::VectorXcd(0), Eigen::VectorXd(0)};
  if (!A.allFinite() || !B.allFinite())
    throw std::domain_error("generalized_eigenvalues: an entry is not finite.");
  Eigen::MatrixXd left = A, right = B;
  balance(left, right);
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return Eigen::VectorXd::NullaryExpr(A.rows(), [&] { return normal(generator); })
        .eval()
        .normalized()
        .eval();
  };
  for (int turns = 0; turns <= kTurns; ++turns) {
    const Eigen::GeneralizedEigenSolver<Eigen::MatrixXd> eigen(left, right, false);
    if (eigen.info() == Eigen::Success) return {eigen.alphas(), eigen.betas()};
    const Eigen::VectorXd u = direction(), w = direction();
    turn(left, u, w);
    turn(right, u, w);
  }
  throw std::runtime_error("generalized_eigenvalues: the QZ algorithm does not converge.");
}

}  // namespace courant
