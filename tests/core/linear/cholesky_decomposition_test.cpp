#include "courant/core/linear/cholesky_decomposition.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>

// Mistakes that these cases have to notice:
//  * what is not a number is taken for positive
BOOST_AUTO_TEST_SUITE(cholesky_decomposition)

using namespace courant;

BOOST_AUTO_TEST_CASE(lower_triangle) {
  MatrixXd A(3, 3);
  A << 4, 2, -2, 2, 10, 5, -2, 5, 9;
  const CholeskyDecomposition cholesky(A);
  BOOST_TEST(cholesky.is_positive_definite());
  BOOST_TEST((cholesky.L() * cholesky.L().transpose() - A).norm() < 1e-14);
  BOOST_TEST((cholesky.L() * cholesky.solve_lower(A) - A).norm() < 1e-14);
  BOOST_TEST(cholesky.L()(0, 2) == 0.0);
  BOOST_TEST(CholeskyDecomposition(MatrixXd(0, 0)).is_positive_definite());
}

BOOST_AUTO_TEST_CASE(other_matrices_are_not_positive_definite) {
  MatrixXd A = MatrixXd::Identity(2, 2);
  A(1, 1) = -1.0;
  BOOST_TEST(!CholeskyDecomposition(A).is_positive_definite());
  A(1, 1) = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(!CholeskyDecomposition(A).is_positive_definite());
  BOOST_TEST(!CholeskyDecomposition(MatrixXd::Zero(2, 2)).is_positive_definite());
}

BOOST_AUTO_TEST_CASE(sizes_are_checked) {
  BOOST_CHECK_THROW(CholeskyDecomposition(MatrixXd::Ones(2, 3)), std::invalid_argument);
  BOOST_CHECK_THROW(
      CholeskyDecomposition(MatrixXd::Identity(2, 2)).solve_lower(MatrixXd::Ones(3, 1)),
      std::invalid_argument);
}

// A = v vᵀ sees v alone.
BOOST_AUTO_TEST_CASE(solutions_of_semidefinite_equations) {
  const Eigen::Vector3d v(1.0, -2.0, 0.5), b = 3.0 * v;
  const MatrixXd A = v * v.transpose(), x = semidefinite_solution(A, b);
  BOOST_TEST((A * x - b).norm() < 1e-14);
  BOOST_TEST((semidefinite_solution(A + MatrixXd::Identity(3, 3), b) - b / (1.0 + v.squaredNorm()))
                 .norm() < 1e-14);
  BOOST_CHECK_THROW(semidefinite_solution(MatrixXd::Ones(2, 3), b), std::invalid_argument);
  BOOST_CHECK_THROW(semidefinite_solution(MatrixXd::Ones(2, 2), b), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
