#include "courant/core/solve/limited_newton.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

// Mistakes that these cases have to notice:
//  * a matrix that determines nothing any more is taken for a zero
BOOST_AUTO_TEST_SUITE(limited_newton)

using namespace courant;

namespace {

constexpr double kSaturation = 1e-14, kScale = 0.02585, kLeak = 1e-12;

Expr diode(const Expr& v) { return kSaturation * (exp(v / kScale) - 1.0) + kLeak * v; }
double diode(double v) { return kSaturation * std::expm1(v / kScale) + kLeak * v; }

// Two diodes in series before a resistor, at a voltage p: y = (v₁, v₂).
LimitedNewton two_diodes(double resistance) {
  Graph graph;
  const ExprVector y = graph.variables("y", 2), p = graph.variables("p", 1);
  ExprVector equations(2);
  equations << diode(y[0]) - diode(y[1]), diode(y[0]) - (p[0] - y[0] - y[1]) / resistance;
  return LimitedNewton(Exponentials("diodes", {{"y", y}, {"p", p}}, equations));
}

// The voltage of each of them, by bisection.
double each(double voltage, double resistance) {
  double low = -std::abs(voltage), high = std::abs(voltage);
  for (int i = 0; i < 200; ++i) {
    const double v = 0.5 * (low + high);
    (diode(v) < (voltage - 2.0 * v) / resistance ? low : high) = v;
  }
  return low;
}

}  // namespace

// Whatever was before: blocked, at rest, conducting, far up the exponentials.
BOOST_AUTO_TEST_CASE(diodes_from_anywhere) {
  for (const double resistance : {1e-3, 1e3, 1e9})
    for (const double voltage : {-325.0, -1.0, 0.5, 5.0, 325.0})
      for (const double start : {-300.0, -1.0, 0.0, 0.6, 2.0, 100.0}) {
        LimitedNewton newton = two_diodes(resistance);
        VectorXd y = VectorXd::Constant(2, start);
        const Inputs in(y.data(), {&voltage});
        BOOST_TEST_CONTEXT(resistance << " Ohm, " << voltage << " V from " << start) {
          BOOST_TEST_REQUIRE(newton.solve(in));
          const double expected = each(voltage, resistance);
          BOOST_TEST(std::abs(y[0] - expected) < 1e-6 * (1.0 + std::abs(expected)));
          BOOST_TEST(std::abs(y[1] - expected) < 1e-6 * (1.0 + std::abs(expected)));
        }
      }
}

BOOST_AUTO_TEST_CASE(no_zero_is_no_success) {
  Graph graph;
  const ExprVector y = graph.variables("y", 1);
  LimitedNewton newton(Exponentials("none", {{"y", y}}, ExprVector::Constant(1, exp(y[0]) + 1.0)));
  double at = 0.0;
  const Inputs in(&at, {});
  BOOST_TEST(!newton.solve(in));
}

BOOST_AUTO_TEST_SUITE_END()
