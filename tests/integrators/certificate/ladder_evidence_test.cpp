#include "courant/integrators/certificate/ladder_evidence.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "ladder_catalogue.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * redundant equations are not asked for their next derivatives
//  * the uncertainty of a point is said to hide numbers behind what is identically zero
//  * what more digits said on the way is asked again
//  * ranks that fill the pattern of the equations stay doubtful
BOOST_AUTO_TEST_SUITE(ladder_evidence_test)

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

struct Weighed {
  Weighed(const SystemPointer& system, const InitialGuess& guess)
      : consistent(system, guess, {}), ascent(consistent, *system, 12), evidence(ascent) {}
  std::vector<Doubt> doubts() const { return courant::doubts(consistent, ascent, evidence); }

  ConsistentPoint consistent;
  LadderAscent ascent;
  LadderEvidence evidence;
};

}  // namespace

BOOST_AUTO_TEST_CASE(nothing_is_doubtful_of_a_circle) {
  const Weighed weighed(circle(1.0), at({0.6, -0.8}));
  BOOST_TEST(weighed.evidence.is_known);
  BOOST_TEST(weighed.evidence.is_same_rank);
  BOOST_TEST(!weighed.evidence.is_refined);
  BOOST_TEST(weighed.doubts().empty());
}

// Doubtful ranks that fill the pattern of independent equations are proven, and cleared.
BOOST_AUTO_TEST_CASE(full_ranks_of_the_pattern_need_nothing_else) {
  const ConsistentPoint consistent(circle(1.0), at({0.6, -0.8}), {});
  LadderAscent ascent(consistent, *circle(1.0), 12);
  ascent.levels.back().all.is_doubtful = true;
  ascent.singular.is_compared = ascent.singular.is_confirmed = false;
  const LadderEvidence evidence(ascent);
  BOOST_TEST(evidence.is_proven);
  BOOST_TEST(evidence.is_full);
  BOOST_TEST(!ascent.levels.back().all.is_doubtful);
  BOOST_TEST(doubts(consistent, ascent, evidence).empty());
}

// What an ascent says of the way becomes sentences.
BOOST_AUTO_TEST_CASE(what_the_way_leaves_open_is_told) {
  Weighed weighed(circle(1.0), at({0.6, -0.8}));
  weighed.ascent.changed = "Level 0 has other dimensions.";
  weighed.ascent.has_converged = false;
  weighed.ascent.singular.is_compared = false;
  weighed.ascent.singular.is_unanimous = false;
  weighed.ascent.singular.seen_once = "Ranks differ.";
  weighed.evidence.is_known = weighed.evidence.is_same_rank = false;
  const std::vector<Doubt> doubts = weighed.doubts();
  BOOST_TEST_REQUIRE(doubts.size() == 7u);
  BOOST_TEST(doubts[0].text == "Level 0 has other dimensions.");
  BOOST_TEST(doubts[1].text == "In one direction the point may be singular: Ranks differ.");
  BOOST_TEST(doubts[2].text == "Too few points nearby could be compared with this one.");
  BOOST_TEST(doubts[3].text == "In one direction the point does not look singular.");
  BOOST_TEST(doubts[4].text == "A search that does not converge says nothing.");
  BOOST_TEST(doubts[5].text.starts_with("The ranks are higher at the point as it was found"));
  BOOST_TEST(
      doubts[6].text.starts_with("The derivatives of the equations are not known well enough"));
  weighed.evidence.is_proven = weighed.evidence.is_full = true;
  BOOST_TEST(weighed.doubts().size() == 5u);
}

// More digits that were asked on the way are not asked again: what they said is taken.
BOOST_AUTO_TEST_CASE(more_digits_settle_what_is_doubtful) {
  for (const bool is_refined : {true, false}) {
    const SystemPointer twice = flat(2, 0, 3, [](V x, V v, V, T) {
      return equations({v[0] - x[1], v[1] + x[0], 2 * (v[0] - x[1]) + x[0] * (v[0] - x[1])});
    });
    const ConsistentPoint consistent(twice, at({0.6, -0.8}), {});
    LadderAscent ascent(consistent, *twice, 12);
    BOOST_TEST_REQUIRE(ascent.is_stopped);
    ascent.levels.back().all.is_doubtful = true;
    ascent.singular.is_confirmed = false;
    ascent.singular.is_refined = is_refined;
    const LadderEvidence evidence(ascent);
    BOOST_TEST(!evidence.is_full);
    BOOST_TEST(evidence.is_refined == is_refined);
    BOOST_TEST(ascent.levels.back().all.is_doubtful == !is_refined);
  }
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
