#include "courant/integrators/certificate/least_zero.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "linearizations.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * small systems with rows that depend on each other lose the digits of a step to the nearest
//    point
//  * units of velocities follow entries that vanish on the way to the nearest zero
BOOST_AUTO_TEST_SUITE(least_zero_test)

namespace {

Quadratic half_square(const VectorXd& y, Index n) {
  SparseMatrixXd identity(n, n);
  identity.setIdentity();
  return {0.5 * y.head(n).squaredNorm(), y.head(n), identity};
}

// x² + 4 y² = 4: (0, ±1) is nearest to the origin.
Linearization ellipse(const VectorXd& y) {
  const double value = y[0] * y[0] + 4.0 * y[1] * y[1] - 4.0;
  return linear(MatrixXd{{2.0 * y[0], 8.0 * y[1]}}, vector({value}), vector({16.0 * unit}));
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_nearest_point_of_an_ellipse) {
  Mobility mobility;
  mobility.cost = vector({1, 1});
  const Zero given = find_zero(ellipse, vector({1.6, 0.5}), mobility);
  BOOST_TEST_REQUIRE(given.found);
  const auto goal = [](const VectorXd& y) { return half_square(y, 2); };
  const Zero least = least_zero(ellipse, goal, given, mobility);
  BOOST_TEST(least.found);
  BOOST_TEST(std::abs(least.y[0]) < 1e-4);
  BOOST_TEST(std::abs(least.y[1] - 1.0) < 1e-8);
  BOOST_TEST(least.iterations > given.iterations);
  // A function that is zero there, or sees nothing, leaves the zero where it is.
  const auto nothing = [](const VectorXd& y) {
    return Quadratic{1.0, VectorXd::Zero(y.size()), SparseMatrixXd(y.size(), y.size())};
  };
  BOOST_TEST((least_zero(ellipse, nothing, given, mobility).y - given.y).norm() == 0.0);
}

// The same equation twice: what a factorisation without exchanges makes of it has no digits.
BOOST_AUTO_TEST_CASE(equations_may_depend_on_each_other) {
  const auto twice = [](const VectorXd& y) {
    const Linearization once = ellipse(y);
    MatrixXd J(2, 2);
    J << MatrixXd(once.jacobian), MatrixXd(once.jacobian);
    return linear(J, vector({once.value[0], once.value[0]}), vector({16 * unit, 16 * unit}));
  };
  Mobility mobility;
  mobility.cost = vector({1, 1});
  const Zero given = find_zero(twice, vector({1.6, 0.5}), mobility);
  BOOST_TEST_REQUIRE(given.found);
  const Zero least = least_zero(
      twice, [](const VectorXd& y) { return half_square(y, 2); }, given, mobility);
  BOOST_TEST(std::abs(least.y[0]) < 1e-4);
}

// p = w / (w₀² - w₁²)^½, the momenta of a relativistic particle: those nearest to 0 are (1, 0), and w is as long as
// one likes. Entries that vanish on the way choose no units of w.
BOOST_AUTO_TEST_CASE(velocities_that_do_not_matter_stay) {
  const auto map = [](const VectorXd& y) {
    const double p0 = y[0], p1 = y[1], w0 = y[2], w1 = y[3], s = std::sqrt(w0 * w0 - w1 * w1);
    MatrixXd J(2, 4);
    J << 1, 0, w1 * w1 / (s * s * s), -w0 * w1 / (s * s * s), 0, 1, w0 * w1 / (s * s * s),
        -w0 * w0 / (s * s * s);
    const VectorXd value = vector({p0 - w0 / s, p1 - w1 / s});
    return linear(J, value, 4 * unit * vector({p0 + w0 / s, std::fabs(p1) + std::fabs(w1) / s}));
  };
  const auto squared = [](const VectorXd& y) { return half_square(y, 2); };
  Mobility mobility;
  mobility.cost = vector({1, 1, 0.03, 0.03});
  const Zero given = find_zero(map, vector({1.2, 0.5, 1.3, 0.5}), mobility);
  BOOST_TEST_REQUIRE(given.found);
  const Zero least = least_zero(map, squared, given, mobility);
  BOOST_TEST(std::abs(least.y[0] - 1.0) < 1e-9);
  BOOST_TEST(std::abs(least.y[1]) < 1e-4);
  BOOST_TEST(std::abs(least.y[2]) < 1e6);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
