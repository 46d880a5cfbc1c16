#include <boost/test/unit_test.hpp>

#include "../core/campaign.hpp"
#include "random_networks.hpp"

namespace courant::test {

BOOST_AUTO_TEST_SUITE(network_ladders_long)

// As network_ladders, of up to 200 nodes. Ladders that are not certain say so, and are right all the same.
void check_large_networks(Spread spread, int most_ambiguous) {
  constexpr int networks = 500;
  std::mt19937 generator(11);
  const Campaign campaign = Campaign::of_environment();
  const LadderTally tally =
      tally_ladders(generator, networks, 200, spread, Starts::in_turn, campaign);
  BOOST_TEST_MESSAGE(tally.right << " of " << tally.count << " ladders are right, "
                                 << tally.ambiguous << " ambiguous");
  for (const std::string& wrong : tally.wrong) BOOST_TEST_ERROR(wrong);
  BOOST_TEST(tally.right == tally.count);
  BOOST_TEST(tally.count == campaign.of(networks));
  BOOST_TEST(tally.ambiguous <= most_ambiguous);
}

BOOST_AUTO_TEST_CASE(of_random_networks_in_random_units) { check_large_networks(Spread::units, 0); }
BOOST_AUTO_TEST_CASE(of_random_networks_over_decades) { check_large_networks(Spread::decades, 75); }

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::test
