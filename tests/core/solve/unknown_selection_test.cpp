#include "courant/core/solve/unknown_selection.hpp"

#include <boost/test/unit_test.hpp>

namespace courant {
BOOST_AUTO_TEST_SUITE(unknown_selection_test)

namespace {

BOOST_AUTO_TEST_CASE(the_pattern_is_that_of_the_unknowns_that_are_contained) {
  Graph graph;
  const ExprVector y = graph.variables("y", 5);
  ExprVector F(2);
  F << y[4] * y[1], sin(y[3]) + y[1];
  const ContainedUnknowns contained(Function("F", {{"y", y}}, F, {.differentiate = {"y"}}));
  BOOST_TEST(contained.places == (std::vector<Index>{1, 3, 4}), boost::test_tools::per_element());
  BOOST_TEST(contained.pattern.rows == 2);
  BOOST_TEST(contained.pattern.columns == 3);
  BOOST_TEST(contained.pattern.row == (std::vector<Index>{0, 0, 1, 1}),
             boost::test_tools::per_element());
  BOOST_TEST(contained.pattern.column == (std::vector<Index>{0, 2, 0, 1}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(groups_end_among_the_places) {
  BOOST_TEST(group_ends({2, 0, 3, 1}, {1, 3, 4}) == (std::vector<Index>{1, 1, 3, 3}),
             boost::test_tools::per_element());
  BOOST_TEST(group_ends({}, {1}).empty());
}

}  // namespace

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
