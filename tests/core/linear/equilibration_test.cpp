#include "courant/core/linear/equilibration.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

namespace courant {
// Mistakes that these cases have to notice:
//  * what is left of a zero is scaled up to no number
BOOST_AUTO_TEST_SUITE(equilibration_test)

namespace {

constexpr double noise = 1e-14;

// A few entries of a random matrix, many of them zero, sizes over five decades.
MatrixXd random_matrix(Index m, Index n, std::mt19937& generator) {
  std::uniform_real_distribution<double> exponent(-2.5, 2.5);
  return MatrixXd::NullaryExpr(m, n, [&] {
    const double size = std::pow(10.0, exponent(generator));
    return generator() % 3 == 0 ? size : generator() % 2 == 0 ? -size : 0.0;
  });
}

VectorXd random_scales(Index n, std::mt19937& generator) {
  return VectorXd::NullaryExpr(
      n, [&] { return std::pow(1e6, static_cast<int>(generator() % 3) - 1); });
}

// The largest factor by which entries of A and B differ; infinite where one is zero and the other
// is not.
double largest_ratio(const MatrixXd& A, const MatrixXd& B) {
  double ratio = 1.0;
  for (Index k = 0; k < A.size(); ++k) {
    const double a = std::abs(A(k)), b = std::abs(B(k));
    if (a != b) ratio = std::max({ratio, a / b, b / a});
  }
  return ratio;
}

}  // namespace

BOOST_AUTO_TEST_CASE(levels_maxima_by_powers_of_two) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Index m = static_cast<Index>(generator() % 9), n = static_cast<Index>(generator() % 9);
    const MatrixXd A = random_scales(m, generator).asDiagonal() * random_matrix(m, n, generator) *
                       random_scales(n, generator).asDiagonal();
    const auto [scaled, r, c] = equilibrate(A, noise);
    BOOST_TEST((scaled - r.asDiagonal() * A * c.asDiagonal()).norm() == 0.0);
    for (const double scale : r) BOOST_TEST(std::exp2(std::round(std::log2(scale))) == scale);
    for (Index i = 0; i < m && n > 0; ++i) {
      const double largest = scaled.row(i).cwiseAbs().maxCoeff();
      BOOST_TEST((A.row(i).isZero(0.0) ? r[i] == 1.0 : largest > 0.2 && largest < 5.0));
    }
    for (Index j = 0; j < n && m > 0; ++j) {
      const double largest = scaled.col(j).cwiseAbs().maxCoeff();
      BOOST_TEST((A.col(j).isZero(0.0) ? c[j] == 1.0 : largest > 0.2 && largest < 5.0));
    }
  }
}

BOOST_AUTO_TEST_CASE(undoes_scales) {
  std::mt19937 generator(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Index m = 1 + static_cast<Index>(generator() % 8);
    const Index n = 1 + static_cast<Index>(generator() % 8);
    const MatrixXd A = random_matrix(m, n, generator);
    const MatrixXd scaled =
        random_scales(m, generator).asDiagonal() * A * random_scales(n, generator).asDiagonal();
    // Rounding row and column exponents moves each entry by at most 2, once on either side.
    BOOST_TEST(largest_ratio(equilibrate(A, noise).scaled, equilibrate(scaled, noise).scaled) <
               6.0);
    const MatrixXd transposed = equilibrate(A.transpose(), noise).scaled.transpose();
    const MatrixXd reversed = equilibrate(A.colwise().reverse(), noise).scaled.colwise().reverse();
    BOOST_TEST(largest_ratio(equilibrate(A, noise).scaled, transposed) < 6.0);
    BOOST_TEST(largest_ratio(equilibrate(A, noise).scaled, reversed) < 6.0);
  }
}

BOOST_AUTO_TEST_CASE(sparse_is_the_same) {
  std::mt19937 generator(3);
  for (int trial = 0; trial < 50; ++trial) {
    const MatrixXd A = random_matrix(7, 9, generator);
    const auto dense = equilibrate(A, noise);
    const auto sparse = equilibrate(SparseMatrixXd(A.sparseView()), noise);
    BOOST_TEST((MatrixXd(sparse.scaled) - dense.scaled).norm() == 0.0);
    BOOST_TEST(sparse.row_scale == dense.row_scale);
    BOOST_TEST(sparse.column_scale == dense.column_scale);
  }
}

BOOST_AUTO_TEST_CASE(drops_noise_but_not_small_numbers) {
  const auto dropped = [](double x) {
    return equilibrate(MatrixXd{{1, 1, 0}, {1, 1, x}, {0, 0, 1}}, noise).scaled(1, 2) == 0.0;
  };
  BOOST_TEST(dropped(1e-15));
  BOOST_TEST(!dropped(1e-12));
}

// A column of nothing but what is left of a zero, next to a row of ones.
BOOST_AUTO_TEST_CASE(numbers_whose_scale_is_no_number) {
  for (const double left : {1e-320, 3e-308, 1e-300}) BOOST_TEST_CONTEXT(left) {
      const Equilibration<MatrixXd> S =
          equilibrate(MatrixXd{{1e10, 1e10, left}, {1e10, -1e10, 0}}, noise);
      BOOST_TEST(S.scaled.allFinite());
      BOOST_TEST(S.row_scale.allFinite());
      BOOST_TEST(S.column_scale.allFinite());
      BOOST_TEST((S.scaled(0, 2) == 0.0) == (left < 1e-310));
    }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
