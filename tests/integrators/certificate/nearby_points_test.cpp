#include "courant/integrators/certificate/nearby_points.hpp"

#include <boost/test/unit_test.hpp>

namespace courant {
namespace {

struct Names {
  Graph graph;
  ExprVector x = graph.variables("x", 3), p = graph.variables("p", 3);
  Expr t = graph.variable("t");

  ExprVector all() const {
    ExprVector variables(7);
    variables << x, p, t;
    return variables;
  }
  NearbyPoints points(const VectorXd& at, const std::vector<Expr>& constraints) const {
    return {all(), at, 1, ExprVector(), VectorXd(), constraints};
  }
};

// Mistakes that these cases have to notice:
//  * points are where they were, not on the constraints
//  * what is 0 at one point counts as 0
BOOST_FIXTURE_TEST_SUITE(nearby_points_test, Names)

// Two components of x × p are 0, so the third is, where x_0 is not 0.
BOOST_AUTO_TEST_CASE(what_follows_from_constraints_is_zero) {
  const auto found = points(VectorXd{{1.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0}},
                            {x[0] * p[1] - x[1] * p[0], x[0] * p[2] - x[2] * p[0]});
  BOOST_TEST(found.vanishes(x[1] * p[2] - x[2] * p[1]));
  BOOST_TEST(found.vanishes(Expr(0.0)));
  BOOST_TEST(!found.vanishes(Expr(1e-20)));
  // 0 at the point itself.
  BOOST_TEST(!found.vanishes(x[1] * p[2] + x[2] * p[1]));
  BOOST_TEST(!found.vanishes(p[1]));
  BOOST_TEST(!found.vanishes(1e-12 * p[1]));
}

// Constraints that depend on time hold at other times too, and say nothing of sin t.
BOOST_AUTO_TEST_CASE(time_moves) {
  const auto found =
      points(VectorXd{{1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}}, {x[0] * sin(t) - x[1] * cos(t)});
  BOOST_TEST(found.vanishes(square(x[1]) - (square(x[0]) + square(x[1])) * square(sin(t))));
  BOOST_TEST(!found.vanishes(sin(t)));
}

// No point satisfies x² = -1: then nothing is said to be 0.
BOOST_AUTO_TEST_CASE(where_there_are_no_points_nothing_is_zero) {
  const auto found = points(VectorXd::Zero(7), {square(x[0]) + 1.0});
  BOOST_TEST(!found.vanishes(square(x[0]) + 1.0));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
}  // namespace courant
