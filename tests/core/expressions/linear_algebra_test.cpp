#include "courant/core/expressions/linear_algebra.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

// Mistakes that these cases have to notice:
//  * a pivot that is identically zero is divided by
//  * elimination adds
//  * a zero pivot of a semidefinite matrix is divided by
BOOST_AUTO_TEST_SUITE(linear_algebra)

using namespace courant;

BOOST_AUTO_TEST_CASE(solve_on_numbers_is_the_solution) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const Index n : {0, 1, 2, 5}) {
    const MatrixXd A = 4.0 * MatrixXd::Identity(n, n) +
                       MatrixXd::NullaryExpr(n, n, [&] { return uniform(generator); });
    const MatrixXd b = MatrixXd::NullaryExpr(n, 3, [&] { return uniform(generator); });
    BOOST_TEST((A * values(solve(constants(A), constants(b))) - b).norm() < 1e-14);
  }
}

// L D Lᵀ of whole numbers, which elimination finds to the bit.
BOOST_AUTO_TEST_CASE(solve_semidefinite_solves_where_a_solution_is) {
  const MatrixXd L{{1, 0, 0, 0}, {3, 1, 0, 0}, {-2, 5, 1, 0}, {4, -1, 2, 1}};
  const VectorXd x{{2, -3, 1, 7}};
  for (const VectorXd& D :
       {VectorXd{{1, 0, 2, 0}}, VectorXd{{0, 0, 3, 1}}, VectorXd{{1, 2, 4, 1}}}) {
    const MatrixXd A = L * D.asDiagonal() * L.transpose();
    const MatrixXd found = values(solve_semidefinite(constants(A), constants(MatrixXd(A * x))));
    BOOST_TEST((A * found - A * x).norm() == 0.0);
    for (Index k = 0; k < 4; ++k) BOOST_TEST((D[k] != 0.0 || found(k, 0) == 0.0));
  }
  BOOST_CHECK_THROW(solve_semidefinite(ExprMatrix::Identity(2, 2), ExprMatrix::Zero(3, 1)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(wrong_sizes_and_zero_pivots_are_refused) {
  BOOST_CHECK_THROW(solve(ExprMatrix::Identity(2, 3), ExprMatrix::Zero(2, 1)),
                    std::invalid_argument);
  BOOST_CHECK_THROW(solve(ExprMatrix::Identity(2, 2), ExprMatrix::Zero(3, 1)),
                    std::invalid_argument);
  BOOST_CHECK_THROW(solve(ExprMatrix::Zero(2, 2), ExprMatrix::Zero(2, 1)), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
