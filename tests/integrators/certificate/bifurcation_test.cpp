#include "courant/integrators/certificate/bifurcation.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "ladder_catalogue.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * velocities of points nearby are no branches
//  * whatever velocity leads back is that of a branch
BOOST_AUTO_TEST_SUITE(bifurcation_test)

using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

// θ' = ω, ω²/2 = cos θ: a pendulum by its energy.
SystemPointer pendulum() {
  return flat(2, 0, 2, [](V x, V v, V, T) {
    return equations({v[0] - x[1], 0.5 * square(x[1]) - cos(x[0])});
  });
}

// q' = v, v² + q² = 1.
SystemPointer oscillator() {
  return flat(2, 0, 2, [](V x, V v, V, T) {
    return equations({v[0] - x[1], square(x[1]) + square(x[0]) - 1});
  });
}

ConstraintLadder ladder(const SystemPointer& system, const InitialGuess& start) {
  return ConstraintAlgorithm().run(system, start);
}

}  // namespace

// Rest and motion both solve the equations where a motion turns: differentiated, they read ω (ω' + sin θ) = 0.
BOOST_AUTO_TEST_CASE(turning_points_are_singular) {
  for (const auto& [system, x] : {std::pair(pendulum(), at({std::numbers::pi / 2, 0.0})),
                                  std::pair(oscillator(), at({1.0, 0.0}))}) {
    const ConstraintLadder found = ladder(system, x);
    BOOST_TEST(to_string(found.verdict) == "rank-change", found.reason);
    BOOST_TEST(!found.is_ambiguous());
  }
}

// Elsewhere on the same curves there is one solution.
BOOST_AUTO_TEST_CASE(points_between_turning_points_are_regular) {
  for (const auto& [system, x] : {std::pair(pendulum(), at({0.5, std::sqrt(2.0 * std::cos(0.5))})),
                                  std::pair(oscillator(), at({0.6, -0.8}))}) {
    const ConstraintLadder found = ladder(system, x);
    BOOST_TEST(to_string(found.verdict) == "regular", found.reason);
    BOOST_TEST(found.degrees_of_freedom == 1);
    BOOST_TEST(!found.is_ambiguous());
  }
}

// With its acceleration as an equation motion alone solves a pendulum at rest; with hidden constraints there
// are fewer points on each level, and no branch.
BOOST_AUTO_TEST_CASE(hidden_constraints_are_no_branches) {
  const SystemPointer rod = flat(4, 1, 5, [](V x, V v, V z, T) {
    return equations({v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0], v[3] + z[0] * x[1] + 1,
                      square(x[0]) + square(x[1]) - 1});
  });
  const ConstraintLadder found = ladder(rod, at({1.0, 0.0, 0.0, 0.0}));
  BOOST_TEST(to_string(found.verdict) == "regular", found.reason);
  BOOST_TEST(found.degrees_of_freedom == 2);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
