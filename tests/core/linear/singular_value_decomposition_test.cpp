#include "courant/core/linear/singular_value_decomposition.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/core/linear/qr_decomposition.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * V is left as its transpose (core/linear/singular_value_decomposition_lapack.cpp)
BOOST_AUTO_TEST_SUITE(singular_value_decomposition_test)

namespace {

class Random {
 public:
  MatrixXd matrix(Eigen::Index m, Eigen::Index n) {
    return MatrixXd::NullaryExpr(m, n, [&] { return normal_(generator_); });
  }
  MatrixXd orthogonal(Eigen::Index n) { return orthonormalized(matrix(n, n)); }
  Eigen::Index below(Eigen::Index count) {
    return static_cast<Eigen::Index>(generator_() % static_cast<unsigned long>(count));
  }

 private:
  std::mt19937 generator_{1};
  std::normal_distribution<double> normal_;
};

void check(const MatrixXd& A) {
  const Eigen::Index k = std::min(A.rows(), A.cols());
  const auto [values, U, V] = singular_value_decomposition(A);
  BOOST_TEST(values.size() == k);
  for (Eigen::Index i = 1; i < k; ++i) BOOST_TEST(values[i] <= values[i - 1]);
  const double bound = 1e-13 * (1.0 + A.norm());
  BOOST_TEST((U.leftCols(k) * values.asDiagonal() * V.leftCols(k).transpose() - A).norm() < bound);
  BOOST_TEST((U.transpose() * U - MatrixXd::Identity(A.rows(), A.rows())).norm() < 1e-13);
  BOOST_TEST((V.transpose() * V - MatrixXd::Identity(A.cols(), A.cols())).norm() < 1e-13);
  BOOST_TEST((singular_values(A) - values).norm() < bound);
}

}  // namespace

BOOST_AUTO_TEST_CASE(of_random_matrices) {
  Random random;
  for (int trial = 0; trial < 200; ++trial)
    check(random.matrix(random.below(30), random.below(30)));
  check(MatrixXd::Zero(20, 17));
}

// Blocks of orthogonal matrices, some columns twice: singular values 0, 1 and √2, each many times.
BOOST_AUTO_TEST_CASE(of_clusters_of_equal_values) {
  Random random;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Index n = 4 + random.below(24), k = 1 + random.below(n - 1),
                       l = 1 + random.below(k);
    const MatrixXd Q = random.orthogonal(2 * n);
    MatrixXd twice(2 * n, k + l);
    twice << Q.leftCols(k), Q.leftCols(l);
    check(twice);
    check(twice.transpose());
  }
}

BOOST_AUTO_TEST_CASE(finds_the_values_that_were_put_in) {
  Random random;
  const VectorXd values{{3.0, 2.0, 2.0, 0.5, 0.0}};
  const MatrixXd A = random.orthogonal(7).leftCols(5) * values.asDiagonal() * random.orthogonal(5);
  BOOST_TEST((singular_values(A) - values).norm() < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
