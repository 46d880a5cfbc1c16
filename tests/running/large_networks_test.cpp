// Networks of 10⁴ states and more: what is done with n × n numbers takes gigabytes there.
#include <boost/test/unit_test.hpp>

#include "courant/integrators/vector_field.hpp"
#include "lc_line.hpp"
#include "problems.hpp"

namespace courant {
namespace {

BOOST_AUTO_TEST_SUITE(large_networks)

BOOST_AUTO_TEST_CASE(a_line_of_many_cells_swings_in_its_mode) {
  const test::LcLine line{.cells = 10000, .mode = 3300};
  const test::Problem problem = test::problem(line.experiment());
  BOOST_TEST((problem.ladder.verdict == Verdict::regular));
  BOOST_TEST(problem.ladder.degrees_of_freedom == 2 * line.cells + 1);
  BOOST_TEST(!problem.ladder.is_ambiguous());

  const double h = 0.4;
  const long steps = 20;
  const VectorXd x = problem.end(test::method_1("midpoint"), h * static_cast<double>(steps), steps);
  // The midpoint rule turns every mode by 2 arctan(ω h/2) a step.
  const double amplitude =
      std::cos(2.0 * static_cast<double>(steps) * std::atan(0.5 * h * line.frequency()));
  double worst = 0.0;
  for (int i = 0; i <= line.cells; ++i)
    worst = std::max(worst,
                     std::fabs(x[i] - line.capacitance(i) * amplitude * line.voltage_at_start(i)));
  BOOST_TEST(worst < 1e-11);
}

// The current of the source is the derivative of a charge that has no freedom of its own. From 500
// unknowns on the equations for it are found among the few that give nothing explicitly.
BOOST_AUTO_TEST_CASE(the_current_of_a_source_across_a_capacitor) {
  for (const int cells : {20, 400}) {
    Json experiment = Json::parse(R"json({"system": {"type": "network", "parameters": {"N": 0},
      "nodes": ["0", {"repeat": {"i": [0, "N"]}, "name": "n{i}"}],
      "elements": [
        {"type": "voltage-source", "name": "S", "from": "n0", "to": "0", "value": "sin(3*t)"},
        {"repeat": {"i": [0, "N"]}, "type": "capacitor", "name": "C{i}", "from": "n{i}",
         "to": "0", "value": 2},
        {"repeat": {"i": [1, "N"]}, "type": "inductor", "name": "L{i}", "from": "n{i-1}",
         "to": "n{i}", "value": 5}]},
      "initial": {"phi_L1": 15}})json");
    experiment["system"]["parameters"]["N"] = cells;
    const test::Problem line = test::problem(experiment);
    BOOST_TEST(line.ladder.index == 1);
    BOOST_TEST(line.ladder.degrees_of_freedom == 2 * cells);
    // What is not given is 0.
    BOOST_TEST(line.ladder.point.x.norm() == 15.0);
    const VectorField field(line.experiment.model.system, line.ladder, Backend::interpreter);
    VectorField::Evaluation evaluation(field);
    VectorXd rate;
    evaluation(line.ladder.point, rate);
    const auto place = [&](const char* name) {
      return line.experiment.model.vocabulary.coordinates.find({.name = name, .indices = {}}).first;
    };
    BOOST_TEST(std::fabs(rate[place("q_C0")] - 6.0) < 1e-12);
    BOOST_TEST(std::fabs(rate[place("q_C1")] - 3.0) < 1e-12);
    BOOST_TEST(rate.norm() < 6.8);  // √45, and nothing else
    BOOST_TEST(std::fabs(evaluation.z()[0] + 9.0) < 1e-12);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
}  // namespace courant
