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
  BOOST_TEST(has(text, "resistor <i>R</i>1 from a to <i>b</i> value <i>R</i>"), text);
  BOOST_TEST(has(text, "0, a, <i>b</i>"));
  BOOST_TEST(!has(text, "and more"));
  network["elements"][0]["value"] = {{"odd", 1}};
  BOOST_TEST(has(head({run_of({{"system", network}})}), "and more"));
  Json canonical = pendulum;
  canonical["system"]["structure"] = {{"type", "canonical"}};
  BOOST_TEST(has(head({run_of(canonical)}), ">canonical<"));
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
      head({run_of({{"system", {{"hamiltonian", std::string(301, 'x')}}}})});
  BOOST_TEST(!has(long_formula, "hamiltonian"), long_formula);
  BOOST_TEST(has(long_formula, "and more"));
  BOOST_TEST(!has(head({run_of(pendulum)}), "and more"));
}

BOOST_AUTO_TEST_SUITE_END()
