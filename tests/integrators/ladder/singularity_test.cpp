#include "courant/integrators/ladder/singularity.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "ladder_catalogue.hpp"

BOOST_AUTO_TEST_SUITE(singularity_test)

using namespace courant;
using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

// x' = y beside x² + y² = r².
SystemPointer circle(double r) {
  return flat(2, 0, 2, [r](V x, V v, V, T) {
    return equations({v[0] - x[1], square(x[0]) + square(x[1]) - r * r});
  });
}

// What is singular at the consistent point of level 0 near x.
Singularity at_level_0(const SystemPointer& system, std::initializer_list<double> x) {
  const ConsistentPoint consistent(system, at(x), {});
  const ConsistentJet jet = consistent.find(consistent.start());
  BOOST_TEST_REQUIRE(jet.zero.found);
  return singularity(consistent, jet, levels_at(jet), true);
}

ConstraintLadder ladder(const SystemPointer& system, const InitialGuess& start) {
  return ConstraintAlgorithm().run(system, start);
}

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

}  // namespace

// (x, y) ↦ x² + y² has no slope at its centre, the only point of the circle of radius 0.
BOOST_AUTO_TEST_CASE(a_constraint_without_a_slope_is_singular) {
  BOOST_TEST(at_level_0(circle(0.0), {0.0, 0.0}).reason != "");
  const Singularity regular = at_level_0(circle(1.0), {0.6, -0.8});
  BOOST_TEST(regular.reason == "");
  BOOST_TEST(regular.seen_once == "");
  BOOST_TEST(regular.is_compared);
}

// A number a thousandth of the least that counts is near.
BOOST_AUTO_TEST_CASE(cuts_with_nothing_near_are_clear) {
  const ConsistentPoint consistent(circle(1.0), at({0.6, -0.8}), {});
  const ConsistentJet jet = consistent.find(consistent.start());
  std::vector<LadderLevel> levels = levels_at(jet);
  BOOST_TEST(are_certain(levels));
  BOOST_TEST(has_clear_cuts(levels));
  BOOST_TEST(is_same_rank_at(jet, levels, false));
  levels[0].all.below = 1e-3 * levels[0].all.above;
  BOOST_TEST(!has_clear_cuts(levels));
}

// A rank of twice the bound of its errors is proven, and no longer doubtful once it is so elsewhere; one that the
// bound hardly allows, or next to a number that it does not cover, stays so.
BOOST_AUTO_TEST_CASE(proven_ranks_are_confirmed) {
  const auto confirmed = [](double above, double below) {
    LadderLevel level;
    for (RankDecision* rank : {&level.all, &level.without_tangent, &level.without_point}) {
      rank->above = 1e6;
      rank->is_doubtful = false;
    }
    level.without_point.above = above;
    level.without_point.below = below;
    level.without_point.is_doubtful = true;
    std::vector<LadderLevel> levels = {level};
    confirm(levels);
    return !levels[0].is_ambiguous();
  };
  BOOST_TEST(confirmed(2.0, 0.1));
  BOOST_TEST(!confirmed(1.1, 0.1));
  BOOST_TEST(!confirmed(2.0, 0.7));
}

// x' = y beside a circle has the ranks of its pattern. Twice the same equation could have rank 2 and has 1; at its
// centre a circle has rank 0, and 1 around it.
BOOST_AUTO_TEST_CASE(ranks_of_the_pattern) {
  const auto has_them = [](const SystemPointer& system, std::initializer_list<double> x) {
    const ConsistentPoint consistent(system, at(x), {});
    const ConsistentJet jet = consistent.find(consistent.start());
    return are_ranks_of_pattern(jet, levels_at(jet));
  };
  BOOST_TEST(has_them(circle(1.0), {0.6, -0.8}));
  BOOST_TEST(!has_them(circle(0.0), {0.0, 0.0}));
  const SystemPointer twice = flat(2, 0, 3, [](V x, V v, V, T) {
    return equations({v[0] - x[1], v[1] + x[0], 2 * (v[0] - x[1])});
  });
  BOOST_TEST(!has_them(twice, {0.6, -0.8}));
}

// Momenta of a relativistic particle at rest: (1, 0, 0) is the nearest one of the mass shell, and velocities stay of
// the size that was given.
BOOST_AUTO_TEST_CASE(a_relativistic_particle_at_rest) {
  const SystemPointer particle =
      lagrangian(3, [](V, V w, T) { return -sqrt(square(w[0]) - square(w[1]) - square(w[2])); });
  InitialGuess start = at({0.1, 0.2, 0.3, 0, 0, 0});
  start.v = at({1.3, 0.5, 0.4, 0, 0, 0}).x;
  start.z = at({1.3, 0.5, 0.4}).x;
  const ConstraintLadder found = ladder(particle, start);
  BOOST_TEST(to_string(found.verdict) == "gauge", found.reason);
  BOOST_TEST(found.degrees_of_freedom == 5);
  BOOST_TEST(!found.is_ambiguous());
  BOOST_TEST(found.point.v.lpNorm<Eigen::Infinity>() < 1e4);
  BOOST_TEST(std::abs(found.point.x[3]) < 1.0 + 1e-6);
}

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
