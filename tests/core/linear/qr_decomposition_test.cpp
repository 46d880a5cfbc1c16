#include "courant/core/linear/qr_decomposition.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../random_matrix.hpp"

// Mistakes that these cases have to notice:
//  * the columns' order is not undone
BOOST_AUTO_TEST_SUITE(qr_decomposition)

using namespace courant;

namespace {

MatrixXd permuted(const MatrixXd& A, const std::vector<Index>& order) {
  MatrixXd result(A.rows(), A.cols());
  for (Index j = 0; j < A.cols(); ++j) result.col(j) = A.col(order[static_cast<std::size_t>(j)]);
  return result;
}

constexpr std::pair<Index, Index> sizes[] = {{0, 0}, {0, 3}, {3, 0}, {1, 1},
                                             {5, 3}, {3, 5}, {4, 4}, {60, 55}};

}  // namespace

BOOST_AUTO_TEST_CASE(product_of_the_factors) {
  for (const auto& [m, n] : sizes) {
    const MatrixXd A = random_matrix(m, n, 1);
    for (const auto& qr : {QrDecomposition::in_order(A), QrDecomposition::pivoted(A)}) {
      const MatrixXd Q = qr.Q();
      const double bound = 1e-13 * (1.0 + A.norm());
      BOOST_TEST((Q.transpose() * Q - MatrixXd::Identity(m, m)).norm() < bound);
      const Index k = std::min(m, n);
      BOOST_TEST((qr.Q(k) * qr.R(k) - permuted(A, qr.order())).norm() < bound);
      BOOST_TEST((qr.diagonal() - qr.R(k).diagonal()).norm() == 0.0);
      for (Index j = 0; j < k; ++j) BOOST_TEST(qr.R(k).col(j).tail(k - 1 - j).norm() == 0.0);
      const MatrixXd B = random_matrix(m, 2, 2);
      BOOST_TEST((qr.product(B) - Q * B).norm() < bound);
      BOOST_TEST((qr.transposed_product(B) - Q.transpose() * B).norm() < bound);
    }
  }
}

BOOST_AUTO_TEST_CASE(pivots_decrease) {
  const MatrixXd A = random_matrix(7, 5, 1) * VectorXd::LinSpaced(5, 1.0, 9.0).asDiagonal();
  const VectorXd pivots = QrDecomposition::pivoted(A).diagonal().cwiseAbs();
  for (Index j = 1; j < 5; ++j) BOOST_TEST(pivots[j] <= pivots[j - 1]);
  const std::vector<Index> as_given = {0, 1, 2, 3, 4};
  BOOST_TEST(QrDecomposition::in_order(A).order() == as_given);
  BOOST_TEST(QrDecomposition::pivoted(A).order().front() == 4);
}

BOOST_AUTO_TEST_CASE(least_squares) {
  for (const auto& [m, n] : sizes) {
    if (n > m) continue;
    const MatrixXd A = random_matrix(m, n, 4), B = random_matrix(m, 2, 5);
    for (const auto& qr : {QrDecomposition::in_order(A), QrDecomposition::pivoted(A)})
      BOOST_TEST((A.transpose() * (A * qr.solve(B) - B)).norm() < 1e-11);
  }
  BOOST_CHECK_THROW(QrDecomposition::in_order(MatrixXd::Ones(2, 3)).solve(MatrixXd::Ones(2, 1)),
                    std::invalid_argument);
  BOOST_CHECK_THROW(QrDecomposition::in_order(MatrixXd::Ones(3, 2)).solve(MatrixXd::Ones(2, 1)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(orthonormalized_columns_keep_their_span) {
  const MatrixXd A = random_matrix(6, 3, 6), Q = orthonormalized(A);
  BOOST_TEST((Q.transpose() * Q - MatrixXd::Identity(3, 3)).norm() < 1e-14);
  BOOST_TEST((Q * (Q.transpose() * A) - A).norm() < 1e-14 * A.norm());
}

BOOST_AUTO_TEST_SUITE_END()
