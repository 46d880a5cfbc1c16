// What is divided among ranks: blocks that stay together, and their neighbours.
#include "courant/extensions/petsc/block_graph.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

namespace courant {
namespace {

BOOST_AUTO_TEST_SUITE(block_graph_test)

// Bodies in a row, each of `parts` coordinates that forces between neighbours couple all with all.
std::vector<PatternEntry> bodies(Index count, Index parts) {
  std::vector<PatternEntry> pattern;
  for (Index row = 0; row < count * parts; ++row)
    for (Index other = std::max<Index>(0, row / parts - 1);
         other <= std::min(count - 1, row / parts + 1); ++other)
      for (Index k = 0; k < parts; ++k) pattern.push_back({row, other * parts + k});
  return pattern;
}

BOOST_AUTO_TEST_CASE(coordinates_of_a_body_stay_together) {
  const BlockGraph graph("step", 15, bodies(5, 3));
  BOOST_TEST(graph.weights.size() == 5u);
  for (Index k = 0; k < 15; ++k) BOOST_TEST(graph.block[static_cast<std::size_t>(k)] == k / 3);
  for (const Index weight : graph.weights) BOOST_TEST(weight == 3);
  const std::vector<Index> begins = {0, 1, 3, 5, 7, 8}, neighbours = {1, 0, 2, 1, 3, 2, 4, 3};
  BOOST_TEST((graph.begins == begins));
  BOOST_TEST((graph.neighbours == neighbours));
}

BOOST_AUTO_TEST_CASE(unknowns_are_matched_with_equations_that_contain_them) {
  // In each row the next unknown, so that the diagonal is empty.
  std::vector<PatternEntry> pattern;
  for (Index row = 0; row < 6; ++row) {
    pattern.push_back({row, (row + 1) % 6});
    if (row % 2 == 0) pattern.push_back({row, (row + 2) % 6});
  }
  const BlockGraph graph("step", 6, pattern);
  std::vector<Index> rows = graph.equation;
  for (Index k = 0; k < 6; ++k) {
    const Index row = rows[static_cast<std::size_t>(k)];
    BOOST_TEST(std::ranges::any_of(pattern, [&](const PatternEntry& entry) {
      return entry.row == row && entry.column == graph.contained[static_cast<std::size_t>(k)];
    }));
  }
  std::ranges::sort(rows);
  BOOST_TEST((rows == std::vector<Index>{0, 1, 2, 3, 4, 5}));
}

BOOST_AUTO_TEST_CASE(unknowns_that_no_equation_contains_are_left_out) {
  const BlockGraph graph("step", 2, {{0, 1}, {1, 1}, {1, 4}});
  BOOST_TEST((graph.contained == std::vector<Index>{1, 4}));
}

BOOST_AUTO_TEST_CASE(equation_of_all_unknowns_makes_no_neighbours) {
  const Index count = 300;
  std::vector<PatternEntry> pattern;
  for (Index row = 0; row < count; ++row)
    for (Index k = 0; k < count; ++k)
      if (row == 0 || k == row) pattern.push_back({row, k});
  BOOST_TEST(BlockGraph("step", count, pattern).neighbours.empty());
}

BOOST_AUTO_TEST_CASE(dense_system_is_divided_too) {
  std::vector<PatternEntry> pattern;
  for (Index row = 0; row < 30; ++row)
    for (Index k = 0; k < 30; ++k) pattern.push_back({row, k});
  const BlockGraph graph("step", 30, pattern);
  BOOST_TEST((graph.weights == std::vector<Index>{12, 12, 6}));
  BOOST_TEST((graph.begins == std::vector<Index>{0, 2, 4, 6}));
}

bool names_the_step(const std::invalid_argument& error) {
  return std::string(error.what()).find("a step of pendulum") != std::string::npos;
}

BOOST_AUTO_TEST_CASE(what_is_not_square_or_singular_is_refused) {
  BOOST_CHECK_EXCEPTION(BlockGraph("pendulum", 2, {{0, 0}, {1, 0}}), std::invalid_argument,
                        names_the_step);
  BOOST_CHECK_EXCEPTION(BlockGraph("pendulum", 3, {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}}),
                        std::invalid_argument, names_the_step);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
}  // namespace courant
