#include "courant/reporting/ladder_explanation.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "courant/running/consistent_start.hpp"
#include "courant/running/ladder_report.hpp"

// Mistakes that these cases have to notice:
//  * the velocity of a pendulum that is given by its Lagrangian on a sphere is not found
//    (integrators/certificate/constraint_formulas.cpp)
//  * velocities are told as if the constraints did not hold
//    (integrators/certificate/constraint_formulas.cpp)
//  * constraints that only elimination of powers finds are left out
//    (integrators/certificate/constraint_formulas.cpp)
//  * velocities that constraints make 0 are formulas (integrators/certificate/nearby_points.cpp)
//  * constraints without a common zero are not noticed
//    (integrators/certificate/constraint_formulas.cpp)
//  * a knife edge is said to have gauge transformations
//    (integrators/certificate/constraint_classes.cpp)
//  * where all velocities are known, those of level 0 are not told
//  * a family that is none is said to be a Morse family
//  * a ladder that stops on the way says what is known at its end (running/ladder_report.cpp)
//  * a report read from a file knows no singular constraints (running/ladder_report_json.cpp)
BOOST_AUTO_TEST_SUITE(ladder_explanation_test)

using namespace courant;

namespace {

Json ladder(const Json& experiment) {
  const Experiment read = read_experiment(experiment.dump());
  return to_json(ladder_report(consistent_start(read), *read.model.system));
}

// Of what is read back.
std::vector<std::string> ladder_explanation(const Json& found) {
  std::vector<std::string> lines;
  for (const Prose& line : courant::ladder_explanation(read_ladder_report(found)))
    lines.push_back(line.str());
  return lines;
}
std::vector<std::string> ladder_text_diagram(const Json& found) {
  return courant::ladder_text_diagram(read_ladder_report(found));
}
Json up_to_level(const Json& found, Index level) {
  return to_json(courant::up_to_level(read_ladder_report(found), level));
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

// x v + y w = 0 by differentiating the length, and T = v² + w² - y, (x² + y²) T before, from the
// second derivative.
BOOST_AUTO_TEST_CASE(pendulum_in_formulas) {
  const Json found = pendulum();
  BOOST_REQUIRE_EQUAL(found.at("formulas").size(), 2U);
  BOOST_TEST(found["formulas"][0]["formula"] == "x^2 + y^2 - 1");
  BOOST_TEST(found["formulas"][1]["level"] == 1);
  BOOST_TEST(found["formulas"][1]["formula"] == "x*v + y*w");
  BOOST_TEST(found["unknowns"]["tension"]["formula"] == "v^2 + w^2 - y",
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

// Two constraints of the first class, one of them primary: of dim M_f = 4 two are left. A system
// given by equations has no brackets.
BOOST_AUTO_TEST_CASE(degrees_of_freedom_both_ways) {
  const Json found = ladder(
      {{"system",
        {{"type", "lagrangian"},
         {"coordinates", {"x", "y", "z"}},
         {"lagrangian", "((x' + z*y)^2 + (y' - z*x)^2)/2 - (x^2 + y^2)/2"}}},
       {"initial", {{"x", 1}, {"y", 0.5}, {"z", 0.3}, {"p_x", 1}, {"p_y", 0.5}, {"p_z", 0}}}});
  BOOST_TEST(found["degrees_of_freedom"] == 4);
  BOOST_TEST(found["degrees_of_freedom_up_to_gauge"] == 2);
  BOOST_TEST(found["classes"]["first_class"] == 2);
  BOOST_TEST(found["classes"]["primary_first_class"] == 1);
  const auto lines = ladder_explanation(found);
  BOOST_TEST(contains(lines, "1 primary (in the equations) and 1 secondary (hidden)"), all(lines));
  BOOST_TEST(contains(lines, "all are of the first class, 1 of these primary"));
  BOOST_TEST(contains(lines, "Degrees of freedom up to gauge: 2"));
  BOOST_TEST(!pendulum().contains("classes"));
  BOOST_TEST(!contains(ladder_explanation(pendulum()), "Classes"));
}

// A knife edge has no gauge, though its constraint has bracket 0 with itself.
BOOST_AUTO_TEST_CASE(constraints_on_velocities_have_no_class) {
  const Json found = ladder(
      {{"system",
        {{"type", "mechanical"},
         {"coordinates", {"x", "y", "theta"}},
         {"nonholonomic", "sin(theta)*x' - cos(theta)*y'"}}},
       {"initial", {{"x", 0}, {"y", 0}, {"theta", 0.3}, {"p_x", 0}, {"p_y", 0}, {"p_theta", 1}}}});
  BOOST_TEST(found["verdict"] == "regular");
  BOOST_TEST(!found.contains("classes"), found);
  const auto lines = ladder_explanation(found);
  BOOST_TEST(!contains(lines, "gauge"), all(lines));
  BOOST_TEST(contains(lines, "Degrees of freedom: 5"), all(lines));
}

// The step from level to level: dφ/dt, and what is left of it with the velocities of the level
// before.
BOOST_AUTO_TEST_CASE(steps_are_shown) {
  const Json found = pendulum();
  BOOST_REQUIRE_EQUAL(found.at("steps").size(), 2U);
  BOOST_TEST(found["steps"][0]["level"] == 1);
  BOOST_TEST(found["steps"][0]["kind"] == "constraint");
  BOOST_TEST(found["steps"][0]["derivative"] == "x*x' + y*y'");
  BOOST_TEST(found["steps"][0]["result"] == "x*v + y*w");
  BOOST_TEST(found["steps"][1]["kind"] == "condition");
  BOOST_TEST(found["steps"][1]["derivative"] == "x*v' + y*w' + v*x' + w*y'");
  BOOST_TEST(found["velocities"]["x'"]["level"] == 0);
  BOOST_TEST(found["velocities"]["v'"]["level"] == 2);
  const auto lines = ladder_explanation(found);
  BOOST_TEST(contains(lines, "x*x' + y*y' = 0, with the velocities of S₀:  x*v + y*w = 0"),
             all(lines));
}

// Equation (10) of the paper: what S₁ adds are the velocities of the vortices.
BOOST_AUTO_TEST_CASE(the_velocities_of_vortices) {
  const Json found = ladder({{"system", {{"type", "point-vortices"}, {"strengths", {1, 1}}}},
                             {"initial", {{"x", {-1, 1}}, {"y", {0, 0}}}}});
  BOOST_TEST(found["velocities"]["x[0]'"]["level"] == 1);
  const std::string x = found["velocities"]["x[0]'"]["formula"],
                    y = found["velocities"]["y[0]'"]["formula"];
  BOOST_TEST(x == "-(y[0] - y[1])/(2*pi*((x[0] - x[1])^2 + (y[0] - y[1])^2))");
  BOOST_TEST(y == "(x[0] - x[1])/(2*pi*((x[0] - x[1])^2 + (y[0] - y[1])^2))");
  BOOST_TEST(contains(ladder_explanation(found), "x[0]' = -(y[0] - y[1])"));
}

// p = 1, so p' = 0; but p' = 1.
BOOST_AUTO_TEST_CASE(a_contradiction_is_derived) {
  const Json found = ladder(
      {{"system", {{"type", "lagrangian"}, {"coordinates", {"q"}}, {"lagrangian", "q' + q"}}},
       {"initial", {{"q", 0}}}});
  const auto lines = ladder_explanation(found);
  for (const char* line : {"    p_q - 1 = 0", "    p_q' = 0", "    p_q' = 1", "    1 = 0",
                           "That cannot be: S₁ is empty."})
    BOOST_TEST((std::find(lines.begin(), lines.end(), line) != lines.end()), line << " is not in\n"
                                                                                  << all(lines));
  BOOST_TEST(found["reason"].get<std::string>().starts_with("No point of S₁ was found"));
}

// On S², with |x| = 1 and x·p = 0 used; on SO(3), with names for the angular velocity.
// Two constraints that no point satisfies: nothing has to be differentiated.
BOOST_AUTO_TEST_CASE(constraints_without_a_common_zero_are_told) {
  const auto lines =
      ladder_explanation(ladder({{"system",
                                  {{"type", "implicit"},
                                   {"coordinates", {"x", "y"}},
                                   {"equations", {"x^2 + y^2 - 1", "x^2 + y^2 - 2"}}}},
                                 {"initial", {{"x", 0.6}, {"y", 0.8}}}}));
  BOOST_TEST(all(lines).starts_with("Level 0. The equations contain\n    x^2 + y^2 - 1 = 0\n    "
                                    "x^2 + y^2 - 2 = 0\nThese have no zero in common: together "
                                    "they lead to 1 = 0.\n"),
             all(lines));
}

// Where the rank changes, the constraint shows why: z² has no linear part where z = 0.
BOOST_AUTO_TEST_CASE(singular_constraints_are_told) {
  const Json found = ladder(
      {{"system",
        {{"type", "lagrangian"},
         {"coordinates", {"x", "y", "z"}},
         {"lagrangian", "x'*z' + y*z^2/2"}}},
       {"initial", {{"x", 0.3}, {"y", 0.2}, {"z", 0}, {"p_x", 0.4}, {"p_y", 0}, {"p_z", 0.5}}}});
  BOOST_TEST(found.at("verdict") == "rank-change");
  BOOST_TEST(all(ladder_explanation(found))
                 .starts_with(
                     "Level 0. The equations contain\n    p_y = 0\nLevel 1. "
                     "Differentiated, that leads to\n    z^2 = 0, whose differential is 0 here\n"),
             all(ladder_explanation(found)));
}

// Momenta of the length of a vector: no equation is linear in a velocity.
BOOST_AUTO_TEST_CASE(the_mass_shell_is_found) {
  const Json found = ladder(
      {{"system",
        {{"type", "lagrangian"},
         {"coordinates", {"s", "x", "y"}},
         {"parameters", {{"m", 2}}},
         {"lagrangian", "-m*sqrt(s'^2 - x'^2 - y'^2)"}}},
       {"initial", {{"s", 0.1}, {"x", 0.2}, {"y", 0.3}, {"s'", 1.3}, {"x'", 0.5}, {"y'", 0.4}}}});
  BOOST_REQUIRE_EQUAL(found.at("formulas").size(), 1U);
  BOOST_TEST(found["formulas"][0]["formula"] == "p_s^2 - p_x^2 - p_y^2 - 4");
}

// A plate that rolls: the formulas of its textbook.
BOOST_AUTO_TEST_CASE(velocities_of_a_rolling_disk_are_simplified) {
  const auto lines = ladder_explanation(ladder(
      {{"system",
        {{"type", "mechanical"},
         {"coordinates", {"x", "y", "theta", "phi"}},
         {"potential", "-0.2*x"},
         {"nonholonomic", {"x' - cos(phi)*theta'", "y' - sin(phi)*theta'"}}}},
       {"initial",
        {{"x", 0.1}, {"y", 0.2}, {"theta", 0.3}, {"phi", 0.7}, {"theta'", 1}, {"phi'", 0.4}}}}));
  BOOST_TEST(contains(lines, "    p_theta' = 0.1*cos(phi)"), all(lines));
  BOOST_TEST(contains(lines, "    p_x' = 0.1*cos(phi)^2 - p_theta*p_phi*sin(phi)"), all(lines));
}

BOOST_AUTO_TEST_CASE(formulas_on_curved_spaces) {
  const Json sphere = ladder({{"system",
                               {{"type", "hamiltonian"},
                                {"manifold", {{"type", "cotangent-bundle"}, {"base", "sphere"}}},
                                {"coordinates", {"x[3]"}},
                                {"hamiltonian", "dot(p_x, p_x)/2 + x[2]"}}},
                              {"initial", {{"x", {0.6, 0, 0.8}}, {"p_x", {0, 0.3, 0}}}}});
  BOOST_TEST(sphere["velocities"]["x[1]'"]["formula"] == "p_x[1]");
  const Json body =
      ladder({{"system",
               {{"type", "hamiltonian"},
                {"manifold", {{"type", "cotangent-bundle"}, {"base", "so3"}}},
                {"coordinates", {"R[3][3]"}},
                {"hamiltonian", "(p_R[0]^2 + p_R[1]^2/2 + p_R[2]^2/3)/2"}}},
              {"initial", {{"R", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {"p_R", {0.1, 0.2, 0.3}}}}});
  BOOST_TEST(body["velocities"]["v_R[1]"]["formula"] == "p_R[1]/2");
  BOOST_TEST(body["velocities"]["p_R[0]'"]["formula"] == "-p_R[1]*p_R[2]/6");
}

// Where the velocity is an unknown that is projected, and with the metric of Lorentz.
BOOST_AUTO_TEST_CASE(formulas_for_momenta_on_curved_spaces) {
  const Json pendulum = ladder({{"system",
                                 {{"type", "lagrangian"},
                                  {"manifold", "sphere"},
                                  {"coordinates", {"x[3]"}},
                                  {"lagrangian", "dot(x', x')/2 - 2*x[2]"}}},
                                {"initial", {{"x", {0.6, 0, 0.8}}, {"x'", {0, 0.3, 0}}}}});
  BOOST_TEST(pendulum["velocities"]["x[1]'"]["formula"] == "p_x[1]");
  BOOST_TEST(pendulum["velocities"]["p_x[1]'"]["formula"] ==
             "x[1]*(2*x[2] - p_x[0]^2 - p_x[1]^2 - p_x[2]^2)");
  const Json hyperbola =
      ladder({{"system",
               {{"type", "hamiltonian"},
                {"manifold", {{"type", "cotangent-bundle"}, {"base", "hyperbolic"}}},
                {"coordinates", {"x[3]"}},
                {"hamiltonian", "(p_x[1]^2 + p_x[2]^2 - p_x[0]^2)/2"}}},
              {"initial", {{"x", {1, 0, 0}}, {"p_x", {0, 0.6, 0.8}}}}});
  BOOST_TEST(hyperbola["velocities"]["x[0]'"]["formula"] == "-p_x[0]");
  BOOST_TEST(hyperbola["velocities"]["p_x[2]'"]["formula"] ==
             "x[2]*(p_x[1]^2 - p_x[0]^2 + p_x[2]^2)");
}

// x² + y² = 1 where the velocity is determined; all of it is told there.
BOOST_AUTO_TEST_CASE(velocities_are_those_of_points_that_satisfy_the_constraints) {
  const auto lines = ladder_explanation(pendulum());
  for (const char* line :
       {"    x' = v", "    y' = w", "    v' = x*(y - v^2 - w^2)", "    w' = y*(y - v^2 - w^2) - 1"})
    BOOST_TEST((std::count(lines.begin(), lines.end(), line) == 1), line << " is not in\n"
                                                                         << all(lines));
  BOOST_TEST(!contains(lines, "For the others"), all(lines));
}

// Nobody named the angular velocity, which is the unknown of a Lagrangian on SO(3).
BOOST_AUTO_TEST_CASE(names_on_a_group) {
  const Json body =
      ladder({{"system",
               {{"type", "lagrangian"},
                {"manifold", "so3"},
                {"coordinates", {"R[3][3]"}},
                {"lagrangian", "sum(i, 0, 2, sum(j, 0, 2, R[i][j]'^2))/4"}}},
              {"initial", {{"R", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {"p_R", {0, 0.2, 0.3}}}}});
  BOOST_TEST(body["unknowns"].contains("v_R[0]"), body["unknowns"]);
}

BOOST_AUTO_TEST_CASE(a_ladder_up_to_a_level) {
  const Json whole = pendulum(), part = up_to_level(whole, 1);
  BOOST_TEST(part["levels"].size() == 2U);
  BOOST_TEST(part["steps"].size() == 1U);
  BOOST_TEST(part["verdict"] == "not-reached");
  BOOST_TEST(part["index"].is_null());
  const auto lines = ladder_explanation(part);
  BOOST_TEST(contains(lines, "x*v + y*w = 0"), all(lines));
  BOOST_TEST(!contains(lines, "tension"));
  BOOST_TEST(!contains(lines, "Degrees of freedom"));
  const bool is_whole = up_to_level(whole, 3) == whole && up_to_level(whole, 9) == whole;
  BOOST_TEST(is_whole);
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

BOOST_AUTO_TEST_CASE(the_rank_of_a_family_is_told) {
  const auto lines = [](const char* family) {
    return ladder_explanation(ladder({{"system",
                                       {{"type", "morse-family"},
                                        {"coordinates", {"q"}},
                                        {"multipliers", {"l", "m"}},
                                        {"family", family}}},
                                      {"initial", {{"q", 0}, {"p_q", 0}}}}));
  };
  BOOST_TEST(contains(lines("p_q^2/2 + l*q + 2*m*q"), "E is no Morse family here: the rank"));
  BOOST_TEST(contains(lines("p_q^2/2 + l*q + 2*m*q"), "is 1, less than the 2 multipliers"));
  BOOST_TEST(contains(lines("p_q^2/2 + l*q + 2*m*p_q"), "E is a Morse family here: the rank"));
  BOOST_TEST(!contains(ladder_explanation(pendulum()), "Morse family"));
}

BOOST_AUTO_TEST_CASE(what_is_proved_is_told) {
  Json found = pendulum();
  BOOST_TEST(!contains(ladder_explanation(found), "roved"));
  found["proof"] = {{"proved", true}, {"point", true},       {"radius", 2e-70},
                    {"not_zero", 20}, {"zero_by_digits", 0}, {"missing", ""}};
  BOOST_TEST(contains(ladder_explanation(found), "those above to 2e-70"));
  BOOST_TEST(contains(ladder_explanation(found), "index and verdict are proved"));
  found["proof"]["zero_by_digits"] = 1;
  BOOST_TEST(contains(ladder_explanation(found), "one number counts as zero"));
  BOOST_TEST(!contains(ladder_explanation(found), "verdict are proved"));
  found["proof"]["missing"] = "A switch may be at its edge.";
  BOOST_TEST(contains(ladder_explanation(found), "Not proved. A switch"));
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

// p_w' = -p_z is 0, though p_z is round-off of the search at the point; y p_x - x p_y of p_A' is p_z by the constraint.
BOOST_AUTO_TEST_CASE(velocities_that_constraints_make_zero_are_zero) {
  const auto mixed =
      ladder_explanation(ladder({{"system",
                                  {{"type", "lagrangian"},
                                   {"coordinates", {"x", "y", "z", "w"}},
                                   {"lagrangian", "y*x' - (x^2 + y^2)/2 + (z' - w)^2/2"}}},
                                 {"initial", {{"x", 1}, {"y", 0.3}, {"z", 0.2}, {"w", 0.4}}}}));
  BOOST_TEST(std::ranges::count(mixed, "    p_w' = 0") == 1, all(mixed));
  const auto universe =
      ladder_explanation(ladder({{"system",
                                  {{"type", "lagrangian"},
                                   {"coordinates", {"a", "N"}},
                                   {"lagrangian", "-a*a'^2/N - N*a*(1 - 1.2*a^2)"}}},
                                 {"initial", {{"a", 0.8}, {"N", 1}, {"p_a", 0.9}}}}));
  BOOST_TEST(std::ranges::count(universe, "    p_N' = 0") == 1, all(universe));
}

// x² + y² = 1 in what follows from it.
BOOST_AUTO_TEST_CASE(constraints_are_simplified_by_those_before) {
  const auto lines = ladder_explanation(
      ladder({{"system",
               {{"type", "lagrangian"},
                {"coordinates", {"x", "y", "l"}},
                {"lagrangian", "(x'^2 + y'^2)/2 + l*(x^2 + y^2 - 1)/2"}}},
              {"initial", {{"x", 1}, {"y", 0}, {"l", 0}, {"p_x", 0}, {"p_y", 1}}}}));
  BOOST_TEST(contains(lines, "    p_x^2 + p_y^2 + l = 0"), all(lines));
  BOOST_TEST(std::ranges::count(lines, "    l' = 0") > 0, all(lines));
}

// p_y exp(x) = 0 and x p_y = 0 with x = 0.5 are p_y = 0, from which p_z = 0 follows.
BOOST_AUTO_TEST_CASE(factors_that_are_not_zero_are_left_out) {
  for (const char* factor : {"exp(x)", "x*z"}) {
    const auto lines = ladder_explanation(
        ladder({{"system",
                 {{"type", "lagrangian"},
                  {"coordinates", {"x", "y", "z"}},
                  {"lagrangian", "((y' - " + std::string(factor) + ")^2 + (z' - y)^2)/2"}}},
                {"initial", {{"x", 0.5}, {"y", 1}, {"z", 2}}}}));
    BOOST_TEST(std::ranges::count(lines, "    p_y = 0") == 1, all(lines));
    BOOST_TEST(std::ranges::count(lines, "    p_z = 0") == 1, all(lines));
  }
}

BOOST_AUTO_TEST_SUITE_END()
