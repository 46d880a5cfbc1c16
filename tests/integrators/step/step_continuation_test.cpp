#include "courant/integrators/step/step_continuation.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace courant {
BOOST_AUTO_TEST_SUITE(step_continuation_test)

namespace {

// y = h f(y), a displacement y from x = 0.
template <class Rate>
StepContinuation continuation(const Rate& f) {
  Graph graph;
  const ExprVector y = graph.variables("y", 1), h = graph.variables("h", 1);
  const ExprVector G = ExprVector::Constant(1, y[0] - h[0] * f(y[0]));
  return {Function("G", {{"y", y}, {"h", h}}, G, {.differentiate = {"y"}}),
          {.displacements = 1, .multipliers = 0, .h = 1}};
}

struct Followed {
  VectorXd y;
  StepContinuation::Result result;
};

Followed follow(StepContinuation& curve, double h, double prediction) {
  Followed followed{VectorXd::Constant(1, prediction), {}};
  followed.result =
      curve.follow(followed.y, Inputs(nullptr, {&h}), 1.0, VectorXd::Zero(followed.y.size()));
  return followed;
}

// y = h (1 - 100 y²) has the solutions (-1 ± √(1 + 400 h²))/(200 h); the positive one begins at 0.
BOOST_AUTO_TEST_CASE(the_solution_that_begins_at_the_state_is_found) {
  StepContinuation curve = continuation([](const Expr& y) { return 1.0 - 100.0 * square(y); });
  for (const double h : {1e-3, 0.1, 1.0, 10.0}) {
    const Followed found = follow(curve, h, h);
    BOOST_TEST(found.result.arrived);
    BOOST_TEST(found.result.reached == 1.0);
    BOOST_TEST(found.result.iterations > 0);
    const double right = (-1.0 + std::sqrt(1.0 + 400.0 * h * h)) / (200.0 * h);
    BOOST_TEST(found.y[0] == right, boost::test_tools::tolerance(1e-6));
  }
}

// y = h (1 + y²/4) has solutions up to h = 1, where two of them meet.
BOOST_AUTO_TEST_CASE(a_turning_point_ends_the_curve) {
  StepContinuation curve = continuation([](const Expr& y) { return 1.0 + 0.25 * square(y); });
  const Followed found = follow(curve, 2.0, 2.0);
  BOOST_TEST(!found.result.arrived);
  BOOST_TEST(found.result.reached < 0.5);
  BOOST_TEST(found.result.reached > 0.49);
  const double h = 2.0 * found.result.reached;
  BOOST_TEST(found.y[0] == 2.0 * (1.0 - std::sqrt(1.0 - h * h)) / h,
             boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(nothing_is_reached_where_there_is_no_solution) {
  StepContinuation curve = continuation([](const Expr& y) { return sqrt(y - 1.0); });
  const Followed found = follow(curve, 0.1, 0.1);
  BOOST_TEST(!found.result.arrived);
  BOOST_TEST(found.result.reached == 0.0);
}

// y = h (1 + 2 cos(15 (x + y/2))) from x = 0.18 with h = 3: the curve turns to and fro, and nearly all of
// its 40 solutions lie on other branches. Those of one branch are followed in 10⁵ parts.
BOOST_AUTO_TEST_CASE(branches_are_not_exchanged) {
  for (const double x : {0.1, 0.13, 0.16, 0.179, 0.18, 0.19, 0.1965, 0.21, 0.25, 0.3}) {
    StepContinuation curve =
        continuation([x](const Expr& y) { return 1.0 + 2.0 * cos(15.0 * (x + 0.5 * y)); });
    for (const double h : {0.3, 1.0, 2.0, 3.0, 5.0}) {
      const double f = 1.0 + 2.0 * std::cos(15.0 * x);
      const Followed found = follow(curve, h, h * f);
      double y = 0.0;
      bool ends = false;
      for (int k = 1; k <= 100000 && !ends; ++k) {
        const double sigma = h * k / 100000;
        for (int iteration = 0; iteration < 4; ++iteration) {
          const double phase = 15.0 * (x + 0.5 * y);
          const double slope = 1.0 + 15.0 * sigma * std::sin(phase);
          ends = ends || !(slope > 0.0);
          y -= (y - sigma * (1.0 + 2.0 * std::cos(phase))) / slope;
        }
      }
      BOOST_TEST(found.result.arrived == !ends, "x = " << x << ", h = " << h);
      if (!ends && found.result.arrived)
        BOOST_TEST(found.y[0] == y, boost::test_tools::tolerance(1e-4));
    }
  }
}

// A step of either sign, and one after the other by the same object.
BOOST_AUTO_TEST_CASE(a_curve_does_not_depend_on_the_one_before) {
  StepContinuation curve = continuation([](const Expr& y) { return 1.0 - 100.0 * square(y); });
  const VectorXd first = follow(curve, 1.0, 1.0).y;
  BOOST_TEST(follow(curve, -1.0, -1.0).y[0] == -first[0], boost::test_tools::tolerance(1e-12));
  BOOST_TEST(follow(curve, 1.0, 1.0).y[0] == first[0]);
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
