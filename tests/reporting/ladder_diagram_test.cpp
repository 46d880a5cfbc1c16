#include "courant/reporting/ladder_diagram.hpp"

#include <boost/test/unit_test.hpp>
#include <optional>

#include "../plotting/parsed_markup.hpp"

BOOST_AUTO_TEST_SUITE(ladder_diagram_test)

using namespace courant;
using namespace courant::test;

namespace {

// A level without dimensions is empty.
using Dimensions = std::optional<std::pair<Index, Index>>;

LadderReport ladder(Verdict verdict, Index index, Index gauge,
                    const std::vector<Dimensions>& dimensions) {
  LadderReport report{.verdict = verdict, .index = index, .gauge_dimension = gauge};
  for (const Dimensions& found : dimensions) {
    LadderReport::Level level{.k = static_cast<Index>(report.levels.size()), .residual = 0.25};
    if (found) {
      level.dim_S = found->first;
      level.dim_M = found->second;
      level.fibre = found->first - found->second;
    }
    report.levels.push_back(level);
  }
  return report;
}

Dimensions dims(Index S, Index M) { return std::pair(S, M); }

std::vector<std::string> texts(const LadderReport& ladder, const std::string& style) {
  std::vector<std::string> found;
  for (const Tree& text : find(parsed(ladder_diagram(ladder).str()), "text", style)) {
    const auto name = text.get_optional<std::string>("tspan");
    found.push_back(name.value_or("") + text.data());
  }
  return found;
}

using Texts = std::vector<std::string>;

}  // namespace

BOOST_AUTO_TEST_CASE(pendulum_has_four_levels_and_their_relations) {
  const LadderReport pendulum =
      ladder(Verdict::regular, 2, 0, {dims(4, 3), dims(3, 2), dims(2, 2), dims(2, 2)});
  BOOST_CHECK(texts(pendulum, "set") == (Texts{"S₀", "M₀", "S₁", "M₁", "S₂", "M₂", "S₃", "M₃"}));
  BOOST_CHECK(texts(pendulum, "dimension") ==
              (Texts{"dim 4", "dim 3", "dim 3", "dim 2", "dim 2", "dim 2", "dim 2", "dim 2"}));
  BOOST_CHECK(texts(pendulum, "relation") == (Texts{"⊇", "⊇", "⊇", "=", "=", "="}));
  BOOST_CHECK(texts(pendulum, "map") == (Texts{"τ", "τ", "τ", "τ"}));
}

BOOST_AUTO_TEST_CASE(verdicts_are_sentences) {
  BOOST_TEST(
      verdict_in_words(ladder(Verdict::regular, 1, 0, {dims(16, 8), dims(8, 8), dims(8, 8)})) ==
      "Regular. The algorithm stops at k = 1: S_f = S₁ is the graph of a vector field on "
      "M_f = M₁, of "
      "dimension 8; through each of its points passes exactly one solution.");
  BOOST_TEST(verdict_in_words(ladder(Verdict::gauge, 1, 1, {dims(6, 5), dims(5, 4), dims(5, 4)})) ==
             "Gauge. The algorithm stops at k = 1: solutions pass through each point of M_f = M₁, "
             "of dimension 4, but "
             "their velocity is free in 1 direction.");
  BOOST_TEST(verdict_in_words(ladder(Verdict::inconsistent, 1, 0, {dims(3, 2), std::nullopt})) ==
             "Inconsistent. No point nearby satisfies the equations and their derivatives: there "
             "is no solution "
             "(least residual 0.25).");
  BOOST_TEST(
      verdict_in_words(ladder(Verdict::rank_change, 0, 0, {})).starts_with("The rank changes"));
  BOOST_TEST(verdict_in_words(ladder(Verdict::not_reached, 0, 0, {dims(3, 2), dims(2, 1)}))
                 .ends_with("k = 1."));
}

BOOST_AUTO_TEST_CASE(sets_without_points_are_empty) {
  const LadderReport inconsistent = ladder(Verdict::inconsistent, 1, 0, {dims(3, 2), std::nullopt});
  BOOST_CHECK(texts(inconsistent, "set") == (Texts{"S₀", "M₀", "S₁ = ∅", "M₁ = ∅"}));
  BOOST_TEST(texts(ladder(Verdict::not_reached, 0, 0, {}), "set").empty());
}

BOOST_AUTO_TEST_SUITE_END()
