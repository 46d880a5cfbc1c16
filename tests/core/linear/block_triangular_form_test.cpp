#include "courant/core/linear/block_triangular_form.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <set>

namespace courant {
// Mistakes that these cases have to notice:
//  * blocks come in the order from the last one to the first
//  * a block that can be divided is left whole, or one that cannot is divided
//  * a pattern whose matrices are singular is taken for a regular one
BOOST_AUTO_TEST_SUITE(block_triangular_form_test)

namespace {

using Places = std::vector<Eigen::Index>;

// Whether the blocks divide all rows and columns, and rows have no entries in columns of later blocks.
bool is_triangular(const std::vector<DiagonalBlock>& blocks, Eigen::Index size,
                   const std::vector<PatternEntry>& entries) {
  std::set<Eigen::Index> rows, columns;
  for (const DiagonalBlock& block : blocks) {
    if (block.rows.size() != block.columns.size()) return false;
    rows.insert(block.rows.begin(), block.rows.end());
    columns.insert(block.columns.begin(), block.columns.end());
    for (const auto& [row, column] : entries)
      if (std::ranges::count(block.rows, row) > 0 && !columns.contains(column)) return false;
  }
  return std::ssize(rows) == size && std::ssize(columns) == size;
}

}  // namespace

BOOST_AUTO_TEST_CASE(nothing_is_divided_into_nothing) {
  BOOST_TEST(block_triangular_form(0, {})->empty());
}

// Row 2 has to be first, then row 0, then row 1.
BOOST_AUTO_TEST_CASE(what_others_wait_for_comes_first) {
  const std::vector<PatternEntry> entries = {{0, 0}, {0, 2}, {1, 0}, {1, 1}, {1, 2}, {2, 2}};
  const auto blocks = block_triangular_form(3, entries);
  BOOST_REQUIRE(blocks.has_value());
  BOOST_TEST(blocks->size() == 3u);
  BOOST_TEST(is_triangular(*blocks, 3, entries));
  BOOST_TEST(((*blocks)[0].rows == Places{2}));
  BOOST_TEST(((*blocks)[2].rows == Places{1}));
}

// Three rows that wait for each other, in a circle, and two that wait for these and for each other; rows and columns are
// not in the order of the blocks.
BOOST_AUTO_TEST_CASE(what_waits_for_itself_stays_together) {
  const std::vector<PatternEntry> entries = {{0, 3}, {0, 1}, {2, 1}, {2, 4}, {4, 4}, {4, 3},
                                             {1, 0}, {1, 2}, {1, 3}, {3, 2}, {3, 0}};
  const auto blocks = block_triangular_form(5, entries);
  BOOST_REQUIRE(blocks.has_value());
  BOOST_TEST(blocks->size() == 2u);
  BOOST_TEST(is_triangular(*blocks, 5, entries));
  BOOST_TEST(((*blocks)[0].rows == Places{0, 2, 4}));
  BOOST_TEST(((*blocks)[0].columns == Places{1, 3, 4}));
}

BOOST_AUTO_TEST_CASE(two_rows_for_one_column_have_no_form) {
  const std::vector<PatternEntry> entries = {{0, 0}, {1, 0}, {2, 1}, {2, 2}};
  BOOST_TEST(!block_triangular_form(3, entries).has_value());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
