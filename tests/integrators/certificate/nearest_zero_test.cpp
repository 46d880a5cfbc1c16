// Searches for zeros, and their units, where numbers are round-off.
#include "courant/integrators/certificate/nearest_zero.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "linearizations.hpp"

// Mistakes that these cases have to notice:
//  * a residual that is round-off chooses units and makes steps
//    (integrators/certificate/natural_scaling.cpp)
//  * a unit is made of rounding errors (integrators/certificate/natural_scaling.cpp)
//  * what a step leaves of an unknown looks like a number
//  * a residual of infinity in its units is compared with others
BOOST_AUTO_TEST_SUITE(nearest_zero_test)

using namespace courant;

BOOST_AUTO_TEST_CASE(a_residual_within_its_error_is_none) {
  const Linearization at =
      linear(MatrixXd::Identity(3, 3), vector({1e-17, 2e-16, -3.0}), vector({1e-16, 1e-16, 1e-16}));
  BOOST_TEST((significant(at) - vector({0, 2e-16, -3})).norm() == 0.0);
  const Linearization unknown = linear(MatrixXd::Identity(1, 1), vector({1e-17}), VectorXd());
  BOOST_TEST(significant(unknown)[0] == 1e-17);
}

// Two equations that share nothing: x = 0.3, and y = 0 that is 10⁻¹⁷ because of rounding.
BOOST_AUTO_TEST_CASE(round_off_chooses_no_units) {
  const MatrixXd J = MatrixXd::Identity(2, 2);
  const VectorXd error = vector({1e-16, 1e-16});
  // A residual of 10⁻¹⁷ in an equation whose unknown vanishes.
  const NaturalScaling by_value(linear(J, vector({0, 1e-17}), error), vector({0.3, 0}));
  BOOST_TEST(by_value.row_scale[1] == 1.0);
  // An unknown of 10⁻¹⁷: a unit is seen by its rounding errors at least a thousand times over.
  const NaturalScaling by_size(linear(J, vector({0, 0}), error), vector({0.3, 1e-17}));
  BOOST_TEST(by_size.column_scale[1] >= 1e3 * 1e-16);
  BOOST_TEST(by_size.row_scale[1] * 1e-16 <= 1e-3);
  BOOST_TEST(by_size.column_scale[0] < 1.0);  // a number is a unit
}

// x + y = 0.7, x - y = 0.7: y = 0, and not what elimination leaves of it.
BOOST_AUTO_TEST_CASE(what_a_step_leaves_of_an_unknown_is_zero) {
  MatrixXd J(2, 2);
  J << 1.0, 3.0, 1.0 / 3.0, -0.9;
  const auto map = [&](const VectorXd& y) {
    const VectorXd target = 0.7 * J.col(0);
    return linear(J, J * y - target, unit * (J.cwiseAbs() * y.cwiseAbs() + target));
  };
  Mobility mobility;
  mobility.cost = VectorXd::Ones(2);
  const Zero zero = find_zero(map, vector({0.1, 0.3}), mobility);
  BOOST_TEST(zero.found);
  BOOST_TEST(zero.y[1] == 0.0);
  BOOST_TEST(std::abs(zero.y[0] - 0.7) < 1e-15);
}

// exp y = 1 from y = -6.572: the step exp 6.572 - 1 leads to 1.4 · 10³⁰⁷, which is no double in units of exp (-6.572).
BOOST_AUTO_TEST_CASE(a_residual_that_is_infinite_in_its_units_makes_no_step) {
  const auto map = [](const VectorXd& y) {
    const double power = std::exp(y[0]);
    return linear(MatrixXd::Constant(1, 1, power), vector({power - 1.0}),
                  vector({unit * (power + 1.0)}));
  };
  Mobility mobility;
  mobility.cost = VectorXd::Ones(1);
  const Zero zero = find_zero(map, vector({-6.572}), mobility);
  BOOST_TEST(zero.found);
  BOOST_TEST(std::abs(zero.y[0]) < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
