#include "courant/integrators/certificate/ladder_ascent.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "ladder_catalogue.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the way goes on from levels that repeat
BOOST_AUTO_TEST_SUITE(ladder_ascent_test)

using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

LadderAscent ascent(const SystemPointer& system, const InitialGuess& guess, Index max_level = 12) {
  return LadderAscent(ConsistentPoint(system, guess, {}), *system, max_level);
}

// q' = w, x² + y² = 1 and what the tension does: a rod in the plane.
SystemPointer rod() {
  return flat(4, 1, 5, [](V x, V v, V z, T) {
    return equations({v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0], v[3] + z[0] * x[1] + 1,
                      square(x[0]) + square(x[1]) - 1});
  });
}

}  // namespace

BOOST_AUTO_TEST_CASE(it_ends_where_dimensions_repeat) {
  const LadderAscent found = ascent(rod(), at({0.6, -0.8, 0.8, 0.6}));
  BOOST_TEST(found.is_stopped);
  BOOST_TEST(found.has_point());
  BOOST_TEST(found.reason == "");
  BOOST_TEST(found.levels.size() == 4u);
  BOOST_TEST(repeats(found.levels));
  BOOST_TEST(!repeats({found.levels[0]}));
  BOOST_TEST(!repeats({found.levels[0], found.levels[1]}));
  BOOST_TEST(found.jet.level() == 3);
}

BOOST_AUTO_TEST_CASE(or_at_the_highest_level_allowed) {
  const LadderAscent found = ascent(rod(), at({0.6, -0.8, 0.8, 0.6}), 1);
  BOOST_TEST(!found.is_stopped);
  BOOST_TEST(found.has_point());
  BOOST_TEST(found.levels.size() == 2u);
}

// x = √t, y² = x at t = 0: the derivatives of level 1 are not finite, and those of level 0 are where the way ends.
BOOST_AUTO_TEST_CASE(or_where_derivatives_are_not_finite) {
  const SystemPointer root = flat(2, 0, 2, [](V x, V, V, T t) {
    return equations({x[0] - sqrt(t), square(x[1]) - x[0]});
  });
  const LadderAscent found = ascent(root, at({1.0, 0.0}));
  BOOST_TEST(!found.is_stopped);
  BOOST_TEST(found.levels.size() == 1u);
  BOOST_TEST(found.reason.find("not finite") != std::string::npos, found.reason);
  BOOST_TEST(found.jet.level() == 0);
  BOOST_TEST(found.jet.zero().nominal.size() == found.jet.zero().y.size());
  BOOST_TEST(found.jet.zero().uncertainty.size() == found.jet.zero().y.size());
}

// What is of two levels is no jet.
BOOST_AUTO_TEST_CASE(a_jet_has_one_level) {
  const DerivativeArray array(rod(), 0.0, Eigen::Vector4d(0.6, -0.8, 0.8, 0.6));
  const ConsistentJet jet(array, Zero(VectorXd::Ones(array.unknown_count(0))));
  const ConsistentJet above = jet.at_level(2);
  BOOST_TEST(above.level() == 2);
  BOOST_TEST(above.zero().uncertainty.size() == array.unknown_count(2));
  BOOST_TEST(above.at_level(0).zero().y == jet.zero().y);
  Zero torn = jet.zero();
  torn.y = array.resized(torn.y, 1);
  BOOST_CHECK_THROW(ConsistentJet(array, torn), std::invalid_argument);
}

// x' = 1 beside x = 0: nothing contradicts before x' does.
BOOST_AUTO_TEST_CASE(or_at_a_level_that_is_empty) {
  const SystemPointer contradicted = flat(1, 0, 2, [](V x, V v, V, T) {
    return equations({v[0] - 1, x[0]});
  });
  const LadderAscent found = ascent(contradicted, at({0.0}));
  BOOST_TEST(!found.is_stopped);
  BOOST_TEST(!found.has_point());
  BOOST_TEST(found.has_converged);
  BOOST_TEST(found.levels.back().is_empty);
  BOOST_TEST(found.levels.back().k == 1);
  BOOST_TEST(found.levels.back().residual > 0.1);
  BOOST_TEST(
      found.reason.starts_with("No point of S₁ was found near the given values: these "
                               "equations contradict each other: "));
  BOOST_TEST_REQUIRE(found.contradiction.size() == 2u);
  BOOST_TEST(found.contradiction[0].derivative + found.contradiction[1].derivative == 1);
}

BOOST_AUTO_TEST_CASE(or_where_equations_are_not_finite) {
  const SystemPointer logarithm =
      flat(1, 0, 1, [](V x, V v, V, T) { return equations({v[0] - log(x[0])}); });
  const LadderAscent found = ascent(logarithm, at({-1.0}));
  BOOST_TEST(found.levels.empty());
  BOOST_TEST(!found.has_point());
  BOOST_TEST(found.reason.ends_with(
      " is not finite at the given values: the algorithm stops before level 0."));
}

// The centre of a circle of radius 0, its only point.
BOOST_AUTO_TEST_CASE(or_at_a_singular_point) {
  const SystemPointer point = flat(2, 0, 2, [](V x, V v, V, T) {
    return equations({v[0] - x[1], square(x[0]) + square(x[1])});
  });
  const LadderAscent found = ascent(point, at({0.0, 0.0}));
  BOOST_TEST(found.is_singular());
  BOOST_TEST(found.singular.reason != "");
}

BOOST_AUTO_TEST_CASE(other_dimensions_of_earlier_levels_are_told) {
  std::vector<LadderLevel> before(1), now(2);
  before[0].dim_S = now[0].dim_S = 4;
  before[0].dim_M = now[0].dim_M = 2;
  BOOST_TEST(change(before, now) == "");
  now[0].dim_M = 1;
  BOOST_TEST(change(before, now) ==
             "Level 0 has other dimensions at the point of level 0 than at that of level 1.");
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
