#include "courant/integrators/certificate/search_units.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace courant {
// Mistakes that these cases have to notice:
//  * what a diode conducts by elsewhere measures what it blocks by
//  * frozen unknowns measure equations that others are in
//  * steps lead exponentials out of the range of numbers
//  * steps of frozen unknowns are limited too
BOOST_AUTO_TEST_SUITE(search_units_test)

namespace {

// y₀ + exp (y₁/σ) = 2, a resistor and a diode with σ = 1/40, bounds of errors included.
Linearization diode(const VectorXd& y) {
  const double current = std::exp(40.0 * y[1]);
  Linearization at;
  at.value = VectorXd{{y[0] + current - 2.0}};
  at.value_error = VectorXd{{1e-15 * (2.0 + current)}};
  at.jacobian = MatrixXd{{1.0, 40.0 * current}}.sparseView();
  at.error = MatrixXd{{0.0, 1e-14 * current}}.sparseView();
  return at;
}

Mobility mobility(bool has_exponentials) {
  Mobility result;
  result.cost = VectorXd::Ones(2);
  result.has_exponentials = has_exponentials;
  return result;
}

// The unit of y₁ for the one of y₀ at y₁ = -1, after a search was at y₁ = 0.5.
double unit_of_voltage(const Mobility& mobility) {
  const VectorXd first{{1.0, 0.5}}, second{{2.0, -1.0}}, nominal{{2.0, 1.0}};
  SearchUnits units(diode, mobility, first, nominal, diode(first));
  units(diode(first), nominal);
  const NaturalScaling at = units(diode(second), nominal);
  return at.column_scale[1] / at.column_scale[0];
}

}  // namespace

// An entry that was large once stays large, unless exponentials may have been why.
BOOST_AUTO_TEST_CASE(units_are_those_of_the_largest_derivatives_but_for_exponentials) {
  const double met = std::exp(20.0), here = std::exp(-40.0);
  BOOST_TEST(unit_of_voltage(mobility(false)) < 1.0 / met);
  BOOST_TEST(unit_of_voltage(mobility(true)) > 1e-3 / here);
}

// A step by one unit of the voltage by which the diode blocks would leave the range of numbers.
BOOST_AUTO_TEST_CASE(steps_are_limited_where_derivatives_grow) {
  const VectorXd y{{2.0, -1.0}};
  const Mobility both = mobility(true);
  NaturalScaling units(diode(y), VectorXd{{2.0, 1.0}});
  units.column_scale = VectorXd{{1.0, 1e3}};
  const double largest = 40.0 * std::exp(-40.0) * 1e3;  // of the row, next to y₀ by 1
  BOOST_TEST(largest < 1.0);
  const NaturalScaling shorter = with_step_limits(units, diode, y, diode(y), both);
  BOOST_TEST(shorter.column_scale[0] == 1.0);
  BOOST_TEST(shorter.column_scale[1] < 2.0);
  BOOST_TEST(shorter.column_scale[1] > 0.1);
  Mobility frozen = both;
  frozen.frozen = 2;
  BOOST_TEST(with_step_limits(units, diode, y, diode(y), frozen).column_scale[1] == 1e3);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
