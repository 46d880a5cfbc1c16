#include "courant/running/ladder_report.hpp"

#include <boost/test/unit_test.hpp>
#include <numbers>

#include "courant/core/language/formula.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/consistent_start.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * what elimination found is not read (running/ladder_report_json.cpp)
//  * levels that only confirm are told again
//  * every family is a Morse family
BOOST_AUTO_TEST_SUITE(ladder_report_test)

namespace {

LadderReport report(const Json& experiment) {
  const Experiment read = read_experiment(experiment.dump());
  return ladder_report(consistent_start(read), *read.model.system);
}

// Constraints of both classes, a gauge direction, unknowns that are and are not determined.
const Json gauge = {
    {"system",
     {{"type", "lagrangian"},
      {"coordinates", {"x", "y", "z"}},
      {"lagrangian", "((x' + z*y)^2 + (y' - z*x)^2)/2 - (x^2 + y^2)/2"}}},
    {"initial", {{"x", 1}, {"y", 0.5}, {"z", 0.3}, {"p_x", 1}, {"p_y", 0.5}, {"p_z", 0}}}};
const Json redundant = {{"system",
                         {{"type", "implicit"},
                          {"coordinates", {"x", "y"}},
                          {"equations", {"x' - y", "y' + x", "x' + y' - y + x"}}}},
                        {"initial", {{"x", 1}, {"y", 0}}}};
const Json pendulum = {
    {"system",
     {{"type", "implicit"},
      {"coordinates", {"x", "y", "v", "w"}},
      {"unknowns", {"tension"}},
      {"equations",
       {"x' - v", "y' - w", "v' + tension*x", "w' + tension*y + 1", "x^2 + y^2 - 1"}}}},
    {"initial", {{"x", 0.6}, {"y", -0.8}, {"v", 0.8}, {"w", 0.6}}}};
const Json inconsistent = {
    {"system", {{"type", "lagrangian"}, {"coordinates", {"q"}}, {"lagrangian", "q' + q"}}},
    {"initial", {{"q", 0}}}};

}  // namespace

BOOST_AUTO_TEST_CASE(levels_that_only_confirm_have_no_dimensions_of_their_own) {
  using Pair = LadderReport::Dimensions;
  const LadderReport ladder{.levels = {{.k = 0, .dim_S = 4, .dim_M = 3},
                                       {.k = 1, .dim_S = 2, .dim_M = 2},
                                       {.k = 2, .dim_S = 2, .dim_M = 2},
                                       {.k = 3}}};
  BOOST_TEST((ladder.dimensions() == std::vector<Pair>{{4, 3}, {2, 2}, {{}, {}}}));
}

BOOST_AUTO_TEST_CASE(reads_back_to_what_was_written) {
  for (const Json& experiment : {gauge, redundant, pendulum, inconsistent}) {
    const LadderReport whole = report(experiment);
    for (const LadderReport& ladder : {whole, up_to_level(whole, 0)}) {
      const std::string text = to_json(ladder).dump(1);
      BOOST_TEST(to_json(read_ladder_report(Json::parse(text))).dump(1) == text);
    }
  }
}

BOOST_AUTO_TEST_CASE(has_what_was_found) {
  const LadderReport found = read_ladder_report(to_json(report(gauge)));
  BOOST_TEST((found.verdict == Verdict::gauge));
  BOOST_TEST(found.gauge_dimension == 1);
  BOOST_TEST(found.degrees_of_freedom.value() == 4);
  BOOST_TEST(found.classes.value().brackets.value().first_class == 2);
  BOOST_TEST(found.classes->degrees_of_freedom_up_to_gauge == 2);
  BOOST_TEST(found.constraints.value().size() == 2u);
  BOOST_TEST(found.elimination.value().formulas[1].formula == "x*p_y - y*p_x");
  BOOST_TEST(found.end.value().gauge_directions.size() == 1u);
  BOOST_TEST(found.end->gauge_directions[0][0].first == "z'");
  BOOST_TEST(report(redundant).end->redundant.size() == 1u);
  const LadderReport empty = read_ladder_report(to_json(report(inconsistent)));
  BOOST_TEST((empty.verdict == Verdict::inconsistent));
  BOOST_TEST(!empty.index);
  BOOST_TEST(!empty.levels.back().dim_S);
  BOOST_TEST(!empty.constraints);
  BOOST_TEST(empty.elimination.has_value());
}

// E = p²/2 + λ₀ q + λ₁ c(q, p): conditions that repeat each other, and such that do not.
BOOST_AUTO_TEST_CASE(the_rank_of_a_family) {
  const auto found = [](const char* second) {
    return report({{"system",
                    {{"type", "morse-family"},
                     {"coordinates", {"q"}},
                     {"multipliers", {"l", "m"}},
                     {"family", "p_q^2/2 + l*q + m*(" + std::string(second) + ")"}}},
                   {"initial", {{"q", 0}, {"p_q", 0}}}});
  };
  for (const auto& [second, rank] : {std::pair{"3*q", 1}, std::pair{"p_q", 2}}) {
    const LadderReport read = read_ladder_report(to_json(found(second)));
    BOOST_REQUIRE(read.family);
    BOOST_TEST(read.family->multipliers == 2);
    BOOST_TEST(read.family->rank == rank);
  }
  BOOST_TEST(to_json(found("3*q")).at("family").at("morse") == false);
  BOOST_TEST(to_json(found("p_q")).at("family").at("morse") == true);
  // Those of the conditions of a Lagrangian are told as redundant equations.
  BOOST_TEST(!report(gauge).family);
}

// p' = - (∇V)ᵀP - |p|² x, with gravity 2 along z. From everywhere, axes and rest included.
BOOST_AUTO_TEST_CASE(velocities_on_the_sphere_are_formulas) {
  Json experiment = {{"system",
                      {{"type", "hamiltonian"},
                       {"manifold", {{"type", "cotangent-bundle"}, {"base", "sphere"}}},
                       {"coordinates", {"x[3]"}},
                       {"hamiltonian", "(p_x[0]^2 + p_x[1]^2 + p_x[2]^2)/2 + 2*x[2]"}}}};
  const std::pair<Json, Json> starts[] = {
      {{0.6, 0, -0.8}, {0, 0.9, 0}}, {{1, 0, 0}, {0, 0, 1}}, {{0, 0, -1}, {0, 0, 0}}};
  for (const auto& [x, p] : starts) {
    experiment["initial"] = {{"x", x}, {"p_x", p}};
    const auto found = report(experiment).elimination.value();
    BOOST_REQUIRE(found.velocity("p_x[0]'"));
    BOOST_TEST(found.velocity("x[1]'")->formula == "p_x[1]");
    BOOST_TEST(found.velocity("p_x[0]'")->formula ==
               "x[0]*(2*x[2] - p_x[0]^2 - p_x[1]^2 - p_x[2]^2)");
    BOOST_TEST(found.velocity("p_x[2]'")->formula ==
               "2*x[2]^2 - x[2]*p_x[0]^2 - x[2]*p_x[1]^2 - x[2]*p_x[2]^2 - 2");
  }
}

// x' = Γ y × x/(2 π |x - y|²) with |x - y|² = 2 (1 - x·y).
BOOST_AUTO_TEST_CASE(vortices_on_the_sphere_have_formulas) {
  const Json experiment = {{"system", {{"type", "spherical-vortices"}, {"strengths", {1, 0.5}}}},
                           {"initial", {{"x", {{1, 0, 0}, {0, 0.6, 0.8}}}}}};
  const auto found = report(experiment).elimination.value();
  BOOST_REQUIRE(found.velocity("x[0][0]'"));
  BOOST_TEST(found.velocity("x[0][0]'")->formula ==
             "(x[0][2]*x[1][1] - x[0][1]*x[1][2])/(8*pi*(1 - x[0][0]*x[1][0] - x[0][1]*x[1][1] - "
             "x[0][2]*x[1][2]))");
  BOOST_TEST(found.velocities.size() == 6u);
}

BOOST_AUTO_TEST_CASE(words_that_are_not_known_are_refused) {
  BOOST_CHECK_THROW(read_ladder_report({{"verdict", "later"}}), std::invalid_argument);
  BOOST_CHECK_THROW(
      read_ladder_report(
          {{"verdict", "gauge"}, {"formulas", Json::array()}, {"steps", {{{"kind", "odd"}}}}}),
      std::invalid_argument);
}

// A product less another one: with its parentheses it has the value of what was written, at any point.
BOOST_AUTO_TEST_CASE(formulas_have_the_values_of_the_equations) {
  const LadderReport ladder =
      report({{"system",
               {{"type", "implicit"},
                {"coordinates", {"x", "u"}},
                {"equations", {"x'-((x-u)*(x^2+u)-(x-u)*(u^2+x))/pi/((x^2+u)*(u^2+x))", "u'-1"}}}},
              {"initial", {{"x", 0.3}, {"u", 0.5}}}});
  const LadderReport::Velocity* velocity = ladder.elimination->velocity("x'");
  BOOST_REQUIRE(velocity != nullptr);
  for (const auto& [x, u] : {std::pair(0.3, 0.5), std::pair(1.7, -0.4), std::pair(2.0, 5.0)}) {
    SymbolTable symbols;
    symbols.add("x", Expr(x));
    symbols.add("u", Expr(u));
    const double above = (x - u) * (x * x + u) - (x - u) * (u * u + x);
    const double value = above / std::numbers::pi / ((x * x + u) * (u * u + x));
    BOOST_TEST(parse_formula(velocity->formula, symbols).value() == value,
               boost::test_tools::tolerance(1e-5));
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
