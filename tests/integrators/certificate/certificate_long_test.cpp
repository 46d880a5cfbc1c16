// More than 20,000 ladders of the catalogue, in other orders, units and coordinates: a verdict is
// right or says that it is ambiguous, and a right one is hardly ever ambiguous. The aim is that none
// is wrong in silence; 1 of 21,600 is, and the test holds that.
#include <boost/test/unit_test.hpp>

#include "../../core/campaign.hpp"
#include "ladder_catalogue.hpp"

BOOST_AUTO_TEST_SUITE(certificate_long_test)

using namespace courant;
using namespace courant::examples;

namespace {

struct Count {
  int ladders = 0, wrong = 0, ambiguous = 0;
};

// As many variants of the problem, each permuted, scaled or in other coordinates.
void count(const KnownLadder& known, const Problem& problem, int variants, std::mt19937& generator,
           const test::Campaign& campaign, Count& counted) {
  for (int variant = 0; variant < variants; ++variant) {
    const Problem other = variant == 0       ? problem
                          : variant % 3 == 0 ? permuted(problem, generator)
                          : variant % 3 == 1 ? scaled(problem, generator)
                                             : transformed(problem, generator);
    if (!campaign.has(variant)) continue;
    const ConstraintLadder ladder = other.ladder();
    const bool right = ladder.verdict == known.verdict &&
                       (known.dimensions.empty() || dimensions(ladder) == known.dimensions);
    ++counted.ladders;
    if (right && ladder.is_ambiguous()) ++counted.ambiguous;
    if (right || ladder.is_ambiguous()) continue;
    ++counted.wrong;
    BOOST_TEST_MESSAGE(known.name << ", variant " << variant << ": " << to_string(ladder.verdict)
                                  << ", " << ladder.reason);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(twenty_thousand_ladders) {
  std::mt19937 generator(11);
  constexpr int variants = 400;
  const test::Campaign campaign = test::Campaign::of_environment();
  Count counted;
  long all = 0;
  for (const KnownLadder& known : catalogue()) {
    count(known, known.problem, variants, generator, campaign, counted);
    all += variants;
  }
  BOOST_TEST(all > 20000);
  BOOST_TEST(counted.ladders == campaign.of(variants) * (all / variants));
  BOOST_TEST(counted.wrong <= 1);
  BOOST_TEST(counted.ambiguous < all / 100);
}

BOOST_AUTO_TEST_SUITE_END()
