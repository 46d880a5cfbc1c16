#include "courant/core/linear/product_scaling.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

namespace courant {
// Mistakes that these cases have to notice:
//  * the length of a path is forgotten
BOOST_AUTO_TEST_SUITE(product_scaling_test)

namespace {

MatrixXd scaled(const MatrixXd& A) {
  const ProductScaling units{SparseMatrixXd(A.sparseView())};
  return units.row_scale.asDiagonal() * A * units.column_scale.asDiagonal();
}

// Entries O(1), some of them zero, with a diagonal.
MatrixXd random_matrix(Index n, std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  MatrixXd A =
      MatrixXd::NullaryExpr(n, n, [&] { return generator() % 3 == 0 ? uniform(generator) : 0.0; });
  for (double& entry : A.diagonal()) entry = uniform(generator);
  return A;
}

VectorXd random_scales(Index n, std::mt19937& generator) {
  return VectorXd::NullaryExpr(
      n, [&] { return std::exp2(static_cast<double>(generator() % 81) - 40.0); });
}

// The product of the n entries of a permutation that is largest, by trying all of them.
double largest_product(const MatrixXd& A) {
  std::vector<Index> order(static_cast<std::size_t>(A.rows()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  double largest = 0.0;
  do {
    double product = 1.0;
    for (std::size_t i = 0; i < order.size(); ++i)
      product *= std::fabs(A(static_cast<Index>(i), order[i]));
    largest = std::max(largest, product);
  } while (std::next_permutation(order.begin(), order.end()));
  return largest;
}

}  // namespace

// Entries of at most 1, and a permutation of entries of 1, each to the factor that powers of two and
// the mean of two scalings leave.
BOOST_AUTO_TEST_CASE(a_matching_of_ones_is_largest) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Index n = 1 + static_cast<Index>(generator() % 6);
    const MatrixXd A = random_scales(n, generator).asDiagonal() * random_matrix(n, generator) *
                       random_scales(n, generator).asDiagonal();
    const MatrixXd S = scaled(A);
    BOOST_TEST(S.cwiseAbs().maxCoeff() <= 2.0);
    BOOST_TEST(largest_product(S) >= std::pow(0.5, static_cast<double>(n)));
  }
}

// Where a least squares fit of logarithms would bring all entries as near to each other as it can.
BOOST_AUTO_TEST_CASE(small_entries_change_nothing) {
  std::mt19937 generator(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Index n = 2 + static_cast<Index>(generator() % 20);
    const MatrixXd A = random_matrix(n, generator);
    const MatrixXd noisy = (A.array() == 0.0).select(MatrixXd::Constant(n, n, 1e-10), A);
    BOOST_TEST((scaled(noisy).array() * (A.array() == 0.0).cast<double>()).maxCoeff() < 1e-8);
  }
}

// More rows than columns, lines of zeros, nothing at all: what is matched is 1, no line is larger.
BOOST_AUTO_TEST_CASE(matrices_without_a_perfect_matching) {
  MatrixXd A(4, 3);
  A << 1e6, 0, 0,  //
      1e3, 0, 0,   //
      0, 0, 2e-5,  //
      0, 0, 0;
  const MatrixXd S = scaled(A);
  for (const Index i : {0, 1}) BOOST_TEST((S(i, 0) >= 0.5 && S(i, 0) <= 2.0));
  BOOST_TEST((S(2, 2) >= 0.5 && S(2, 2) <= 2.0));
  const ProductScaling none{SparseMatrixXd(0, 0)};
  BOOST_TEST(none.row_scale.size() == 0);
  const ProductScaling zeros{SparseMatrixXd(2, 3)};
  BOOST_TEST((zeros.row_scale.array() == 1.0).all());
  BOOST_TEST((zeros.column_scale.array() == 1.0).all());
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
