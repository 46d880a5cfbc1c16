#include "courant/integrators/certificate/level_certainty.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/certificate/singularity.hpp"
#include "ladder_catalogue.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * whatever was neglected is far from what counts
//  * ranks that the bound of their errors hardly allows are confirmed
//  * ranks lower than those of the pattern are taken for proven
BOOST_AUTO_TEST_SUITE(level_certainty_test)

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

}  // namespace

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

// Bounds of errors prove what is far above them, and next to nothing that they do not cover.
BOOST_AUTO_TEST_CASE(ranks_are_proven_by_the_bounds_of_their_errors) {
  const ConsistentPoint consistent(circle(1.0), at({0.6, -0.8}), {});
  const ConsistentJet jet = consistent.find(consistent.start());
  std::vector<LadderLevel> levels = levels_at(jet);
  BOOST_TEST(are_proven(levels));
  BOOST_TEST(has_refined_ranks(jet, levels));
  levels[0].all.is_doubtful = true;
  BOOST_TEST(!are_certain(levels));
  settle(levels);
  BOOST_TEST(are_certain(levels));
  levels[0].without_point.below = 0.9;
  BOOST_TEST(!are_proven(levels));
  ++levels[0].all.rank;
  BOOST_TEST(!has_refined_ranks(jet, levels));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
