#include "courant/reporting/ladder_explanation.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "courant/running/consistent_start.hpp"
#include "courant/running/ladder_json.hpp"

using namespace courant;

namespace {

Json ladder(const Json& experiment) {
  const Experiment read = read_experiment(experiment.dump());
  return ladder_json(consistent_start(read), *read.model.system);
}

Json pendulum() {
  return ladder(
      {{"system",
        {{"type", "implicit"},
         {"coordinates", {"x", "y", "v", "w"}},
         {"unknowns", {"tension"}},
         {"equations",
          {"x' - v", "y' - w", "v' + tension*x", "w' + tension*y + 1", "x^2 + y^2 - 1"}}}},
       {"initial", {{"x", 0.6}, {"y", -0.8}, {"v", 0.8}, {"w", 0.6}}}});
}

bool contains(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

std::string all(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(ladder_explanation_test)

// x v + y w = 0 by differentiating the length, and T = (v² + w² - y)/(x² + y²) from the second
// derivative.
BOOST_AUTO_TEST_CASE(pendulum_in_formulas) {
  const Json found = pendulum();
  BOOST_REQUIRE_EQUAL(found.at("formulas").size(), 2U);
  BOOST_TEST(found["formulas"][0]["formula"] == "x^2 + y^2 - 1");
  BOOST_TEST(found["formulas"][1]["level"] == 1);
  BOOST_TEST(found["formulas"][1]["formula"] == "x*v + y*w");
  BOOST_TEST(found["unknowns"]["tension"]["formula"] == "(-y + v^2 + w^2)/(x^2 + y^2)",
             found["unknowns"]["tension"]["formula"]);
  BOOST_TEST(found["unknowns"]["tension"]["value"].get<double>() == 1.8,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(found["unknowns"]["tension"]["determined"].get<bool>());
  // The hidden constraint is the length differentiated, with x' - v and y' - w to remove
  // velocities; its gradient (v, w, x, y) but for a multiple of (x, y, 0, 0), that of the length
  // itself.
  const Json& hidden = found["constraints"][1];
  BOOST_TEST(hidden["level"] == 1);
  int highest = 0;
  for (const Json& term : hidden["from"]) {
    highest = std::max(highest, term["derivative"].get<int>());
    if (term["derivative"] == 1) BOOST_TEST(term["equation"] == "x^2 + y^2 - 1");
  }
  BOOST_TEST(highest == 1);
  const auto entry = [&](const char* name) { return hidden["gradient"].value(name, 0.0); };
  const double scale = entry("v") / 0.6;
  BOOST_TEST(entry("w") == -0.8 * scale, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::abs((entry("x") - 0.8 * scale) * -0.8 - (entry("y") - 0.6 * scale) * 0.6) < 1e-9);
}

BOOST_AUTO_TEST_CASE(pendulum_in_words) {
  const auto lines = ladder_explanation(pendulum());
  BOOST_TEST(contains(lines, "one hidden constraint"), all(lines));
  BOOST_TEST(contains(lines, "x*v + y*w = 0"));
  BOOST_TEST(contains(lines, "Degrees of freedom: 2"));
  BOOST_TEST(contains(lines, "tension = 1.8"));
  BOOST_TEST(contains(lines, "How sure"));
  BOOST_TEST(!contains(lines, "ambiguous"));
  const auto diagram = ladder_text_diagram(pendulum());
  BOOST_REQUIRE_EQUAL(diagram.size(), 5U);
  BOOST_TEST(diagram[1].find("S₀  ⊇    S₁  ⊇    S₂  =    S₃") != std::string::npos, diagram[1]);
  BOOST_TEST(diagram[3].find("M₀  ⊇    M₁  =    M₂  =    M₃") != std::string::npos, diagram[3]);
}

// The Gauss law x p_y - y p_x = 0 is hidden in d/dt p_z, and z' is free.
BOOST_AUTO_TEST_CASE(gauge_directions_and_gauss_law) {
  const Json found = ladder(
      {{"system",
        {{"type", "lagrangian"},
         {"coordinates", {"x", "y", "z"}},
         {"lagrangian", "((x' + z*y)^2 + (y' - z*x)^2)/2 - (x^2 + y^2)/2"}}},
       {"initial", {{"x", 1}, {"y", 0.5}, {"z", 0.3}, {"p_x", 1}, {"p_y", 0.5}, {"p_z", 0}}}});
  BOOST_REQUIRE_EQUAL(found.at("formulas").size(), 2U);
  BOOST_TEST(found["formulas"][0]["formula"] == "p_z");
  const std::string gauss = found["formulas"][1]["formula"];
  BOOST_TEST(gauss == "x*p_y - y*p_x");
  BOOST_REQUIRE_EQUAL(found.at("gauge_directions").size(), 1U);
  BOOST_TEST(found["gauge_directions"][0].size() == 1U);
  BOOST_TEST(found["gauge_directions"][0].contains("z'"));
  BOOST_TEST(contains(ladder_explanation(found), "Gauge: the velocity may be changed at will"));
}

BOOST_AUTO_TEST_CASE(redundant_equations_are_told) {
  const Json found = ladder({{"system",
                              {{"type", "implicit"},
                               {"coordinates", {"x", "y"}},
                               {"equations", {"x' - y", "y' + x", "x' + y' - y + x"}}}},
                             {"initial", {{"x", 1}, {"y", 0}}}});
  BOOST_TEST(found["redundant"].size() == 1U);
  BOOST_TEST(found["redundant"][0].size() == 3U);
  BOOST_TEST(contains(ladder_explanation(found), "Redundant: one equation follows"));
}

BOOST_AUTO_TEST_CASE(what_ends_without_an_index_is_still_explained) {
  const Json found = ladder(
      {{"system", {{"type", "lagrangian"}, {"coordinates", {"q"}}, {"lagrangian", "q' + q"}}},
       {"initial", {{"q", 0}}}});
  BOOST_TEST(found["moves"].empty());
  BOOST_TEST(!found.contains("constraints"));
  BOOST_TEST(ladder_text_diagram(found)[1].find("S₀  ⊇     ∅") != std::string::npos);
  BOOST_TEST(contains(ladder_explanation(found), "How sure"));
}

BOOST_AUTO_TEST_SUITE_END()
