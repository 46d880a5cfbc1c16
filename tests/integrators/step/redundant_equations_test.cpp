#include "courant/integrators/step/redundant_equations.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>
#include <stdexcept>
#include <vector>

// Mistakes that these cases have to notice:
//  * an equation goes though its derivative says something
//  * an equation goes that no ladder named
//  * of a dependence an equation goes that has no part in it
BOOST_AUTO_TEST_SUITE(redundant_equations_test)

using namespace courant;

namespace {

using Rows = std::vector<Index>;

const MatrixXd kTwoRods{{1.0, 2.0, 0.0, -1.0}, {0.5, 0.0, 3.0, 1.0}};

MatrixXd with_row(const MatrixXd& J, const Eigen::RowVectorXd& row) {
  MatrixXd result(J.rows() + 1, J.cols());
  result << J, row;
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(one_of_each_dependence_goes) {
  const MatrixXd J = with_row(kTwoRods, kTwoRods.row(0) - kTwoRods.row(1));
  BOOST_TEST(redundant_rows(J, {0, 1, 2}, {0, 1, 2}).size() == 1u);
  BOOST_TEST(redundant_rows(kTwoRods, {0, 1}, {0, 1}).empty());
  // Repeated twice: one is left, the first.
  const MatrixXd thrice =
      with_row(with_row(kTwoRods, 4.0 * kTwoRods.row(0)), 0.25 * kTwoRods.row(0));
  BOOST_TEST(redundant_rows(thrice, {0, 1, 2, 3}, {0, 2, 3}) == Rows({2, 3}));
}

BOOST_AUTO_TEST_CASE(what_was_not_named_stays) {
  const MatrixXd J = with_row(kTwoRods, kTwoRods.row(0));
  BOOST_TEST(redundant_rows(J, {0, 1, 2}, {0}) == Rows({0}));
  BOOST_TEST(redundant_rows(J, {0, 1, 2}, {1}).empty());
  BOOST_TEST(redundant_rows(J, {0, 1, 2}, {}).empty());
}

// Equations 0 and 1, and their derivatives.
BOOST_AUTO_TEST_CASE(equations_go_with_their_derivatives) {
  MatrixXd J(4, 4);
  J << kTwoRods.row(0), 2.0 * kTwoRods.row(0), kTwoRods.row(1), 2.0 * kTwoRods.row(1);
  BOOST_TEST(redundant_rows(J, {0, 1, 0, 1}, {0, 1}) == Rows({1, 3}));
  // Without its own derivative the second would be forgotten.
  J.row(3) << 0.0, 0.0, 0.0, 1.0;
  BOOST_TEST(redundant_rows(J, {0, 1, 0, 1}, {0, 1}).empty());
}

BOOST_AUTO_TEST_CASE(numbers_that_are_none_are_refused) {
  MatrixXd J = kTwoRods;
  J(0, 0) = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(redundant_rows(J, {0, 1}, {0}), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
