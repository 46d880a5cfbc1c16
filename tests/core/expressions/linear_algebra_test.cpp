#include "courant/core/expressions/linear_algebra.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

// Mistakes that these cases have to notice:
//  * a pivot that is identically zero is divided by
//  * elimination adds
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

BOOST_AUTO_TEST_CASE(wrong_sizes_and_zero_pivots_are_refused) {
  BOOST_CHECK_THROW(solve(ExprMatrix::Identity(2, 3), ExprMatrix::Zero(2, 1)),
                    std::invalid_argument);
  BOOST_CHECK_THROW(solve(ExprMatrix::Identity(2, 2), ExprMatrix::Zero(3, 1)),
                    std::invalid_argument);
  BOOST_CHECK_THROW(solve(ExprMatrix::Zero(2, 2), ExprMatrix::Zero(2, 1)), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
