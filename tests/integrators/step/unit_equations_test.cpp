#include "courant/integrators/step/unit_equations.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/manifolds/manifold.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * sizes that are known are not those of the units
BOOST_AUTO_TEST_SUITE(unit_equations_test)

namespace {

// Rows q' - p/m and p' + k q of an oscillator, columns (q, p, q', p').
UnitEquations oscillator(double m, double k) {
  UnitEquations equations({0, 1}, 2, 4);
  equations.add_entry(0, 2, 1.0);
  equations.add_entry(0, 1, 1.0 / m);
  equations.add_entry(1, 3, 1.0);
  equations.add_entry(1, 0, k);
  return equations;
}

}  // namespace

// Momenta by √(k m) of positions, time by √(m/k), and of a known position its size.
BOOST_AUTO_TEST_CASE(terms_of_an_oscillator_are_of_one_size) {
  const double m = 9e-31, k = 4e-11;
  const VectorXd c = oscillator(m, k).columns(VectorXd{{1e-6, 0.0, 0.0, 0.0}});
  BOOST_TEST(std::abs(c[0] / 1e-6 - 1.0) < 1e-9);
  BOOST_TEST(std::abs(c[1] / (1e-6 * std::sqrt(k * m)) - 1.0) < 1e-9);
  const double time = c[0] / c[2];
  BOOST_TEST(std::abs(time / std::sqrt(m / k) - 1.0) < 1e-9);
  BOOST_TEST(std::abs(c[1] / c[3] / time - 1.0) < 1e-9);
}

// A common factor is open where no size is known: ratios are not.
BOOST_AUTO_TEST_CASE(ratios_need_no_sizes) {
  const VectorXd c = oscillator(2.0, 8.0).columns(VectorXd::Zero(4));
  BOOST_TEST(std::abs(c[1] / c[0] - 4.0) < 1e-12);
  BOOST_TEST(std::abs(c[0] / c[2] - 0.5) < 1e-12);
}

// p' = -m g of a body that falls: its weight tells the unit of time.
BOOST_AUTO_TEST_CASE(constants_tell_units) {
  const double m = 2.0, weight = 18.0;
  UnitEquations falling({0, 1}, 2, 4);
  falling.add_entry(0, 2, 1.0);
  falling.add_entry(0, 1, 1.0 / m);
  falling.add_entry(1, 3, 1.0);
  falling.add_constant(1, weight);
  // c_q' = c_p/m and c_p' = weight with c_q = 1: T² = m/weight.
  const VectorXd c = falling.columns(VectorXd{{1.0, 0.0, 0.0, 0.0}});
  BOOST_TEST(std::abs(c[3] / weight - 1.0) < 1e-9);
  BOOST_TEST(std::abs(c[0] / c[2] - std::sqrt(m / weight)) < 1e-9);
}

// Slopes of numbers, the last one by time: sin (x/5) and exp (100 t).
BOOST_AUTO_TEST_CASE(slopes_of_numbers_tell_units) {
  UnitEquations equations({0}, 0, 2);
  equations.add_slope(0, 0.2);
  equations.add_slope(2, 100.0);
  const VectorXd c = equations.columns(VectorXd::Zero(2));
  BOOST_TEST(std::abs(c[0] - 5.0) < 1e-12);
  BOOST_TEST(std::abs(c[0] / c[1] - 0.01) < 1e-14);
}

// An angle has the unit 1, and its rate that of 1/T.
BOOST_AUTO_TEST_CASE(numbers_without_a_unit_stay) {
  UnitEquations equations({Manifold::ScalingSymmetries::none}, 0, 2);
  equations.add_slope(2, 0.5);
  const VectorXd c = equations.columns(VectorXd{{7.0, 0.0}});
  BOOST_TEST(std::abs(c[0] - 1.0) < 1e-14);
  BOOST_TEST(std::abs(c[1] - 0.5) < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
