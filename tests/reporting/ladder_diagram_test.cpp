#include "courant/reporting/ladder_diagram.hpp"

#include <boost/test/unit_test.hpp>

#include "../plotting/parsed_markup.hpp"

using namespace courant;
using namespace courant::test;
using Json = nlohmann::ordered_json;

namespace {

Json ladder(const std::string& verdict, int index, int gauge,
            const std::vector<std::pair<int, int>>& dimensions) {
  Json levels = Json::array();
  for (const auto& [S, M] : dimensions) {
    levels.push_back(
        {{"k", levels.size()}, {"dim_S", S}, {"dim_M", M}, {"fibre", S - M}, {"residual", 0.25}});
  }
  return {{"verdict", verdict}, {"index", index}, {"gauge_dimension", gauge}, {"levels", levels}};
}

std::vector<std::string> texts(const Json& ladder, const std::string& style) {
  std::vector<std::string> found;
  for (const Tree& text : find(parsed(ladder_diagram(ladder).str()), "text", style)) {
    const auto name = text.get_optional<std::string>("tspan");
    found.push_back(name.value_or("") + text.data());
  }
  return found;
}

using Texts = std::vector<std::string>;

}  // namespace

BOOST_AUTO_TEST_SUITE(ladder_diagram)

BOOST_AUTO_TEST_CASE(pendulum_has_four_levels_and_their_relations) {
  const Json pendulum = ladder("regular", 2, 0, {{4, 3}, {3, 2}, {2, 2}, {2, 2}});
  BOOST_CHECK(texts(pendulum, "set") == (Texts{"S₀", "M₀", "S₁", "M₁", "S₂", "M₂", "S₃", "M₃"}));
  BOOST_CHECK(texts(pendulum, "dimension") ==
              (Texts{"dim 4", "dim 3", "dim 3", "dim 2", "dim 2", "dim 2", "dim 2", "dim 2"}));
  BOOST_CHECK(texts(pendulum, "relation") == (Texts{"⊇", "⊇", "⊇", "=", "=", "="}));
  BOOST_CHECK(texts(pendulum, "map") == (Texts{"τ", "τ", "τ", "τ"}));
}

BOOST_AUTO_TEST_CASE(verdicts_are_sentences) {
  BOOST_TEST(verdict_in_words(ladder("regular", 1, 0, {{16, 8}, {8, 8}, {8, 8}})) ==
             "Regular. The algorithm stops at k = 1: S_f = S₁ is the graph of a vector field on "
             "M_f = M₁, of "
             "dimension 8; through each of its points passes exactly one solution.");
  BOOST_TEST(verdict_in_words(ladder("gauge", 1, 1, {{6, 5}, {5, 4}, {5, 4}})) ==
             "Gauge. The algorithm stops at k = 1: solutions pass through each point of M_f = M₁, "
             "of dimension 4, but "
             "their velocity is free in 1 direction.");
  BOOST_TEST(verdict_in_words(ladder("inconsistent", 1, 0, {{3, 2}, {-1, -1}})) ==
             "Inconsistent. No point nearby satisfies the equations and their derivatives: there "
             "is no solution "
             "(least residual 0.25).");
  BOOST_TEST(verdict_in_words(ladder("rank-change", 0, 0, {})).starts_with("The rank changes"));
  BOOST_TEST(verdict_in_words(ladder("not-reached", 0, 0, {{3, 2}, {2, 1}})).ends_with("k = 1."));
  BOOST_TEST(verdict_in_words(ladder("<of a later version>", 0, 0, {})) == "<of a later version>");
}

BOOST_AUTO_TEST_CASE(sets_without_points_are_empty) {
  const Json inconsistent = ladder("inconsistent", 1, 0, {{3, 2}, {-1, -1}});
  BOOST_CHECK(texts(inconsistent, "set") == (Texts{"S₀", "M₀", "S₁ = ∅", "M₁ = ∅"}));
  BOOST_TEST(texts(ladder("not-reached", 0, 0, {}), "set").empty());
}

BOOST_AUTO_TEST_SUITE_END()
