#include <boost/test/unit_test.hpp>

#include "random_networks.hpp"

namespace courant::test {

BOOST_AUTO_TEST_SUITE(network_ladders)

void check_small_networks(Spread spread) {
  std::mt19937 generator(7);
  const LadderTally tally = tally_ladders(generator, 60, 20, spread, Starts::each);
  for (const std::string& wrong : tally.wrong) BOOST_TEST_ERROR(wrong);
  BOOST_TEST(tally.right == 120);
  BOOST_TEST(tally.ambiguous == 0);
  BOOST_TEST(tally.with_loops > 20);
  BOOST_TEST(tally.with_cut_sets > 20);
}

BOOST_AUTO_TEST_CASE(of_random_networks_in_random_units) { check_small_networks(Spread::units); }
BOOST_AUTO_TEST_CASE(of_random_networks_over_decades) { check_small_networks(Spread::decades); }

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::test
