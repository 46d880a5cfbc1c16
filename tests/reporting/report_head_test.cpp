#include "courant/reporting/report_head.hpp"

#include <boost/test/unit_test.hpp>

#include "some_runs.hpp"

// Mistakes that these cases have to notice:
//  * equations of the first run stand above several that have other ones
//  * elements of a network are told without their names
BOOST_AUTO_TEST_SUITE(report_head_test)

using namespace courant;
using namespace courant::test;

namespace {

Run run_of(const Json& experiment, RunStatus status = RunStatus::completed) {
  Run run = table({"t", "q"}, 3, [](std::size_t, double t) { return t; });
  run.experiment = experiment;
  run.summary.status = status;
  return run;
}

const Json pendulum = {{"system",
                        {{"type", "hamiltonian"},
                         {"coordinates", {"q"}},
                         {"hamiltonian", "p_q^2/2 - g*cos(q) & <"},
                         {"parameters", {{"g", 9.81}, {"l", "1/2"}}}}}};

std::string head(const std::vector<Run>& runs) { return report_head(runs).str(); }

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(equations_parameters_and_status_are_there) {
  const std::string text = head({run_of(pendulum)});
  BOOST_TEST(has(text, "p_q^2/2 - g*cos(q) &amp; &lt;"), text);
  BOOST_TEST(has(text, "<mi>g</mi><mo>=</mo><mn>9.81</mn>"));
  BOOST_TEST(has(
      text, "<mi>l</mi><mo>=</mo><mfrac><mrow><mn>1</mn></mrow><mrow><mn>2</mn></mrow></mfrac>"));
  BOOST_TEST(has(text, ">completed</span>, 2 steps"));
  BOOST_TEST(!has(text, "coordinates"));
  BOOST_TEST(has(head({run_of(pendulum, RunStatus::failed)}), R"(class="bad">failed)"));
}

BOOST_AUTO_TEST_CASE(lists_of_equations_and_ready_made_systems) {
  const std::string equations =
      head({run_of({{"system", {{"type", "implicit"}, {"equations", {"x' - y", "y' + x"}}}}})});
  BOOST_TEST(has(equations, "<mo>−</mo><mi>y</mi><mo>=</mo><mn>0</mn>"), equations);
  BOOST_TEST(has(equations, "<mo>+</mo><mi>x</mi><mo>=</mo><mn>0</mn>"));
  const std::string top = head({run_of(
      {{"system", {{"type", "heavy-top"}, {"I", {1, 1, 0.4}}}}, {"parameters", {{"m", 2}}}})});
  BOOST_TEST(has(top,
                 "<mi>I</mi><mo>=</mo><mrow><mo>(</mo><mn>1</mn><mo>,</mo><mn>1</mn><mo>,</"
                 "mo><mn>0.4</mn>"),
             top);
  BOOST_TEST(has(top, "<mi>m</mi><mo>=</mo><mn>2</mn>"));
}

BOOST_AUTO_TEST_CASE(networks_are_told_in_words) {
  const Json resistor = {
      {"type", "resistor"}, {"name", "R1"}, {"from", "a"}, {"to", "b"}, {"value", "R"}};
  Json network = {{"type", "network"}, {"nodes", {"0", "a", "b"}}, {"elements", {resistor}}};
  const std::string text = head({run_of({{"system", network}})});
  const auto set = [](const std::string& name) {
    return "<math displaystyle=\"true\"><mrow>" + name + "</mrow></math>";
  };
  const std::string a = set("<mi>a</mi>"), b = set("<mi>b</mi>");
  BOOST_TEST(has(text, " from " + a + " to " + b + ": value " + set("<mi>R</mi>")), text);
  BOOST_TEST(has(text, set("<mn>0</mn>") + ", " + a + ", " + b), text);
  BOOST_TEST(!has(text, "and more"));
  network["elements"][0]["value"] = {{"odd", 1}};
  BOOST_TEST(has(head({run_of({{"system", network}})}), "and more"));
  Json canonical = pendulum;
  canonical["system"]["structure"] = {{"type", "canonical"}};
  BOOST_TEST(has(head({run_of(canonical)}), ">canonical<"));
}

// Definitions, and what stands in objects: densities of energy and boundaries are said part by part.
BOOST_AUTO_TEST_CASE(objects_are_told_part_by_part) {
  Json defined = pendulum;
  defined["system"]["definitions"] = {{"h", "l*cos(q)"}};
  BOOST_TEST(has(head({run_of(defined)}), "<mi>h</mi><mo>=</mo><mi>l</mi>"),
             head({run_of(defined)}));
  const Json string = {{"type", "stokes-dirac"},
                       {"complex", {{"interval", {{"length", 2}, {"cells", "N"}}}}},
                       {"states", {"p", "q"}},
                       {"energy", {{"p", "p^2/2"}}},
                       {"boundary", {{"left", {{"v", 0}}}}}};
  const std::string text = head({run_of({{"system", string}})});
  BOOST_TEST(has(text, "interval: <math"), text);
  BOOST_TEST(has(text, "<mi>N</mi>"));
  BOOST_TEST(has(text, "left: <math"), text);
  BOOST_TEST(!has(text, "<mi>p</mi><mo>=</mo>"), text);
  BOOST_TEST(has(text, "<mi>p</mi></mrow><mrow><mn>2</mn>"), text);
  BOOST_TEST(!has(text, "and more"));
  Json mesh = string;
  mesh["complex"] = {{"mesh", "drum.msh"}};
  BOOST_TEST(has(head({run_of({{"system", mesh}})}), "drum.msh"));
}

// A matrix that is wider than a page is told entry by entry.
BOOST_AUTO_TEST_CASE(wide_matrices_have_a_line_for_an_entry) {
  const std::string entry(90, 'm');
  Json mechanical = {{"type", "mechanical"}, {"metric", {{entry, 0}, {0, entry}}}};
  const std::string text = head({run_of({{"system", mechanical}})});
  BOOST_TEST(!has(text, "<mtable>"), text);
  BOOST_TEST(has(text, "<mn>1</mn><mo>,</mo><mn>1</mn>"), text);
  BOOST_TEST(!has(text, "<mn>0</mn><mo>,</mo><mn>1</mn>"), text);
  mechanical["metric"] = {{"m", 0}, {0, "m"}};
  BOOST_TEST(has(head({run_of({{"system", mechanical}})}), "<mtable>"));
}

// Names of arrays are told with their sizes, keys as words.
BOOST_AUTO_TEST_CASE(declared_arrays_have_sizes) {
  const std::string text = head({run_of({{"system",
                                          {{"type", "optimal-control"},
                                           {"states", {"R[3][3]", "x"}},
                                           {"controls", {"u[n]"}},
                                           {"heat_conductivity", "k"}}}})});
  BOOST_TEST(has(text, "<mi>R</mi></mrow></math> (3 × 3), <math"), text);
  BOOST_TEST(!has(text, "<msub>"), text);
  BOOST_TEST(has(text, "<dt>heat conductivity</dt>"), text);
}

// What is longer than twelve lines is folded, not left out.
BOOST_AUTO_TEST_CASE(long_heads_are_folded) {
  Json many = pendulum;
  for (int i = 0; i < 13; ++i) many["system"]["definitions"]["a_" + std::to_string(i)] = "q";
  const std::string text = head({run_of(many)});
  BOOST_TEST(has(text, "<details><summary>16 formulas</summary>"), text);
  BOOST_TEST(!has(head({run_of(pendulum)}), "<details>"));
}

BOOST_AUTO_TEST_CASE(of_several_runs_only_what_all_have) {
  Json other = pendulum;
  other["system"]["hamiltonian"] = "p_q^2";
  const std::string gravity = "<mi>g</mi><mo>=</mo><mn>9.81</mn>";
  BOOST_TEST(has(head({run_of(pendulum), run_of(pendulum)}), gravity));
  BOOST_TEST(has(head({run_of(pendulum), run_of(pendulum)}), "2 completed"));
  const std::string both = head({run_of(pendulum), run_of(other, RunStatus::failed)});
  BOOST_TEST(!has(both, gravity), both);
  BOOST_TEST(has(both, "1 completed"));
  BOOST_TEST(has(both, "1 failed"));
}

// An experiment.json may have been written by anybody.
BOOST_AUTO_TEST_CASE(any_experiment_has_a_head) {
  for (const Json& experiment :
       {Json(nullptr), Json(3), Json::array(), Json{{"system", 1}},
        Json{{"system", {{"a", nullptr}}}}, Json{{"system", {{"equations", {"x", {{"y", 1}}}}}}},
        Json{{"parameters", {1, 2}}}})
    BOOST_TEST(has(head({run_of(experiment)}), "completed"), experiment.dump());
  const std::string long_formula =
      head({run_of({{"system", {{"hamiltonian", std::string(1001, 'x')}}}})});
  BOOST_TEST(!has(long_formula, "hamiltonian"), long_formula);
  BOOST_TEST(has(long_formula, "and more"));
  BOOST_TEST(!has(head({run_of(pendulum)}), "and more"));
}

BOOST_AUTO_TEST_SUITE_END()
