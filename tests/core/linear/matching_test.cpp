#include "courant/core/linear/matching.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

namespace courant {
// Mistakes that these cases have to notice:
//  * rows are taken for columns
BOOST_AUTO_TEST_SUITE(matching_test)

namespace {

using Columns = std::vector<Eigen::Index>;

}  // namespace

BOOST_AUTO_TEST_CASE(nothing_is_matched_where_there_is_nothing) {
  BOOST_TEST(largest_matching(0, 3, {}).empty());
  const auto found = largest_matching(2, 3, {});
  BOOST_TEST((found == Columns{-1, -1}));
}

// The first row takes the second column, or there would be none for the second.
BOOST_AUTO_TEST_CASE(a_row_leaves_the_only_column_of_another) {
  const std::vector<PatternEntry> entries = {{0, 0}, {0, 1}, {1, 0}};
  BOOST_TEST((largest_matching(2, 2, entries) == Columns{1, 0}));
}

BOOST_AUTO_TEST_CASE(one_of_two_rows_is_left_over_for_one_column) {
  const std::vector<PatternEntry> entries = {{0, 2}, {1, 2}, {2, 0}};
  const Columns found = largest_matching(3, 3, entries);
  BOOST_TEST(found[2] == 0);
  BOOST_TEST(std::min(found[0], found[1]) == -1);
  BOOST_TEST(std::max(found[0], found[1]) == 2);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
