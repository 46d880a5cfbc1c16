// Networks of 10⁴ states and more: what is done with n × n numbers takes gigabytes there.
#include <boost/test/unit_test.hpp>

#include "courant/integrators/step/vector_field.hpp"
#include "lc_line.hpp"
#include "problems.hpp"

namespace courant {
namespace {

// Mistakes that these cases have to notice:
//  * of many equations only those that give an unknown explicitly are kept
//    (integrators/step/vector_field.cpp)
//  * equations that no conormal contains take others with them
//    (integrators/step/transported_conormals.cpp)
//  * charges that are not given are asked for (running/consistent_start.cpp)
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

// Sources hold the voltages of capacitors at both ends: the conormals of M_f are those of two charges, which
// the equations and their derivatives, 4,800 in all, have to be asked for. The line carries a wave
//
//   u_i = sin(ω t - φ i),   2 sin(φ/2) = ω,   current into the line at 0: C/2 u_0' + i_1
//
// with L = C = 1.
BOOST_AUTO_TEST_CASE(method_2_between_two_sources) {
  const int cells = 600;
  const double phi = 0.1, omega = 2.0 * std::sin(phi / 2.0);
  Json experiment = Json::parse(R"json({"system": {"type": "network",
      "parameters": {"N": 0, "phi": 0.1, "omega": "2*sin(phi/2)"},
      "nodes": ["0", {"repeat": {"i": [0, "N"]}, "name": "n{i}"}],
      "elements": [
        {"type": "voltage-source", "name": "A", "from": "n0", "to": "0", "value": "sin(omega*t)"},
        {"type": "voltage-source", "name": "B", "from": "n{N}", "to": "0",
         "value": "sin(omega*t - N*phi)"},
        {"repeat": {"i": [0, "N"]}, "type": "capacitor", "name": "C{i}", "from": "n{i}",
         "to": "0", "value": 1},
        {"repeat": {"i": [1, "N"]}, "type": "inductor", "name": "L{i}", "from": "n{i-1}",
         "to": "n{i}", "value": 1}]},
      "initial": {
        "q_C{i}": {"repeat": {"i": [0, "N"]}, "value": "sin(-phi*{i})"},
        "phi_L{i}": {"repeat": {"i": [1, "N"]}, "value": "sin(-phi*({i} - 1/2))"}}})json");
  experiment["system"]["parameters"]["N"] = cells;
  const test::Problem line = test::problem(experiment);
  BOOST_TEST(line.ladder.degrees_of_freedom == 2 * cells - 1);
  const double end = 8.0;
  std::vector<double> errors;
  for (const long steps : {20L, 40L}) {
    const VectorXd x = line.end(Json::parse(R"({"type": "constrain-first"})"), end, steps);
    double worst = 0.0;
    for (int i = 0; i <= cells; ++i)
      worst = std::max(worst, std::fabs(x[i] - std::sin(omega * end - phi * i)));
    // The sources are where M_f is, whatever the step.
    BOOST_TEST(std::fabs(x[0] - std::sin(omega * end)) < 1e-13);
    BOOST_TEST(std::fabs(x[cells] - std::sin(omega * end - phi * cells)) < 1e-13);
    errors.push_back(worst);
  }
  BOOST_TEST(errors[0] < 1e-3);
  BOOST_TEST(std::fabs(std::log2(errors[0] / errors[1]) - 2.0) < 0.15);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace
}  // namespace courant
