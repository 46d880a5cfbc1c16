#include "courant/manifolds/measurement.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

// Mistakes that these cases have to notice:
//  * the slope is taken of errors that are round-off
//  * the second derivative is not looked at
BOOST_AUTO_TEST_SUITE(measurement)

using namespace courant;

BOOST_AUTO_TEST_CASE(slope_of_a_power_law) {
  std::vector<double> steps, errors;
  for (double h = 0.1; h > 0.005; h /= 2) {
    steps.push_back(h);
    errors.push_back(7.0 * std::pow(h, 2.5));
  }
  BOOST_TEST(log_log_slope(steps, errors, 0.0) == 2.5, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(errors_at_the_floor_do_not_count) {
  BOOST_TEST(log_log_slope({0.4, 0.2, 0.1}, {0.16, 0.04, 1e-16}, 1e-15) == 2.0,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::isinf(log_log_slope({0.2, 0.1}, {1e-16, 0.0}, 1e-15)));
}

BOOST_AUTO_TEST_CASE(derivatives_of_a_smooth_curve) {
  const CurveFamily family(
      [](const Expr& t, const ExprVector& data) {
        ExprVector F(2);
        F << exp(data[0] * t), stumpff(1, square(data[0] + t));
        return F;
      },
      1);
  for (const double at : {0.0, 1e-8, 1e-4, 0.7})
    BOOST_TEST(family.derivative_defect(VectorXd::Constant(1, at), 1e-2) < 1e-10);
}

// sin θ/θ written with θ = √s: right away from zero, no derivative at zero.
BOOST_AUTO_TEST_CASE(a_derivative_that_is_not_finite_is_seen) {
  const CurveFamily family(
      [](const Expr& t, const ExprVector& data) {
        const Expr theta = sqrt(square(data[0] + t));
        return ExprVector(ExprVector::Constant(1, sin(theta) / theta));
      },
      1);
  BOOST_TEST(family.derivative_defect(VectorXd::Constant(1, 0.5), 1e-2) < 1e-10);
  BOOST_TEST(std::isinf(family.derivative_defect(VectorXd::Zero(1), 1e-2)));
}

// The usual guard, a constant near zero, has finite derivatives that are wrong.
BOOST_AUTO_TEST_CASE(a_derivative_that_is_wrong_is_seen) {
  const CurveFamily family(
      [](const Expr& t, const ExprVector& data) {
        const Expr s = square(data[0] + t);
        const Expr theta = sqrt(select(s < 1e-6, 1.0, s));
        return ExprVector(ExprVector::Constant(1, select(s < 1e-6, 1.0, sin(theta) / theta)));
      },
      1);
  BOOST_TEST(family.derivative_defect(VectorXd::Constant(1, 0.5), 1e-2) < 1e-10);
  BOOST_TEST(family.derivative_defect(VectorXd::Zero(1), 1e-2) > 0.1);
}

BOOST_AUTO_TEST_CASE(describes_at_most_six_entries) {
  BOOST_TEST(describe("x", VectorXd::LinSpaced(2, 1.0, 2.0)) == "x = (1, 2)");
  BOOST_TEST(describe("x", VectorXd::Zero(7)) == "x = (0, 0, 0, 0, 0, 0, …)");
}

BOOST_AUTO_TEST_SUITE_END()
