#include "courant/core/linear/products.hpp"

#include <boost/test/unit_test.hpp>
#include <random>
#include <type_traits>

namespace courant {
// Mistakes that these cases have to notice:
//  * a transposed factor on the left is taken as it stands
BOOST_AUTO_TEST_SUITE(products_test)

namespace {

using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

MatrixXd random(Eigen::Index rows, Eigen::Index columns) {
  static std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); });
}

// The sums of products, one after the other.
MatrixXd by_hand(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd C = MatrixXd::Zero(A.rows(), B.cols());
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < B.cols(); ++j)
      for (Eigen::Index k = 0; k < A.cols(); ++k) C(i, j) += A(i, k) * B(k, j);
  return C;
}

bool agree(const MatrixXd& A, const MatrixXd& B) {
  return A.rows() == B.rows() && A.cols() == B.cols() &&
         (A.size() == 0 || (A - B).cwiseAbs().maxCoeff() < 1e-13);
}

template <class A, class B>
constexpr bool is_value = std::is_same_v<decltype(std::declval<A>() * std::declval<B>()), MatrixXd>;

}  // namespace

// Small ones and large ones have different kernels.
BOOST_AUTO_TEST_CASE(products_of_matrices_are_those_of_paper) {
  for (const Eigen::Index n : {0, 1, 3, 40}) {
    const MatrixXd A = random(n, n + 2), B = random(n + 2, n + 1), C = random(n + 1, n + 2);
    const MatrixXd D = random(n, n + 1);
    BOOST_TEST(agree(A * B, by_hand(A, B)));
    BOOST_TEST(agree(A * C.transpose(), by_hand(A, C.transpose())));
    BOOST_TEST(agree(A.transpose() * D, by_hand(A.transpose(), D)));
    BOOST_TEST(agree(B.transpose() * A.transpose(), by_hand(B.transpose(), A.transpose())));
  }
}

BOOST_AUTO_TEST_CASE(products_with_vectors_are_those_of_paper) {
  for (const Eigen::Index n : {0, 1, 3, 40}) {
    const MatrixXd A = random(n, n + 2);
    const VectorXd x = random(n + 2, 1), y = random(n, 1);
    BOOST_TEST(agree(A * x, by_hand(A, x)));
    BOOST_TEST(agree(A.transpose() * y, by_hand(A.transpose(), y)));
    BOOST_TEST(agree(y.transpose() * A, by_hand(y.transpose(), A)));
    BOOST_TEST(agree(x.transpose() * A.transpose(), by_hand(x.transpose(), A.transpose())));
    BOOST_TEST(agree(y * x.transpose(), by_hand(y, x.transpose())));
  }
}

BOOST_AUTO_TEST_CASE(parts_and_sums_of_matrices_are_factors) {
  const MatrixXd A = random(5, 6), B = random(5, 6), C = random(4, 3);
  const VectorXd x = random(9, 1);
  BOOST_TEST(agree(A.middleCols(1, 4) * C, by_hand(A.middleCols(1, 4), C)));
  BOOST_TEST(
      agree(A.block(1, 2, 3, 4) * x.segment(2, 4), by_hand(A.block(1, 2, 3, 4), x.segment(2, 4))));
  BOOST_TEST(agree(A * B.row(1).transpose(), by_hand(A, B.row(1).transpose())));
  BOOST_TEST(agree(A.leftCols(4) * C.col(1), by_hand(A.leftCols(4), C.col(1))));
  BOOST_TEST(agree((A - B) * (A + B).transpose(), by_hand(A - B, (A + B).transpose())));
  BOOST_TEST(
      agree(A.cwiseAbs() * x.tail(6).cwiseAbs(), by_hand(A.cwiseAbs(), x.tail(6).cwiseAbs())));
}

// A product is a value: no name of it refers to its factors.
BOOST_AUTO_TEST_CASE(they_are_evaluated_at_once) {
  static_assert(is_value<MatrixXd, MatrixXd>);
  static_assert(is_value<Eigen::Block<MatrixXd>, Eigen::Transpose<const MatrixXd>>);
  static_assert(is_value<VectorXd, Eigen::Transpose<const VectorXd>>);
  MatrixXd A(2, 2);
  A << 0.0, 1.0, 1.0, 1.0;
  VectorXd x(2);
  x << 2.0, 3.0;
  const auto y = A * x;
  x = A * x;
  BOOST_TEST((x[0] == 3.0 && x[1] == 5.0));
  BOOST_TEST(y == x);
}

// What has another form stays with Eigen.
BOOST_AUTO_TEST_CASE(numbers_and_fixed_sizes_are_left_to_eigen) {
  static_assert(!products::Factors<Eigen::Transpose<VectorXd>, VectorXd>);
  static_assert(!products::Factors<Eigen::Matrix3d, Eigen::Vector3d>);
  static_assert(!products::Factors<Eigen::Map<const Eigen::Matrix2d>, VectorXd>);
  static_assert(!products::Factors<double, VectorXd>);
  const VectorXd x = VectorXd::Constant(4, 0.5);
  BOOST_TEST(double(x.transpose() * x) == 1.0);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
