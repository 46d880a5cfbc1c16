#include "campaign.hpp"

#include <boost/test/unit_test.hpp>
#include <vector>

// Mistakes that these cases have to notice:
//  * a trial is in no part, or in two
//  * words that are no part are taken for all
BOOST_AUTO_TEST_SUITE(campaign)

using courant::test::Campaign;

BOOST_AUTO_TEST_CASE(each_trial_is_in_one_part) {
  for (const long parts : {1, 3, 4})
    for (const long count : {0, 1, 5, 12, 1000}) {
      std::vector<int> made(static_cast<std::size_t>(count), 0);
      long all = 0;
      for (long part = 0; part < parts; ++part) {
        const Campaign campaign(std::to_string(part) + "/" + std::to_string(parts));
        long here = 0;
        for (long trial = 0; trial < count; ++trial)
          if (campaign.has(trial)) ++made[static_cast<std::size_t>(trial)], ++here;
        BOOST_TEST(campaign.of(count) == here);
        BOOST_TEST(campaign.is_whole() == (parts == 1));
        all += here;
      }
      BOOST_TEST(all == count);
      for (const int times : made) BOOST_TEST(times == 1);
    }
}

BOOST_AUTO_TEST_CASE(all_are_made_where_nothing_is_said) {
  BOOST_TEST(Campaign().of(7) == 7);
  BOOST_TEST(Campaign("whole").of(7) == 7);
}

BOOST_AUTO_TEST_CASE(words_that_are_no_part_are_refused) {
  for (const char* words : {"", "4/4", "1", "1/", "/4", "-1/4", "1/4 ", "one/four", "0/0"})
    BOOST_CHECK_THROW(Campaign{std::string(words)}, std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
