#include "courant/core/numbers/digits.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

BOOST_AUTO_TEST_SUITE(digits_test)

using namespace courant;

namespace {

Digits written(double number) { return Digits::written(number); }

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_zero_but_for_rounding_shrinks) {
  const Digits third = Digits(1.0) / Digits(3.0);
  BOOST_TEST((third + third + third - Digits(1.0)).shrinks());
  const Digits a = evaluate(Op::sin, written(0.7)), b = evaluate(Op::cos, written(0.7));
  BOOST_TEST((a * a + b * b - Digits(1.0)).shrinks());
}

BOOST_AUTO_TEST_CASE(what_is_not_zero_stays_however_small) {
  BOOST_TEST(!Digits(1e-300).shrinks());
  const Digits one = Digits(1.0) + written(1e-30);
  BOOST_TEST(!(one - Digits(1.0)).shrinks());
  // At the end of the coarse digits.
  const Digits close = Digits(1.0) + written(1e-37);
  BOOST_TEST(!(close - Digits(1.0)).shrinks());
}

BOOST_AUTO_TEST_CASE(units_decide_nothing) {
  for (const double unit : {1e-200, 1e-30, 1e30, 1e200}) {
    const Digits a = written(unit), b = a * written(0.1), c = a * written(0.2);
    BOOST_TEST((b + c - a * written(0.3)).shrinks());
    BOOST_TEST(!(b + c - a * written(0.3000001)).shrinks());
  }
}

BOOST_AUTO_TEST_CASE(decimals_are_what_was_typed) {
  const auto circle = [](const Digits& x, const Digits& y) { return x * x + y * y - Digits(1.0); };
  BOOST_TEST(circle(written(0.6), written(-0.8)).shrinks());
  BOOST_TEST(!circle(Digits(0.6), Digits(-0.8)).shrinks());
  BOOST_TEST((written(1.1) * Digits(10.0) - Digits(11.0)).shrinks());
}

BOOST_AUTO_TEST_CASE(fractions_and_pi_are_read_from_long_decimals) {
  BOOST_TEST((written(1.0 / 3.0) * Digits(3.0) - Digits(1.0)).shrinks());
  BOOST_TEST(evaluate(Op::cos, written(std::numbers::pi / 2)).shrinks());
  BOOST_TEST(evaluate(Op::sin, written(std::numbers::pi)).shrinks());
  BOOST_TEST(!evaluate(Op::cos, written(1.5707963)).shrinks());
  // A decimal that is no fraction stays one.
  BOOST_TEST((written(0.123456789012345) * Digits(1e15) - Digits(123456789012345.0)).shrinks());
}

BOOST_AUTO_TEST_CASE(rows_are_settled_where_they_cancel) {
  Digits row[] = {written(0.3), written(0.7)};
  const Digits pivot[] = {written(0.1), written(0.2)};
  subtract_multiple(row, Digits(3.0), pivot, 2);
  BOOST_TEST(row[0].is_zero());
  BOOST_TEST(static_cast<double>(row[1]) == 0.1);
}

BOOST_AUTO_TEST_SUITE_END()
