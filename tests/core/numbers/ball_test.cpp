#include "courant/core/numbers/ball.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>

// Mistakes that these cases have to notice:
//  * a product keeps the midpoint and forgets the radius (core/numbers/ball.cpp)
//  * a decimal is the double that it reads as
BOOST_AUTO_TEST_SUITE(ball_test)

using namespace courant;

namespace {

Ball between(double a, double b) { return Ball((a + b) / 2).widened_by((b - a) / 2, 0); }

}  // namespace

BOOST_AUTO_TEST_CASE(results_contain_what_is_exact) {
  const Ball root = evaluate(Op::sqrt, Ball(2.0)), left = root * root - Ball(2.0);
  BOOST_TEST(left.contains_zero());
  BOOST_TEST(!left.is_zero());
  BOOST_TEST(left.radius() < 1e-150);
  const Ball s = evaluate(Op::sin, Ball(0.7)), c = evaluate(Op::cos, Ball(0.7));
  BOOST_TEST((s * s + c * c - Ball(1.0)).contains_zero());
  BOOST_TEST((Ball(3.0) * Ball(0.5) - Ball(1.5)).is_zero());
}

BOOST_AUTO_TEST_CASE(what_is_not_zero_is_proved_not_to_be) {
  const Ball x(1e-60), rest = evaluate(Op::exp, x) - Ball(1.0) - x;  // x²/2
  BOOST_TEST(!rest.contains_zero());
  BOOST_TEST(rest.sign() == 1);
  BOOST_TEST(rest.least_size() > 4.9e-121);
  BOOST_TEST(rest.least_size() < 5.1e-121);
}

BOOST_AUTO_TEST_CASE(a_ball_is_all_its_numbers) {
  const Ball a = between(0.5, 1.5), square = a * a;
  for (const double end : {0.25, 2.25}) BOOST_TEST((square - Ball(end)).contains_zero());
  BOOST_TEST(between(0.2, 2.3).contains_inside(Ball(1.0)));
  BOOST_TEST(between(0.5, 1.6).contains_inside(between(0.6, 1.5)));
  BOOST_TEST(!between(0.5, 1.5).contains_inside(between(0.5, 1.5)));
  BOOST_TEST(a.midpoint().is_exact());
  BOOST_TEST(static_cast<double>(a.midpoint()) == 1.0);
  BOOST_TEST(a.sign() == 1);
  BOOST_TEST(between(-1.0, 1.0).sign() == 0);
}

BOOST_AUTO_TEST_CASE(what_is_not_defined_on_all_of_it_is_the_whole_line) {
  for (const Ball& a :
       {evaluate(Op::sqrt, between(-0.1, 1.0)), evaluate(Op::log, between(0.0, 1.0)),
        Ball(1.0) / between(-1.0, 1.0), evaluate(Op::asin, Ball(1.5)), pow(Ball(-1.0), Ball(0.5)),
        Ball(std::numeric_limits<double>::infinity())}) {
    BOOST_TEST(!a.is_finite());
    BOOST_TEST(a.contains_zero());
  }
}

BOOST_AUTO_TEST_CASE(numbers_are_what_was_typed) {
  const Ball tenth = Ball::written(0.1);
  BOOST_TEST((tenth * Ball(10.0) - Ball(1.0)).contains_zero());
  BOOST_TEST(!(Ball(0.1) * Ball(10.0) - Ball(1.0)).contains_zero());
  BOOST_TEST((Ball::written(1.0 / 3.0) * Ball(3.0) - Ball(1.0)).contains_zero());
  BOOST_TEST(evaluate(Op::sin, Ball::written(-std::numbers::pi)).contains_zero());
  BOOST_TEST((Ball::written(-2.5e-3) * Ball(400.0) + Ball(1.0)).contains_zero());
  BOOST_TEST(Ball::written(12.0).is_exact());
}

BOOST_AUTO_TEST_CASE(angles_and_powers) {
  BOOST_TEST(
      (atan2(Ball(1.0), Ball(-1.0)) - Ball::written(0.75 * std::numbers::pi)).contains_zero());
  const Ball power = pow(Ball(2.0), Ball(0.5));
  BOOST_TEST((power * power - Ball(2.0)).contains_zero());
  BOOST_TEST(power.radius() < 1e-150);
}

BOOST_AUTO_TEST_SUITE_END()
