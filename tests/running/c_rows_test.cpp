#include "courant/running/c_rows.hpp"

#include <boost/test/unit_test.hpp>

#include "problems.hpp"

namespace courant::test {
// Mistakes that these cases have to notice:
//  * observables at the stage are not known before the first step
BOOST_AUTO_TEST_SUITE(c_rows_test)

namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Json oscillator() {
  return Json::parse(R"json({
    "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2" },
    "initial": { "q": 1, "p_q": 0 }, "method": "discretize-first",
    "time": { "step": 0.25, "end": 1 }
  })json");
}

struct Rows {
  explicit Rows(const Json& document)
      : given(problem(document)),
        prepared(given.prepare("discretize-first", 0.01)),
        step(step_program(*prepared.integrator)),
        observed(given.experiment, given.ladder),
        rows(step, observed, *given.experiment.model.system->manifold()) {
    rows.add_functions(functions);
  }

  Problem given;
  PreparedMethod prepared;
  StepProgram step;
  ObservedQuantities observed;
  CRows rows;
  CFunctions functions;
};

}  // namespace

// Nothing within steps is looked at where no energy goes through ports.
BOOST_AUTO_TEST_CASE(what_is_not_asked_for_is_not_written) {
  const Rows closed(oscillator());
  BOOST_TEST(!closed.rows.measures_steps());
  BOOST_TEST(closed.rows.parts() == "");
  BOOST_TEST(has(closed.functions.source(), "observe("));
  BOOST_TEST(!has(closed.functions.source(), "powers("));
  const std::string text = closed.rows.measurement(closed.given.ladder.point);
  BOOST_TEST(has(text, "static double row[" +
                           std::to_string(2 + closed.observed.quantities.size() + 1) + "];"));
  BOOST_TEST(!has(text, "balance"));
  BOOST_TEST(!has(text, "stage"));
}

// A driven and damped oscillator. Each part of a step adds h times the powers at its stage, that of the midpoint rule.
BOOST_AUTO_TEST_CASE(energies_through_ports_are_added_up) {
  const Rows open(experiment_file("port_hamiltonian_open"));
  BOOST_TEST(open.rows.measures_steps());
  BOOST_TEST(has(open.functions.source(), "powers("));
  const std::string parts = open.rows.parts();
  BOOST_TEST(has(parts, "#define SUPPLIERS 1\n"));
  BOOST_TEST(has(parts, "#define DISSIPATORS 1\n"));
  BOOST_TEST(has(parts, "stage.t = before->t + 0.5 * h;"));
  BOOST_TEST(has(parts, "step_supplied[i] += h * power[i];"));
  BOOST_TEST(has(parts, "step_dissipated[i] += h * power[ports + i];"));
  const std::string text = open.rows.measurement(open.given.ladder.point);
  BOOST_TEST_REQUIRE(open.observed.H.has_value());
  BOOST_TEST(has(text, "balance = row[" + std::to_string(*open.observed.H) + "] - last_energy"));
  BOOST_TEST(open.observed.balance.has_value() == has(text, "] = balance;"));
}

// Formulas at the stage are written where Observer has them, and measured at the first state as well.
BOOST_AUTO_TEST_CASE(observables_at_the_stage_have_their_places) {
  const Rows open(experiment_file("port_hamiltonian_open"));
  BOOST_TEST_REQUIRE(open.observed.stage_places.size() == 3u);  // u, y, power_29
  BOOST_TEST(has(open.functions.source(), "observe_stage("));
  const std::string text = open.rows.measurement(open.given.ladder.point);
  for (std::size_t i = 0; i < 3; ++i)
    BOOST_TEST(has(text, "row[" + std::to_string(open.observed.stage_places[i]) + "] = at_stage[" +
                             std::to_string(i) + "];"));
  BOOST_TEST(has(text, "stage = *state;\n  measure_stage(0);"));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::test
