#include "courant/integrators/certificate/least_deviation.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "linearizations.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * small systems with rows that depend on each other lose the digits of a step to the nearest
//    point
//  * units of velocities follow entries that vanish on the way to the nearest zero
BOOST_AUTO_TEST_SUITE(least_deviation_test)

namespace {

// From `given`, by the first n unknowns.
Deviation from(const VectorXd& given, const VectorXd& y) {
  const Index n = given.size();
  SparseMatrixXd identity(n, n);
  identity.setIdentity();
  return {y.head(n) - given, identity, given.norm() + y.head(n).norm()};
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
  const auto goal = [](const VectorXd& y) { return from(vector({0, 0}), y); };
  const LeastDeviation least = least_deviation(ellipse, goal, given, mobility);
  BOOST_TEST(least.zero.found);
  BOOST_TEST(least.is_stationary());
  BOOST_TEST(std::abs(least.zero.y[0]) < 1e-7);
  BOOST_TEST(std::abs(least.zero.y[1] - 1.0) < 1e-12);
  BOOST_TEST(least.deviation == 1.0, boost::test_tools::tolerance(1e-12));
  // ½ (x² + y²) = ½ (x² + 1 - x²/4) on the ellipse: 1 - 1/4.
  BOOST_TEST(least.curvature == 0.75, boost::test_tools::tolerance(1e-2));
  BOOST_TEST(least.zero.iterations > given.iterations);
  // A function that is zero there, or sees nothing, leaves the zero where it is.
  const auto nothing = [](const VectorXd& y) {
    return Deviation{VectorXd::Ones(1), SparseMatrixXd(1, y.size()), 1.0};
  };
  BOOST_TEST((least_deviation(ellipse, nothing, given, mobility).zero.y - given.y).norm() == 0.0);
}

// From (0, 0.4), beyond the evolute, both (0, 1) and points at its sides are stationary; from (1, 3) there is one. The
// conditions of optimality hold in the numbers of the ellipse to round-off.
BOOST_AUTO_TEST_CASE(conditions_of_optimality_are_met) {
  Mobility mobility;
  mobility.cost = vector({1, 1});
  for (const VectorXd& target :
       {vector({0.1, 0.4}), vector({1, 3}), vector({2.5, -0.2}), vector({-1, 0.9})}) {
    const Zero start = find_zero(ellipse, target, mobility);
    BOOST_TEST_REQUIRE(start.found);
    const LeastDeviation least = least_deviation(
        ellipse, [&](const VectorXd& y) { return from(target, y); }, start, mobility);
    BOOST_TEST_CONTEXT(target.transpose()) {
      const VectorXd y = least.zero.y, r = y - target;
      const double across = r[0] * 8.0 * y[1] - r[1] * 2.0 * y[0];  // r × ∇F
      BOOST_TEST(least.is_stationary());
      BOOST_TEST(std::abs(across) < 1e-9);
      BOOST_TEST(std::abs(ellipse(y).value[0]) < 1e-12);
    }
  }
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
  const Zero least = least_deviation(
                         twice,
                         [](const VectorXd& y) {
                           return from(vector({0, 0}), y);
                         },
                         given, mobility)
                         .zero;
  BOOST_TEST(std::abs(least.y[0]) < 1e-7);
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
  const auto squared = [](const VectorXd& y) { return from(vector({0, 0}), y); };
  Mobility mobility;
  mobility.cost = vector({1, 1, 0.03, 0.03});
  const Zero given = find_zero(map, vector({1.2, 0.5, 1.3, 0.5}), mobility);
  BOOST_TEST_REQUIRE(given.found);
  const Zero least = least_deviation(map, squared, given, mobility).zero;
  BOOST_TEST(std::abs(least.y[0] - 1.0) < 1e-9);
  BOOST_TEST(std::abs(least.y[1]) < 1e-4);
  BOOST_TEST(std::abs(least.y[2]) < 1e6);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
