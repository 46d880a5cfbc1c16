#include "courant/integrators/certificate/nearest_start.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "ladder_catalogue.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(nearest_start_test)

// Mistakes that these cases have to notice:
//  * no other guesses where there may be nearer points elsewhere
//  * positions that were found move with the velocities

using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

// q' = w on the ellipse x² + 4 y² = 4, and what keeps it there.
SystemPointer ellipse() {
  return flat(4, 1, 5, [](V x, V v, V z, T) {
    return equations({v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0], v[3] + 4.0 * z[0] * x[1],
                      square(x[0]) + 4.0 * square(x[1]) - 4.0});
  });
}

LeastChange of(std::vector<Index> rows, const VectorXd& given) {
  LeastChange change{std::move(rows), given, {}};
  change.root.resize(given.size(), given.size());
  change.root.setIdentity();
  return change;
}

NearestStart nearest(const InitialGuess& guess, const std::vector<LeastChange>& changes) {
  std::vector<NearestStart::Stage> stages;
  for (const LeastChange& change : changes)
    stages.push_back([change](const State&) { return change; });
  return NearestStart(std::make_shared<const ChartEquations>(ellipse()), guess,
                      ConstraintAlgorithm().run(ellipse(), guess), stages);
}

}  // namespace

// The velocity that is given is projected at the point that is found, however far that is.
BOOST_AUTO_TEST_CASE(stages_come_one_after_the_other) {
  const InitialGuess guess = at({2.3, 0.4, 0.7, 0.9});
  const NearestStart start =
      nearest(guess, {of({0, 1}, guess.x.head(2)), of({2, 3}, guess.x.tail(2))});
  BOOST_TEST(start.is_proven());
  BOOST_TEST_REQUIRE(start.outcomes().size() == 2u);
  const Eigen::Vector2d q = start.point().x.head(2), w = start.point().x.tail(2);
  const Eigen::Vector2d normal = Eigen::Vector2d(q[0], 4.0 * q[1]).normalized();
  const Eigen::Vector2d moved = q - guess.x.head(2), given = guess.x.tail(2);
  BOOST_TEST(std::fabs(moved[0] * normal[1] - moved[1] * normal[0]) < 1e-9);
  BOOST_TEST((w - (given - normal * normal.dot(given))).norm() < 1e-9);
  BOOST_TEST(start.outcomes()[0].distance == moved.norm(), boost::test_tools::tolerance(1e-9));
}

// From (1, 0.05), inside the ellipse, the way that search goes first need not be the shortest: (1.3, ±0.76) is nearer than (2, 0).
BOOST_AUTO_TEST_CASE(points_on_the_other_side_are_tried) {
  for (const double y : {0.05, -0.05}) {
    const InitialGuess guess = at({1.0, y, 0.0, 0.0});
    const NearestStart start = nearest(guess, {of({0, 1}, guess.x.head(2))});
    double least = 10.0;  // by looking everywhere
    for (int i = 0; i < 100'000; ++i) {
      const double angle = 2e-5 * std::numbers::pi * i;
      least = std::min(least, std::hypot(2.0 * std::cos(angle) - 1.0, std::sin(angle) - y));
    }
    BOOST_TEST(start.outcomes()[0].distance == least, boost::test_tools::tolerance(1e-6));
  }
}

BOOST_AUTO_TEST_CASE(held_values_are_kept_to_the_bit) {
  InitialGuess guess = at({1.1, 0.4, 0.7, 0.9});
  guess.hold_x = {0, 2};
  const NearestStart start =
      nearest(guess, {of({0, 1}, guess.x.head(2)), of({2, 3}, guess.x.tail(2))});
  BOOST_TEST(start.point().x[0] == 1.1);
  BOOST_TEST(start.point().x[2] == 0.7);
  BOOST_TEST(start.point().x[1] == std::sqrt(1.0 - 1.1 * 1.1 / 4.0),
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
