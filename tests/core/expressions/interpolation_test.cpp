#include "courant/core/expressions/interpolation.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "courant/core/expressions/derivative.hpp"

BOOST_AUTO_TEST_SUITE(interpolation_test)

using namespace courant;

namespace {

const VectorXd kTimes = VectorXd{{0.0, 0.5, 2.0, 3.0, 7.0}};
const VectorXd kValues = VectorXd{{1.0, -2.0, 0.5, 0.5, 4.0}};

double at(Interpolation kind, double t) {
  return interpolated(kTimes, kValues, kind, Expr(t)).value();
}

// The k-th derivative.
double rate(Interpolation kind, double t, int k) {
  Graph graph;
  const ExprVector variable = graph.variables("t", 1);
  Expr f = interpolated(kTimes, kValues, kind, variable[0]);
  for (int i = 0; i < k; ++i) f = gradient(f, variable)[0];
  return substitute(f, variable, ExprVector::Constant(1, Expr(t))).value();
}

constexpr Interpolation kinds[] = {Interpolation::steps, Interpolation::linear,
                                   Interpolation::cubic};

}  // namespace

BOOST_AUTO_TEST_CASE(through_the_points_and_constant_outside) {
  for (const Interpolation kind : kinds) {
    for (Index i = 0; i < kTimes.size(); ++i)
      BOOST_TEST(std::abs(at(kind, kTimes[i]) - kValues[i]) < 1e-14);
    BOOST_TEST(at(kind, -3.0) == 1.0);
    BOOST_TEST(std::abs(at(kind, 1e6) - 4.0) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(steps_and_lines_between_them) {
  BOOST_TEST(at(Interpolation::steps, 1.9999) == -2.0);
  BOOST_TEST(at(Interpolation::steps, 2.0) == 0.5);
  BOOST_TEST(at(Interpolation::linear, 0.25) == -0.5);
  BOOST_TEST(std::abs(at(Interpolation::linear, 4.0) - (0.5 + 3.5 / 4.0)) < 1e-15);
  BOOST_TEST(rate(Interpolation::linear, 1.0, 1) == 2.5 / 1.5, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(rate(Interpolation::linear, 8.0, 1) == 0.0);
}

// Both derivatives go on over the points, and the second is zero at the ends.
BOOST_AUTO_TEST_CASE(splines_are_smooth) {
  const double e = 1e-9;
  for (Index i = 1; i + 1 < kTimes.size(); ++i)
    for (const int k : {0, 1, 2})
      BOOST_TEST(std::abs(rate(Interpolation::cubic, kTimes[i] - e, k) -
                          rate(Interpolation::cubic, kTimes[i] + e, k)) < 1e-6);
  BOOST_TEST(std::abs(rate(Interpolation::cubic, e, 2)) < 1e-6);
  BOOST_TEST(std::abs(rate(Interpolation::cubic, 7.0 - e, 2)) < 1e-6);
  BOOST_TEST(std::abs(rate(Interpolation::cubic, 1.0, 2)) > 0.1);
}

BOOST_AUTO_TEST_CASE(tables_of_one_and_two_points) {
  for (const Interpolation kind : kinds) {
    BOOST_TEST(interpolated(VectorXd{{1.0}}, VectorXd{{5.0}}, kind, Expr(3.0)).value() == 5.0);
    const double middle =
        interpolated(VectorXd{{1.0, 2.0}}, VectorXd{{5.0, 7.0}}, kind, Expr(1.5)).value();
    BOOST_TEST(middle == (kind == Interpolation::steps ? 5.0 : 6.0));
  }
}

BOOST_AUTO_TEST_CASE(wrong_tables) {
  const auto make = [](const VectorXd& times, const VectorXd& values) {
    return interpolated(times, values, Interpolation::linear, Expr(0.0));
  };
  BOOST_CHECK_THROW(make(VectorXd(0), VectorXd(0)), std::invalid_argument);
  BOOST_CHECK_THROW(make(VectorXd{{0.0, 1.0}}, VectorXd{{0.0}}), std::invalid_argument);
  BOOST_CHECK_THROW(make(VectorXd{{0.0, 0.0}}, VectorXd{{0.0, 1.0}}), std::invalid_argument);
  BOOST_CHECK_THROW(make(VectorXd{{0.0}}, VectorXd{{std::numeric_limits<double>::quiet_NaN()}}),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
