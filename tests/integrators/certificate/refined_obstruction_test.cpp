#include "courant/integrators/certificate/refined_obstruction.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "ladder_catalogue.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * what round-off hides is not asked with more digits
BOOST_AUTO_TEST_SUITE(refined_obstruction_test)

using namespace courant::examples;

namespace {

using V = const ExprVector&;
using T = const Expr&;

using Answer = Obstruction::Answer;

struct Setting {
  Setting(const SystemPointer& system, std::initializer_list<double> x)
      : consistent(system, at(x), {}),
        jet(consistent.find(consistent.start())),
        levels(levels_at(jet)),
        tangents(jet.array(), jet.zero().y, jet.zero().nominal) {
    BOOST_TEST_REQUIRE(jet.zero().found);
  }

  ConsistentPoint consistent;
  ConsistentJet jet;
  std::vector<LadderLevel> levels;
  TangentDisplacement tangents;
};

// x' = y beside a circle that is there twice, the second time with numbers of this size that cancel.
SystemPointer circle_twice(double size) {
  return flat(2, 0, 3, [size](V x, V v, V, T) {
    const Expr circle = square(x[0]) + square(x[1]) - 1;
    return equations({v[0] - x[1], circle, 3 * circle + ((x[1] + size) - x[1] - size)});
  });
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_doubles_can_tell_needs_no_more_digits) {
  Setting regular(circle_twice(0.0), {0.6, -0.8});
  RefinedObstruction none(regular.jet, regular.levels, regular.tangents.magnitude());
  BOOST_TEST((none.is_seen_along(regular.tangents.next()) == Answer::no));
  BOOST_TEST(!none.has_refined_ranks().has_value());
  // x' = y beside x² + y² = 0.
  const SystemPointer point = flat(2, 0, 2, [](V x, V v, V, T) {
    return equations({v[0] - x[1], square(x[0]) + square(x[1])});
  });
  Setting singular(point, {0.0, 0.0});
  RefinedObstruction seen(singular.jet, singular.levels, singular.tangents.magnitude());
  BOOST_TEST((seen.is_seen_along(singular.tangents.next()) == Answer::yes));
  BOOST_TEST(!seen.has_refined_ranks().has_value());
}

BOOST_AUTO_TEST_CASE(what_round_off_hides_is_told_by_more_digits) {
  Setting hidden(circle_twice(1e12), {0.6, -0.8});
  const VectorXd tangent = hidden.tangents.next();
  const Obstruction rough(hidden.jet.array(), hidden.jet.zero().y, hidden.jet.zero().uncertainty,
                          hidden.levels.back().all.rank, hidden.tangents.magnitude());
  BOOST_TEST_REQUIRE((rough.is_seen_along(tangent) == Answer::unknown));
  RefinedObstruction refined(hidden.jet, hidden.levels, hidden.tangents.magnitude());
  BOOST_TEST((refined.is_seen_along(tangent) == Answer::no));
  BOOST_TEST(refined.has_refined_ranks().value_or(false));
  // Not with other ranks.
  std::vector<LadderLevel> lower = hidden.levels;
  --lower.back().without_point.rank;
  RefinedObstruction unlike(hidden.jet, lower, hidden.tangents.magnitude());
  BOOST_TEST((unlike.is_seen_along(tangent) == Answer::unknown));
  BOOST_TEST(!unlike.has_refined_ranks().value_or(true));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
