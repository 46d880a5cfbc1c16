#include "courant/running/chosen_step.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "courant/running/run_files.hpp"
#include "run_in.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(chosen_step_test)

namespace {

const Json oscillator = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2" },
  "initial": { "q": 1, "p_q": 0 },
  "method": "discretize-first",
  "time": { "tolerance": 1e-6, "end": 20 },
  "output": { "interval": 2 }
})json");

}  // namespace

// The midpoint rule turns by 2 atan(h/2) in a step: after t it is late by t h²/12, of which the half has a quarter. So
// half of 3/4 t h²/12, of a way of 2.
BOOST_AUTO_TEST_CASE(the_difference_to_the_half_is_below_the_tolerance) {
  for (const double tolerance : {1e-3, 1e-6}) {
    Json document = oscillator;
    document["time"]["tolerance"] = tolerance;
    const ChosenStep chosen = chosen_step(read_experiment_document(document));
    BOOST_TEST(chosen.estimate <= tolerance);
    BOOST_TEST(chosen.estimate >= tolerance / 30.0);
    const double late = 0.75 * 20.0 * chosen.step * chosen.step / 12.0;
    BOOST_TEST(chosen.estimate <= 0.5 * late * 1.001);
    BOOST_TEST(chosen.estimate >= 0.5 * late / 3.0);
    BOOST_TEST(std::abs(std::log2(2.0 / chosen.step) - std::round(std::log2(2.0 / chosen.step))) <
               1e-9);
  }
}

BOOST_AUTO_TEST_CASE(a_run_keeps_the_step_and_writes_at_the_interval) {
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, oscillator);
  BOOST_TEST((outcome.status == RunStatus::completed), outcome.message);
  BOOST_TEST_REQUIRE(outcome.summary.time.has_value());
  BOOST_TEST(outcome.summary.time->step < 0.01);
  BOOST_TEST(std::abs(final_value(outcome, "q") - std::cos(20.0)) < 1e-5);
  const Json written = read_json(folder / "run/experiment.json");
  BOOST_TEST(written["time"]["step"] == outcome.summary.time->step);
  BOOST_TEST(read_run(folder / "run").trajectory.rows() == 11u);
  // The file is an experiment again, with the step.
  BOOST_TEST(read_experiment_document(written).time->is_chosen);
}

// The states of a trial of so many rows would take more memory than there is.
BOOST_AUTO_TEST_CASE(a_run_of_very_many_rows_has_the_step_of_its_rows) {
  Json document = oscillator;
  document["output"]["interval"] = 2e-12;
  const std::shared_ptr<const Experiment> experiment =
      std::make_shared<Experiment>(read_experiment_document(document));
  const ChosenStep chosen = chosen_step(*experiment);
  BOOST_TEST(chosen.step == 2e-12);
  const auto made = with_chosen_step(*experiment, chosen);
  BOOST_TEST_REQUIRE(!made->remarks.empty());
  BOOST_TEST(made->remarks.back().what.find("more than a million rows") != std::string::npos);
}

// u goes to 10 until it is 7, and to 0 until it is 3, with the time 0.01: it is switched at 0.01 ln(10/3), and then every
// 0.01 ln(7/3). Runs without the switch would be ten times as exact.
BOOST_AUTO_TEST_CASE(what_events_set_is_in_the_trials) {
  const Json relaxation = Json::parse(R"json({
    "system": { "type": "implicit", "coordinates": ["u", "s"],
                "equations": ["u' - if(s > 0.5, -u, 10 - u)/0.01", "s'"] },
    "initial": { "u": 0, "s": 0 },
    "method": "discretize-first",
    "time": { "tolerance": 1e-3, "end": 0.1 },
    "output": { "interval": 0.002 },
    "events": { "up": { "zero": "u-7", "direction": "rising", "set": { "s": 1 } },
                "down": { "zero": "u-3", "direction": "falling", "set": { "s": 0 } } }
  })json");
  const ChosenStep chosen = chosen_step(read_experiment_document(relaxation));
  const TemporaryFolder folder;
  BOOST_TEST((run_in(folder, relaxation).status == RunStatus::completed));
  const Run run = read_run(folder / "run");
  const auto t = run.trajectory.column("t"), u = run.trajectory.column("u");
  const double first = 0.01 * std::log(10.0 / 3.0), period = 0.01 * std::log(7.0 / 3.0);
  double error = 0.0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    const double switched = std::floor((t[k] - first) / period);
    const double since = (t[k] - first - switched * period) / 0.01;
    const double exact = t[k] < first                      ? 10.0 - 10.0 * std::exp(-t[k] / 0.01)
                         : std::fmod(switched, 2.0) == 0.0 ? 7.0 * std::exp(-since)
                                                           : 10.0 - 7.0 * std::exp(-since);
    error = std::max(error, std::abs(u[k] - exact) / 7.0);
  }
  // The difference to the half is three quarters of an error of order 2.
  BOOST_TEST(chosen.estimate <= 1e-3);
  BOOST_TEST(error <= 1.5 * chosen.estimate);
  BOOST_TEST(error >= chosen.estimate);
}

// A spring that is let go stops at q = 0, at t = π/2: what it would do behind that is not asked.
BOOST_AUTO_TEST_CASE(trials_end_where_an_event_stops_them) {
  Json document = oscillator;
  document["time"]["tolerance"] = 1e-4;
  document["events"] = {{"there", {{"zero", "q"}, {"direction", "falling"}, {"stop", true}}}};
  const ChosenStep chosen = chosen_step(read_experiment_document(document));
  // Late by t h²/12, in p where it stops by nothing.
  const double late = std::acos(-1.0) / 2.0 * chosen.step * chosen.step / 12.0;
  BOOST_TEST(chosen.estimate <= 1e-4);
  BOOST_TEST(chosen.estimate >= 0.5 * late / 20.0);
  Json whole = oscillator;
  whole["time"]["tolerance"] = 1e-4;
  BOOST_TEST(chosen.step > chosen_step(read_experiment_document(whole)).step);
}

// x x' = -1/2 has an impasse at t = 1, where x = √(1 - t) is 0: no step leads beyond it, with an event or without.
BOOST_AUTO_TEST_CASE(runs_that_all_end_at_an_impasse_are_compared_up_to_there) {
  Json impasse = Json::parse(R"json({
    "system": { "type": "implicit", "coordinates": ["x", "s"], "equations": ["x*x' + 1/2", "s'"] },
    "initial": { "x": 1, "s": 0 },
    "method": "discretize-first",
    "time": { "tolerance": 0.05, "end": 2 },
    "output": { "interval": 0.04 }
  })json");
  for (const bool has_event : {false, true}) {
    if (has_event)
      impasse["events"] = {
          {"half", {{"zero", "x-1/2"}, {"direction", "falling"}, {"set", {{"s", 1}}}}}};
    const Experiment experiment = read_experiment_document(impasse);
    const ChosenStep chosen = chosen_step(experiment);
    BOOST_TEST(chosen.estimate <= 0.05);
    BOOST_TEST_REQUIRE(chosen.ended_at.has_value());
    BOOST_TEST(std::abs(*chosen.ended_at - 1.0) <= 1.5 * chosen.step);
    const auto whole = with_chosen_step(experiment, chosen);
    BOOST_TEST_REQUIRE(whole->remarks.size() == 1u);
    BOOST_TEST(whole->remarks[0].what.find("leads to the end of the run") != std::string::npos,
               whole->remarks[0].what);
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, impasse);
    BOOST_TEST((outcome.status == RunStatus::failed));
    BOOST_TEST(read_run(folder / "run").trajectory.rows() >= 24u);
  }
}

// √(-x) is no number: not even one step can be made, and the run says so, not the choice of its step.
BOOST_AUTO_TEST_CASE(what_ends_the_first_step_the_run_says) {
  const Json document = Json::parse(R"json({
    "system": { "type": "implicit", "coordinates": ["x"], "equations": ["x' - if(t > 0, sqrt(-x), 0)"] },
    "initial": { "x": 1 },
    "method": "discretize-first",
    "time": { "tolerance": 1e-3, "end": 1 }
  })json");
  const Experiment experiment = read_experiment_document(document);
  const ChosenStep chosen = chosen_step(experiment);
  BOOST_TEST(!std::isfinite(chosen.estimate));
  BOOST_TEST(chosen.step > 0.0);
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, document);
  BOOST_TEST((outcome.status == RunStatus::failed));
  BOOST_TEST(outcome.message.find("/time/tolerance") == std::string::npos, outcome.message);
}

// x' is 0 up to t = 0.02, and rises behind it. The steps of 0.1 and of 0.05 have the same piece up to the corner, and the
// same error of 0.01.
BOOST_AUTO_TEST_CASE(pieces_between_corners_have_halves_too) {
  const Json document = Json::parse(R"json({
    "system": { "type": "implicit", "coordinates": ["x"], "equations": ["x' - max(0, 50*(t - 0.02))"] },
    "initial": { "x": 0 },
    "method": "discretize-first",
    "time": { "tolerance": 1e-4, "end": 1, "corners": [0.05] },
    "output": { "interval": 0.1 }
  })json");
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, document);
  BOOST_TEST(std::abs(final_value(outcome, "x") - 25.0 * 0.98 * 0.98) < 5e-3);
}

// So little comes to the far end of a ladder of RC cells that its charges there are round-off next to that of the first.
BOOST_AUTO_TEST_CASE(charges_are_compared_in_volts) {
  const auto ladder = [](int cells) {
    Json document = Json::parse(R"json({
      "system": { "type": "network", "nodes": ["0", {"repeat": {"i": [0, "n"]}, "name": "n{i}"}],
                  "parameters": { "n": 1 },
                  "elements": [
        { "type": "voltage-source", "name": "V", "from": "n0", "to": "0", "value": 1 },
        { "type": "resistor", "repeat": {"i": [1, "n"]}, "name": "R{i}", "from": "n{i-1}", "to": "n{i}", "value": 1 },
        { "type": "capacitor", "repeat": {"i": [1, "n"]}, "name": "C{i}", "from": "n{i}", "to": "0", "value": 1 } ] },
      "initial": {},
      "method": "discretize-first",
      "time": { "tolerance": 1e-4, "end": 2 },
      "output": { "interval": 0.1 }
    })json");
    document["system"]["parameters"]["n"] = cells;
    return chosen_step(read_experiment_document(document));
  };
  const ChosenStep of_three = ladder(3), of_thirty = ladder(30);
  BOOST_TEST(of_three.estimate <= 1e-4);
  BOOST_TEST(of_thirty.step == of_three.step);
}

// The coil of a boost converter runs empty in each period: the node between the switch and the diode is held by neither
// then, and the step in which the diode blocks leaves a potential there that is volts away.
BOOST_AUTO_TEST_CASE(potentials_that_are_observed_are_compared) {
  Json document = Json::parse(R"json({
    "system": { "type": "network", "nodes": ["0", "in", "sw", "out"], "elements": [
      { "type": "voltage-source", "name": "V1", "from": "in", "to": "0", "value": 12 },
      { "type": "inductor", "name": "L1", "from": "in", "to": "sw", "value": 1e-4 },
      { "type": "resistor", "name": "S1", "from": "sw", "to": "0",
        "current": "v_S1*if(sin(2*pi*(t/1e-5 - 0.0033)) > 0, 20, 1e-7)" },
      { "type": "diode", "name": "D1", "from": "sw", "to": "out", "saturation": 1e-12,
        "emission": 1.2, "leak": 1e-12 },
      { "type": "capacitor", "name": "C1", "from": "out", "to": "0", "value": 1e-5 },
      { "type": "resistor", "name": "R1", "from": "out", "to": "0", "value": 2000 } ] },
    "initial": { "phi_L1": 0, "q_C1": 4e-4 },
    "method": { "type": "discretize-first", "damping": "l-stable" },
    "time": { "tolerance": 1e-3, "end": 1e-4, "halvings": 10,
              "corners": [ { "first": 3.3e-8, "period": 1e-5 }, { "first": 503.3e-8, "period": 1e-5 } ] },
    "output": { "interval": 1e-7 },
    "observe": { "at_switch": "potential_sw" }
  })json");
  const auto at_switch = [&](const Json& experiment) {
    const TemporaryFolder folder;
    BOOST_TEST((run_in(folder, experiment).status == RunStatus::completed));
    const Run run = read_run(folder / "run");
    const auto column = run.trajectory.column("at_switch");
    return std::vector<double>(column.begin(), column.end());
  };
  const ChosenStep chosen = chosen_step(read_experiment_document(document));
  BOOST_TEST(chosen.estimate <= 1e-3);
  const auto found = at_switch(document);
  document["time"].erase("tolerance");
  document["time"]["step"] = chosen.step / 8;
  const auto finer = at_switch(document);
  long far = 0;
  for (std::size_t k = 0; k < found.size(); ++k) far += std::abs(found[k] - finer[k]) > 1.0;
  BOOST_TEST(found.size() == 1001u);
  BOOST_TEST(far <= 6);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_chosen_is_told) {
  Json document = oscillator;
  // Where the best of the steps that were tried is not good enough, that is said.
  const Experiment experiment = read_experiment_document(document);
  BOOST_TEST(with_chosen_step(experiment, {0.5, 1e-5})->remarks.size() == 1u);
  BOOST_TEST(with_chosen_step(experiment, {0.5, 1e-7})->remarks.empty());
  document["time"]["tolerance"] = -1;
  BOOST_CHECK_THROW(read_experiment_document(document), ExperimentError);
  document = oscillator;
  document["time"] = {{"step", 0.3}, {"end", 6}};
  BOOST_CHECK_THROW(read_experiment_document(document), ExperimentError);  // 2 is no multiple of it
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
