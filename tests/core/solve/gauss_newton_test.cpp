#include "courant/core/solve/gauss_newton.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

// Mistakes that these cases have to notice:
//  * the iteration stops where the defect is small, not at round-off
//  * a point that is no zero is taken for one
BOOST_AUTO_TEST_SUITE(gauss_newton_test)

using namespace courant;

// Onto the unit circle, whose equation is given twice.
BOOST_AUTO_TEST_CASE(redundant_equations_and_many_zeros) {
  const auto F = [](const VectorXd& y) {
    return VectorXd(VectorXd::Constant(2, y.squaredNorm() - 1.0));
  };
  const auto J = [](const VectorXd& y) { return MatrixXd(2.0 * y.transpose().replicate(2, 1)); };
  const GaussNewtonResult result = gauss_newton(F, J, Eigen::Vector2d(0.9, 1.2));
  BOOST_TEST(result.converged);
  BOOST_TEST((result.y - VectorXd(Eigen::Vector2d(0.6, 0.8))).norm() < 1e-15);
  BOOST_TEST(result.defect < 1e-15);
  BOOST_TEST(result.iterations < 8);
}

BOOST_AUTO_TEST_CASE(goes_on_to_round_off) {
  const auto F = [](const VectorXd& y) {
    return VectorXd(VectorXd::Constant(1, std::exp(y[0]) - 2.0));
  };
  const auto J = [](const VectorXd& y) {
    return MatrixXd(MatrixXd::Constant(1, 1, std::exp(y[0])));
  };
  const GaussNewtonResult result =
      gauss_newton(F, J, VectorXd::Constant(1, 0.5), {.accepted = 1e-3});
  BOOST_TEST(result.converged);
  BOOST_TEST(std::abs(result.y[0] - std::log(2.0)) < 1e-15);
}

BOOST_AUTO_TEST_CASE(says_where_there_is_no_zero) {
  const auto F = [](const VectorXd& y) {
    return VectorXd(VectorXd::Constant(1, y[0] * y[0] + 1.0));
  };
  const auto J = [](const VectorXd& y) { return MatrixXd(MatrixXd::Constant(1, 1, 2.0 * y[0])); };
  const GaussNewtonResult result = gauss_newton(F, J, VectorXd::Constant(1, 0.7));
  BOOST_TEST(!result.converged);
  BOOST_TEST(result.defect >= 1.0);
  BOOST_TEST(result.iterations == 50);
  const auto nan = [](const VectorXd&) { return VectorXd(VectorXd::Constant(1, std::nan(""))); };
  BOOST_TEST(!gauss_newton(nan, J, VectorXd::Ones(1)).converged);
}

BOOST_AUTO_TEST_CASE(nothing_to_solve) {
  const auto F = [](const VectorXd&) { return VectorXd(0); };
  const auto J = [](const VectorXd&) { return MatrixXd(0, 2); };
  const GaussNewtonResult result = gauss_newton(F, J, Eigen::Vector2d(3.0, 4.0));
  BOOST_TEST(result.converged);
  BOOST_TEST(result.y[1] == 4.0);
}

BOOST_AUTO_TEST_SUITE_END()
