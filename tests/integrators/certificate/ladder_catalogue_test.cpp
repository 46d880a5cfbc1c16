#include "ladder_catalogue.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(ladder_catalogue_test)

using namespace courant;
using namespace courant::examples;

namespace {

Index algebraic_redundancies(const ConstraintLadder& ladder) {
  return std::count_if(
      ladder.redundancies.begin(), ladder.redundancies.end(), [](const Combination& combination) {
        return std::all_of(combination.terms.begin(), combination.terms.end(),
                           [](const Combination::Term& term) { return term.derivative == 0; });
      });
}

void check_ladder(const std::string& name, const ConstraintLadder& ladder,
                  const KnownLadder& expected) {
  BOOST_TEST_CONTEXT(name << ": " << ladder.reason) {
    BOOST_TEST(to_string(ladder.verdict) == to_string(expected.verdict));
    if (expected.dimensions.empty()) return;
    BOOST_TEST(ladder.index == expected.index);
    BOOST_TEST(ladder.levels.size() == expected.dimensions.size());
    if (expected.index >= 0) BOOST_TEST(algebraic_redundancies(ladder) == expected.redundant);
    for (std::size_t k = 0; k < std::min(ladder.levels.size(), expected.dimensions.size()); ++k) {
      BOOST_TEST_CONTEXT("level " << k << ": " << ladder.levels[k].all << "; "
                                  << ladder.levels[k].without_tangent << "; "
                                  << ladder.levels[k].without_point) {
        BOOST_TEST(ladder.levels[k].dim_S == expected.dimensions[k].first);
        BOOST_TEST(ladder.levels[k].dim_M == expected.dimensions[k].second);
        BOOST_TEST((ladder.levels[k].is_empty || !ladder.levels[k].is_ambiguous()));
      }
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(known_ladders) {
  const std::vector<KnownLadder> table = catalogue();
  BOOST_TEST(table.size() == 54U);
  for (const KnownLadder& known : table) check_ladder(known.name, known.problem.ladder(), known);
}

BOOST_AUTO_TEST_CASE(order_of_equations_and_unknowns_does_not_matter) {
  std::mt19937 generator(7);
  for (const KnownLadder& known : catalogue())
    for (int trial = 0; trial < 3; ++trial)
      check_ladder(known.name, permuted(known.problem, generator).ladder(), known);
}

BOOST_AUTO_TEST_CASE(units_of_equations_and_unknowns_do_not_matter) {
  std::mt19937 generator(8);
  for (const KnownLadder& known : catalogue())
    for (int trial = 0; trial < 3; ++trial)
      check_ladder(known.name, scaled(known.problem, generator).ladder(), known);
}

BOOST_AUTO_TEST_CASE(coordinates_do_not_matter) {
  std::mt19937 generator(9);
  for (const KnownLadder& known : catalogue())
    for (int trial = 0; trial < 3; ++trial)
      check_ladder(known.name, transformed(known.problem, generator).ladder(), known);
}

BOOST_AUTO_TEST_SUITE_END()
