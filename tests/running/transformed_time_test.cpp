// Runs with steps of one size in a time τ, dt/dτ = g.
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <sstream>

#include "courant/running/c_program.hpp"
#include "courant/running/check.hpp"
#include "courant/running/run_files.hpp"
#include "courant/running/study.hpp"
#include "courant/tests/core/says.hpp"
#include "courant/tests/integrators/kepler.hpp"
#include "problems.hpp"
#include "resumed_run.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * energies through ports are those of a step of h in t (integrators/step/step_energies.cpp)
//  * a rate that is not positive at the start is taken (reading/transformed_time.cpp)
//  * the plain transformation stands for the symplectic one (reading/transformed_time.cpp)
//  * a discrete gradient corrects along time (reading/transformed_time.cpp)
//  * the last step goes beyond the end (running/run_clock.cpp)
//  * round-off of time is a step of its own (running/run_clock.cpp)
//  * the last tau is that of a whole step (running/run_clock.cpp)
//  * the momentum of time is not kept in a checkpoint (running/checkpoint.cpp)
//  * rows at times have the tau of the step (running/trajectory_rows.cpp)
//  * a complete run in transformed time is not known for one (running/unfinished_run.cpp)
BOOST_AUTO_TEST_SUITE(transformed_time)

namespace {

const examples::Kepler solution{.eccentricity = 0.9};

const Json kepler = Json::parse(R"json({
  "system": {
    "type": "hamiltonian", "parameters": { "ecc": 0.9 }, "coordinates": ["x", "y"],
    "definitions": { "r": "sqrt(x^2 + y^2)" }, "hamiltonian": "(p_x^2 + p_y^2)/2 - 1/r"
  },
  "initial": { "x": "1 - ecc", "y": 0, "p_x": 0, "p_y": "sqrt((1 + ecc)/(1 - ecc))" },
  "method": { "type": "discretize-first", "order": 4 },
  "time": { "step": 0.05, "end": 20, "transformation": "r" }
})json");

Json with(Json experiment, const std::string& pointer, const Json& value) {
  experiment[Json::json_pointer(pointer)] = value;
  return experiment;
}

struct Rows {
  std::string heading;
  std::vector<std::vector<double>> rows;
};
Rows rows_of(const TemporaryFolder& folder) {
  std::istringstream text(read_text(folder / "run/trajectory.csv"));
  Rows found;
  std::getline(text, found.heading);
  for (std::string line; std::getline(text, line);) {
    std::istringstream cells(line);
    found.rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');)
      found.rows.back().push_back(std::stod(cell));
  }
  return found;
}
// Of a row t, tau, x, y, p_x, p_y, …
double error(const std::vector<double>& row) {
  return (Eigen::Map<const Eigen::Vector4d>(row.data() + 2) - solution.at(row[0])).norm();
}

}  // namespace

// The run ends at the time that it is asked for, and every row is where Kepler's equation says at its t.
BOOST_AUTO_TEST_CASE(a_run_until_a_time) {
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, kepler);
  BOOST_TEST(outcome.message == "");
  const Rows rows = rows_of(folder);
  BOOST_TEST(rows.heading == "t,tau,x,y,p_x,p_y,H");
  BOOST_TEST(static_cast<long>(rows.rows.size()) == outcome.summary.steps + 1);
  BOOST_TEST(rows.rows.back()[0] == 20.0);
  BOOST_TEST(outcome.summary.time->end == 20.0);
  BOOST_TEST(outcome.summary.time->step == 0.05);
  for (std::size_t k = 0; k + 1 < rows.rows.size(); ++k) {
    BOOST_TEST(rows.rows[k][1] == 0.05 * static_cast<double>(k));
    BOOST_TEST(rows.rows[k + 1][0] > rows.rows[k][0]);
  }
  // τ along the ellipse is the eccentric anomaly: t = τ - e sin τ.
  const double tau = rows.rows.back()[1];
  BOOST_TEST(std::abs(tau - 0.9 * std::sin(tau) - 20.0) < 1e-4);
  for (const auto& row : rows.rows) BOOST_TEST(error(row) < 2e-3);
  BOOST_TEST(says(outcome.summary.method, "dt/dtau = r"));
}

// Steps of the same number, in t, are of no use where the planet is near the sun.
BOOST_AUTO_TEST_CASE(steps_that_follow_the_motion) {
  const TemporaryFolder folder, other;
  const RunOutcome varying = run_in(folder, kepler);
  Json constant = kepler;
  constant["time"] = {{"step", 20.0 / static_cast<double>(varying.summary.steps)}, {"end", 20}};
  const RunOutcome equal = run_in(other, constant);
  const VectorXd exact = solution.at(20.0);
  BOOST_TEST(std::abs(final_value(varying, "x") - exact[0]) < 1e-3);
  BOOST_TEST(
      (equal.status != RunStatus::completed || std::abs(final_value(equal, "x") - exact[0]) > 0.1));
}

BOOST_AUTO_TEST_CASE(rows_and_expectations_at_times) {
  Json experiment = with(kepler, "/output", {{"at", {0.5, "2*pi", 12.5, 20}}});
  const VectorXd at = solution.at(7.25);
  experiment["expect"] = {
      {{"at", 7.25}, {"state", {{"x", at[0]}, {"y", at[1]}}}, {"tolerance", 1e-3}},
      {{"at", 20}, {"state", {{"x", solution.at(20.0)[0]}}}, {"tolerance", 1e-3}},
      {{"at", 0}, {"state", {{"x", 0.1}}}, {"tolerance", 1e-12}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, experiment);
  BOOST_TEST(outcome.as_expected());
  const Rows rows = rows_of(folder);
  const std::vector<double> times = {0.0, 0.5, 2.0 * M_PI, 12.5, 20.0};
  BOOST_REQUIRE(rows.rows.size() == times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    BOOST_TEST(rows.rows[i][0] == times[i]);
    BOOST_TEST(error(rows.rows[i]) < 2e-3);
    const double tau = rows.rows[i][1];
    BOOST_TEST(std::abs(tau - 0.9 * std::sin(tau) - times[i]) < 1e-4);
  }
  // A wrong value is found wrong.
  experiment["expect"][0]["state"]["x"] = at[0] + 0.01;
  const TemporaryFolder other;
  BOOST_TEST(!run_in(other, experiment).as_expected());
  BOOST_TEST(
      says(problem_of_run(with(experiment, "/expect/0/at", 21)), "expected a time from 0 to 20"));
}

// The perihelion is passed at multiples of 2π, at times between those of steps.
BOOST_AUTO_TEST_CASE(events_in_physical_time) {
  Json experiment = kepler;
  experiment["events"] = {{"perihelion", {{"zero", "x*p_x + y*p_y"}, {"direction", "rising"}}}};
  experiment["expect"] = {{{"event", "perihelion"}, {"count", 3}},
                          {{"event", "perihelion"},
                           {"number", 3},
                           {"time", "6*pi"},
                           {"state", {{"x", 0.1}}},
                           {"tolerance", 1e-4}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, experiment);
  for (const ExpectationResult& result : outcome.expectations)
    BOOST_TEST(result.passed, result.description << ' ' << result.finding);
}

BOOST_AUTO_TEST_CASE(runs_that_were_stopped) {
  Json experiment = with(kepler, "/output", {{"epoch", 60}, {"at", {3, 9, 18}}});
  experiment["events"] = {{"perihelion", "x*p_x + y*p_y"}};
  experiment["expect"] = {{{"at", 17}, {"state", {{"x", -1}}}, {"tolerance", 3}}};
  const TemporaryFolder folder;
  Killer killer(folder / "run", folder / "killed", 170);
  RunOptions options;
  options.watchers = {&killer};
  options.checkpoint_interval = std::chrono::milliseconds(0);
  const RunOutcome whole = run_in(folder, experiment, options);
  BOOST_TEST(whole.summary.steps > 300);
  const RunOutcome resumed = resume_in(folder / "killed", experiment);
  BOOST_TEST(resumed.message == "");
  check_same_files(folder / "run", folder / "killed", "killed");
  // A run that is complete goes on to a later end, as if it had never ended.
  BOOST_CHECK_THROW(resume_in(folder / "killed", experiment), UnusableFolder);
  const Json longer = with(experiment, "/time/end", 26);
  resume_in(folder / "killed", longer);
  const TemporaryFolder other;
  run_in(other, longer);
  BOOST_TEST(read_text(folder / "killed/trajectory.csv") ==
             read_text(other / "run/trajectory.csv"));
}

BOOST_AUTO_TEST_CASE(a_rate_of_one) {
  for (const char* method : {"discretize-first", "constrain-first", "rk4", "discrete-gradient"}) {
    Json own = with(kepler, "/method", method);
    own["system"]["parameters"]["ecc"] = 0.3;
    own["time"] = {{"step", 0.1}, {"end", 3}};
    const Json other = with(own, "/time/transformation", 1);
    const TemporaryFolder one, two;
    const RunOutcome expected = run_in(one, own), found = run_in(two, other);
    BOOST_TEST(found.summary.steps == 30, method);
    for (const char* name : {"x", "y", "p_x", "p_y"})
      BOOST_TEST(std::abs(final_value(found, name) - final_value(expected, name)) < 1e-12,
                 method << ": " << name);
  }
}

BOOST_AUTO_TEST_CASE(what_is_said_of_wrong_rates) {
  BOOST_TEST(says(problem_of_run(with(kepler, "/time/transformation", "rr")),
                  "/time/transformation: column 1: unknown name \"rr\""));
  BOOST_TEST(
      says(problem_of_run(with(kepler, "/time/transformation", "x'")), "/time/transformation"));
  BOOST_TEST(problem_of_run(with(kepler, "/time/transformation", "y")) ==
             "/time/transformation: is 0 at the initial point; expected a positive number");
  BOOST_TEST(
      says(problem_of_run(with(kepler, "/time/transformation", "-r")), "is -0.1 at the initial"));
  BOOST_TEST(says(problem_of_run(with(kepler, "/time/end", -1)), "/time/end"));
  Json start = with(kepler, "/method", {{"type", "discretize-first"}, {"start", "rk2"}});
  BOOST_TEST(says(problem_of_run(start), "expected \"on-manifold\" with a transformation of time"));
  try {
    c_program(read_experiment(kepler.dump()));
    BOOST_TEST(false);
  } catch (const ExperimentError& problem) {
    BOOST_TEST(says(problem.what(), "/time/transformation: is not written in C"));
  }
  // It vanishes on the way, where x = -0.5.
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, with(kepler, "/time/transformation", "x + 0.5"));
  BOOST_TEST((outcome.status == RunStatus::failed));
}

BOOST_AUTO_TEST_CASE(laws_in_the_extended_phase_space) {
  // Where differences near the sun are no measure.
  Json farther = with(kepler, "/system/parameters/ecc", 0.3);
  farther["method"]["order"] = 2;
  const Json report = check_experiment(read_experiment(farther.dump()));
  for (const Json& law : report["checks"]) BOOST_TEST(law["passed"].get<bool>(), law.dump());
  BOOST_TEST(report["method"]["symplectic"] == true);
  BOOST_TEST(report["method"]["symplecticity_defect"].get<double>() < 1e-8);
  const Json explicit_report =
      check_experiment(read_experiment(with(farther, "/method", "rk4").dump()));
  BOOST_TEST(explicit_report["passed"] == true);
  BOOST_TEST(explicit_report["method"]["symplectic"] != true);
}

// Errors at the end, in t.
BOOST_AUTO_TEST_CASE(studies) {
  for (const int order : {2, 4}) {
    Json experiment = with(kepler, "/method/order", order);
    experiment["time"] = {{"step", order == 2 ? 0.02 : 0.1}, {"end", 5}, {"transformation", "r"}};
    const StudySubject subject{"kepler", read_experiment(experiment.dump())};
    const Json result =
        to_json(study(std::span(&subject, 1), {.steps = 4, .backend = Backend::interpreter}));
    const Json& method = result["methods"][0];
    BOOST_TEST(std::abs(method["order"].get<double>() - order) < 0.15, method["order"].dump());
    const long steps = method["rows"][0]["steps"].get<long>();
    const long more = method["rows"][1]["steps"].get<long>();
    BOOST_TEST(std::abs(more - 2 * steps) <= 4 + steps / 20, more << " and " << steps);
  }
}

// A pendulum on a rod, and one that rolls: constraints of every level at every node.
BOOST_AUTO_TEST_CASE(constraints_with_varying_steps) {
  const std::map<std::string, const char*> rates = {
      {"pendulum_holonomic", "0.5 + x^2"},
      {"nonholonomic_particle", "1/(1 + x^2 + p_x^2)"},
      {"chaplygin_sleigh", "1.5 + sin(t)"}};
  const Json pulled = Json::parse(R"json({
    "system": { "type": "mechanical", "coordinates": ["x", "y"], "potential": "9.81*y",
                "holonomic": "(x^2 + y^2 - (1 + 0.2*sin(t))^2)/2" },
    "initial": { "x": 0.6, "y": -0.8, "x'": 0.3 },
    "method": "constrain-first",
    "time": { "step": 0.02, "end": 3, "transformation": "1/(1 + p_x^2 + p_y^2)" }
  })json");
  const TemporaryFolder rope;
  const RunOutcome pulling = run_in(rope, pulled);
  BOOST_TEST(pulling.message == "");
  BOOST_TEST(pulling.summary.max_violation.value_or(1.0) < 1e-12);
  for (const auto& [name, rate] : rates) {
    Json experiment = test::experiment_file(name);
    experiment.erase("expect");
    experiment["method"] = "constrain-first";
    experiment["time"] = {{"step", 0.05}, {"end", 5}, {"transformation", rate}};
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, experiment);
    BOOST_TEST(outcome.message == "", name);
    BOOST_TEST(outcome.summary.max_violation.value_or(1.0) < 1e-12, name);
  }
}

// The balance of energy is that of steps in t.
BOOST_AUTO_TEST_CASE(energies_with_varying_steps) {
  Json experiment = test::experiment_file("port_hamiltonian_open");
  experiment["time"] = {{"step", 0.01}, {"end", 5}, {"transformation", "0.3 + q^2 + p^2"}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, experiment);
  for (const ExpectationResult& result : outcome.expectations)
    BOOST_TEST(result.passed, result.description << ' ' << result.finding);
  BOOST_TEST(outcome.summary.power_balance->max_imbalance < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
