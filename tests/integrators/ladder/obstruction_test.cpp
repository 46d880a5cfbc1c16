#include "courant/integrators/ladder/obstruction.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/integrators/ladder/derivative_array.hpp"
#include "ladder_catalogue.hpp"

BOOST_AUTO_TEST_SUITE(obstruction_test)

using namespace courant;
using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

// Whether something is seen of F = 0 at x along d, where J(x) has this rank.
bool is_seen(const std::function<ExprVector(V x)>& F, Index n, const VectorXd& x, Index rank,
             const VectorXd& d) {
  const Index m = F(ExprVector::Constant(n, Expr(0.0))).size();
  const auto system = flat(n, 0, m, [&](V q, V, V, T) { return F(q); });
  const DerivativeArray array(system, 0.0, x);
  VectorXd y = VectorXd::Zero(2 * n), direction = y;
  direction.head(n) = d;
  return Obstruction(array, y, VectorXd::Zero(2 * n), rank).is_seen_along(direction);
}

VectorXd vector(std::initializer_list<double> values) { return at(values).x; }

}  // namespace

// z² = 0 at 0 has no linear part; the cone x² + y² = z² neither; nor the node of a lemniscate.
BOOST_AUTO_TEST_CASE(singular_zeros) {
  BOOST_TEST(is_seen([](V x) { return equations({square(x[0]) + 0 * x[1]}); }, 2, vector({0, 0}), 0,
                     vector({0.7, 0.3})));
  BOOST_TEST(is_seen([](V x) { return equations({square(x[0]) + square(x[1]) - square(x[2])}); }, 3,
                     vector({0, 0, 0}), 0, vector({0.7, 0.3, 0.2})));
  // In units of 10⁻⁸, and beside a regular equation.
  BOOST_TEST(is_seen(
      [](V x) {
        return equations({1e-8 * square(x[0]), x[1] + square(x[0])});
      },
      3, vector({0, 0, 0}), 1, vector({0.7, 0, 0.3})));
}

// Redundant equations have dependent linear parts and vanish together.
BOOST_AUTO_TEST_CASE(regular_zeros) {
  const auto twice = [](V x) {
    const Expr circle = square(x[0]) + square(x[1]) - 1;
    return equations({circle, circle * (2 + x[0]), x[2] - exp(x[2] * circle) * x[2] + circle});
  };
  BOOST_TEST(!is_seen(twice, 3, vector({0.6, -0.8, 0.3}), 1, vector({0.8, 0.6, 0.4})));
  BOOST_TEST(!is_seen(twice, 3, vector({1, 0, 0}), 1, vector({0, 0.6, 0.4})));
}

// Off the tangent space there are no zeros to speak of, and whatever J does not see is quadratic: the
// circle and its double from (1, 0), along (1, 0).
BOOST_AUTO_TEST_CASE(a_direction_that_is_no_tangent_says_nothing) {
  const auto twice = [](V x) {
    const Expr circle = square(x[0]) + square(x[1]) - 1;
    return equations({circle, 2 * circle + square(circle)});
  };
  BOOST_TEST(!is_seen(twice, 2, vector({1, 0}), 1, vector({0.4, 0.5})));
}

// As many equations as their rank: nothing is left unseen.
BOOST_AUTO_TEST_CASE(full_rank) {
  BOOST_TEST(!is_seen([](V x) { return equations({square(x[0]) + square(x[1]) - 1}); }, 2,
                      vector({1, 0}), 1, vector({0, 1})));
}

BOOST_AUTO_TEST_SUITE_END()
