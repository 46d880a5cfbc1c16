#include "courant/running/runner.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/running/run_files.hpp"
#include "courant/running/run_folder.hpp"
#include "run_in.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * bounds along a run are met by runs that failed (reading/expectation.cpp)
//  * a value that is not a number meets its bound (reading/expectation.cpp)
//  * every verdict is the one expected (reading/expectation.cpp)
//  * observables see velocities of the stage (running/observed_quantities.cpp)
//  * the last step of a run is not written (reading/output.cpp)
//  * a failed solve is a completed run
//  * inconsistent systems are run
//  * a watcher of one's own is told of the stage of another step
//  * all coordinates have columns whatever is asked for (running/trajectory_rows.cpp)
//  * what shorter steps from the start do not explain either is explained
//    (running/energy_watch.cpp)
BOOST_AUTO_TEST_SUITE(runner)

namespace {

const Json oscillator = Json::parse(R"json({
  "title": "Oscillator",
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2" },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.1, "end": 10 },
  "observe": { "angle": "atan2(-p_q, q)", "speed": "q'" }
})json");

// Falls onto q = 0, where the formula for the energy ends: it gets there at t = 4√2/3 = 1.886.
const Json collision = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "p_q^2/2 + sqrt(q)" },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.01, "end": 10 }
})json");

}  // namespace

BOOST_AUTO_TEST_CASE(writes_what_it_computes) {
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, oscillator);
  BOOST_TEST((outcome.status == RunStatus::completed));
  const Run run = read_run(folder / "run");
  BOOST_TEST(run.trajectory.names() ==
             (std::vector<std::string>{"t", "q", "p_q", "H", "angle", "speed"}));
  BOOST_REQUIRE(run.trajectory.rows() == 101u);
  // The midpoint rule turns by 2 atan(h/2) a step; velocities are those at the point, not between
  // two.
  const auto q = run.trajectory.column("q"), p = run.trajectory.column("p_q"),
             speed = run.trajectory.column("speed");
  for (std::size_t k = 0; k <= 100; ++k) {
    const double angle = static_cast<double>(k) * 2.0 * std::atan(0.05);
    BOOST_TEST(std::abs(q[k] - std::cos(angle)) < 1e-13);
    BOOST_TEST(std::abs(p[k] + std::sin(angle)) < 1e-13);
    BOOST_TEST(std::abs(speed[k] - p[k]) < 1e-12);
  }
  BOOST_TEST(run.trajectory.column("t")[100] == 10.0);
  BOOST_TEST(final_value(outcome, "q") == q[100]);
  BOOST_TEST(outcome.summary.observable("H")->max_drift < 1e-14);
  BOOST_TEST(outcome.summary.steps == 100);
  BOOST_TEST(to_json(run.summary).dump() == to_json(outcome.summary).dump());
  BOOST_TEST(run.experiment["output"]["every"] == 1);
}

// Between steps the values are those of the method's own curve, to its order; the steps do not change.
BOOST_AUTO_TEST_CASE(rows_are_written_at_given_times) {
  Json timed = oscillator;
  timed["method"] = "rk4";
  timed["output"] = {{"at", {0.25, 1, "pi", 7.0}}, {"units", {{"t", "s"}, {"q", "m"}}}};
  const TemporaryFolder folder, every;
  run_in(folder, timed);
  const Run run = read_run(folder / "run");
  const auto t = run.trajectory.column("t"), q = run.trajectory.column("q");
  BOOST_REQUIRE(t.size() == 6u);
  const double expected[] = {0.0, 0.25, 1.0, std::acos(-1.0), 7.0, 10.0};
  for (std::size_t i = 0; i < 6; ++i) {
    BOOST_TEST(std::abs(t[i] - expected[i]) < 1e-12);
    BOOST_TEST(std::abs(q[i] - std::cos(expected[i])) < 1e-5);
  }
  BOOST_TEST(read_text(folder / "run" / "trajectory.csv").find("t [s],q [m],p_q,H,") == 0u);
  // The experiment of the run can be run again.
  BOOST_CHECK_NO_THROW(read_experiment_document(run.experiment));
  timed.erase("output");
  run_in(every, timed);
  const Run whole = read_run(every / "run");
  BOOST_TEST(whole.trajectory.column("q")[10] == q[2]);
  BOOST_TEST(whole.trajectory.column("q")[100] == q[5]);
}

BOOST_AUTO_TEST_CASE(coordinates_without_a_column_are_left_out_of_the_trajectory_alone) {
  const TemporaryFolder folder;
  Json experiment = oscillator;
  run_in(folder, experiment);
  const TrajectoryTable all = read_trajectory_csv(folder / "run/trajectory.csv");
  RunOptions again;
  again.existing = ExistingRun::replace;
  experiment["output"]["coordinates"] = {"p_q"};
  const RunOutcome outcome = run_in(folder, experiment, again);
  const TrajectoryTable some = read_trajectory_csv(folder / "run/trajectory.csv");
  BOOST_TEST(all.contains("q"));
  BOOST_TEST(!some.contains("q"));
  BOOST_TEST(std::ranges::equal(some.column("p_q"), all.column("p_q")));
  BOOST_TEST(std::ranges::equal(some.column("H"), all.column("H")));
  BOOST_TEST(final_value(outcome, "q") == all.column("q").back());
}

BOOST_AUTO_TEST_CASE(rows_are_written_every_so_many_steps_and_at_the_end) {
  const TemporaryFolder folder;
  Json experiment = oscillator;
  experiment["output"] = {{"every", 30}, {"format", "npy"}};
  experiment["expect"] = {{{"observable", "q"}, {"min", -0.999}}};
  const RunOutcome outcome = run_in(folder, experiment);
  const Run run = read_run(folder / "run");
  const auto t = run.trajectory.column("t");
  BOOST_TEST(std::vector<double>(t.begin(), t.end()) == (std::vector<double>{0, 3, 6, 9, 10}));
  // Statistics are over all steps: q falls to -0.9999 between two rows.
  BOOST_TEST(!outcome.as_expected());
  BOOST_TEST(outcome.summary.expectations[0].value.get<double>() < -0.999);
}

BOOST_AUTO_TEST_CASE(expectations_pass_and_fail) {
  const auto passes = [](const Json& expectation, const Json& experiment = oscillator) {
    const TemporaryFolder folder;
    Json expecting = experiment;
    expecting["expect"] = {expectation};
    return run_in(folder, expecting).as_expected();
  };
  BOOST_TEST(passes({{"observable", "H"}, {"max_drift", 1e-13}, {"max_slope", 1e-14}}));
  BOOST_TEST(!passes({{"observable", "q"}, {"max_drift", 1.9}}));
  BOOST_TEST(passes({{"observable", "q"}, {"min_drift", 1.9}}));
  BOOST_TEST(!passes({{"observable", "H"}, {"min_drift", 1e-3}}));
  BOOST_TEST(passes({{"observable", "q"}, {"max", 1.0}, {"min", -1.0}}));
  BOOST_TEST(!passes({{"observable", "q"}, {"max", 0.9}}));
  BOOST_TEST(passes({{"at", 10}, {"state", {{"q", "cos(200*atan(0.05))"}}}, {"tolerance", 1e-12}}));
  BOOST_TEST(!passes(
      {{"at", 10}, {"state", {{"q", "cos(200*atan(0.05)) + 1e-9"}}}, {"tolerance", 1e-12}}));
  BOOST_TEST(
      passes({{"state", {{"q", "cos(20*atan(0.05)*t)"}, {"H", 0.5}}}, {"tolerance", 1e-12}}));
  BOOST_TEST(!passes({{"state", {{"q", "cos(t)"}}}, {"tolerance", 1e-4}}));
  BOOST_TEST(passes(
      {{"verdict", "regular"}, {"ladder", {{2, 2}}}, {"index", 0}, {"degrees_of_freedom", 2}}));
  BOOST_TEST(!passes({{"verdict", "gauge"}}));
  BOOST_TEST(!passes({{"ladder", {{2, 2}, {1, 1}}}}));
  BOOST_TEST(!passes({{"verdict", "inconsistent"}}));
}

// What an expectation would say whatever the run does is not an expectation.
BOOST_AUTO_TEST_CASE(expectations_that_test_nothing_are_refused_at_the_start) {
  const auto refused = [](const Json& expectation, const Json& experiment) -> std::string {
    const TemporaryFolder folder;
    Json expecting = experiment;
    expecting["expect"] = {expectation};
    try {
      run_in(folder, expecting);
    } catch (const ExperimentError& error) {
      BOOST_TEST(!std::filesystem::exists(folder / "run"));
      return error.what();
    }
    return "";
  };
  Json at_a_point = oscillator;
  at_a_point.erase("method");
  at_a_point.erase("time");
  for (const auto& [experiment, expectation, message] :
       std::vector<std::tuple<Json, Json, const char*>>{
           {at_a_point,
            {{"observable", "H"}, {"max_drift", 1e-12}},
            "/expect/0/max_drift: tests nothing"},
           {at_a_point,
            {{"observable", "H"}, {"max_slope", 1e-12}},
            "/expect/0/max_slope: tests nothing"},
           {at_a_point,
            {{"state", {{"q", "cos(t)"}}}, {"tolerance", 1e-9}},
            "/expect/0/state/q: changes with t"},
           {at_a_point,
            {{"at", 0}, {"state", {{"q", 1}}}, {"tolerance", 1e-9}},
            "/expect/0/at: there is no trajectory"},
           {oscillator, {{"max_violation", 1.0}}, "/expect/0/max_violation: tests nothing"},
           {oscillator,
            {{"max_violation", -1.0}},
            "/expect/0/max_violation: is -1.0; expected a number that is at least 0"},
           {oscillator,
            {{"observable", "H"}, {"max_drift", -1e-9}},
            "/expect/0/max_drift: is -1e-09; expected"},
           {oscillator,
            {{"observable", "H"}, {"min_drift", 0}},
            "/expect/0/min_drift: is 0; expected a number greater than 0"},
           {oscillator,
            {{"at", 10}, {"state", {{"q", "0/0"}}}, {"tolerance", 1}},
            "/expect/0/state/q: is nan at t = 10"},
           {oscillator,
            {{"state", Json::object()}, {"tolerance", 1}},
            "/expect/0/state: is empty; expected values"},
       })
    BOOST_TEST(refused(expectation, experiment).starts_with(message),
               refused(expectation, experiment) << " for " << expectation);
  // At a point there are values and no drifts.
  BOOST_TEST(refused({{"observable", "H"}, {"max", 1}}, at_a_point) == "");
  BOOST_TEST(refused({{"state", {{"q", 1}}}, {"tolerance", 1e-9}}, at_a_point) == "");
}

BOOST_AUTO_TEST_CASE(an_expectation_that_fails_says_what_is_and_by_how_much) {
  const auto finding = [](const Json& expectation) {
    const TemporaryFolder folder;
    Json expecting = oscillator;
    expecting["expect"] = {expectation};
    return run_in(folder, expecting).expectations[0].finding;
  };
  BOOST_TEST(finding({{"at", 0}, {"state", {{"q", 1.25}}}, {"tolerance", 1e-7}}) ==
             "is 1, off by 0.25; allowed 1e-07");
  BOOST_TEST(finding({{"observable", "q"}, {"max", 0.5}}) == "is 1; allowed 0.5");
  BOOST_TEST(finding({{"observable", "q"}, {"min", 2}}).ends_with("; expected at least 2"));
  BOOST_TEST(finding({{"state", {{"H", "2.5"}}}, {"tolerance", 1e-7}}) ==
             "is off by 2; allowed 1e-07");
  BOOST_TEST(finding({{"verdict", "gauge"}}) == "is regular; expected gauge");
  BOOST_TEST(finding({{"ladder", {{3, 3}}}}) == "is [[2,2]]; expected [[3,3]]");
}

// The particle falls to where sqrt(x) ends.
BOOST_AUTO_TEST_CASE(a_step_out_of_a_domain_names_the_function_and_the_equation) {
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(
      folder,
      {{"system",
        {{"type", "lagrangian"}, {"coordinates", {"x"}}, {"lagrangian", "x'^2/2 - sqrt(x)"}}},
       {"initial", {{"x", 0.01}, {"x'", -1}}},
       {"method", "rk4"},
       {"time", {{"step", 0.1}, {"end", 10}}}});
  BOOST_TEST((outcome.status == RunStatus::failed));
  for (const char* part :
       {"sqrt(x) in the equation \"p_x' = dL/dx\" has no value ahead of the state: ",
        "the argument of sqrt is -"})
    BOOST_TEST(outcome.message.find(part) != std::string::npos, outcome.message);
  BOOST_TEST(outcome.message.find("singular") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_was_computed_before_a_failure_is_on_disk) {
  const TemporaryFolder folder;
  Json experiment = collision;
  experiment["expect"] = {{{"observable", "H"}, {"max_drift", 1e9}}};
  const RunOutcome outcome = run_in(folder, experiment);
  BOOST_TEST((outcome.status == RunStatus::failed));
  BOOST_TEST(outcome.message != "");
  BOOST_TEST(!outcome.as_expected());  // bounds along a run are for complete ones
  const Run run = read_run(folder / "run");
  BOOST_TEST((run.summary.status == RunStatus::failed));
  const auto steps = static_cast<std::size_t>(run.summary.steps);
  BOOST_TEST(run.trajectory.rows() >= steps);
  BOOST_TEST(steps >= 186u);
  BOOST_TEST(steps <= 190u);
}

BOOST_AUTO_TEST_CASE(an_interrupt_ends_a_run_in_order) {
  const TemporaryFolder folder;
  std::atomic<bool> stop{true};
  RunOptions options;
  options.stop = &stop;
  const RunOutcome outcome = run_in(folder, oscillator, options);
  BOOST_TEST((outcome.status == RunStatus::interrupted));
  BOOST_TEST((read_run(folder / "run").summary.status == RunStatus::interrupted));
  BOOST_TEST(read_run(folder / "run").trajectory.rows() == 1u);
}

// Ends the run after a step of its choice.
class Recorder final : public RunWatcher {
 public:
  explicit Recorder(long last) : last_(last) {}
  std::optional<RunEnd> watch(const RunMoment& moment) override {
    steps.push_back(moment.step);
    times.push_back(moment.t);
    rows.push_back(moment.row);
    if (moment.k != last_) return std::nullopt;
    return RunEnd{RunStatus::failed, "Enough."};
  }
  std::vector<Step> steps;
  std::vector<double> times;
  std::vector<VectorXd> rows;

 private:
  long last_;
};

BOOST_AUTO_TEST_CASE(watchers_are_told_of_every_state_and_may_end_the_run) {
  const TemporaryFolder folder;
  Recorder first(3), second(-1);
  RunOptions options;
  options.watchers = {&first, &second};
  const RunOutcome outcome = run_in(folder, oscillator, options);
  BOOST_TEST((outcome.status == RunStatus::failed));
  BOOST_TEST(outcome.message == "Enough.");
  BOOST_TEST(outcome.summary.steps == 3);
  const Run run = read_run(folder / "run");
  BOOST_TEST(run.trajectory.rows() == 4u);
  BOOST_TEST(second.steps.size() == 4u);  // it was told of the last state too
  BOOST_TEST_REQUIRE(first.steps.size() == 4u);
  const std::string coordinate = run.coordinates().front();
  for (std::size_t k = 0; k < 4; ++k) {
    BOOST_TEST(first.rows[k][0] == run.trajectory.column(coordinate)[k]);
    BOOST_TEST(first.steps[k].after.x[0] == first.rows[k][0]);
    BOOST_TEST(first.times[k] == first.steps[k].after.t);
    if (k == 0) continue;
    const Step& step = first.steps[k];
    BOOST_TEST((step.before.x == first.steps[k - 1].after.x));
    BOOST_TEST((step.stage.x - 0.5 * (step.before.x + step.after.x)).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(steps_with_a_second_attempt_are_counted) {
  const TemporaryFolder folder;
  BOOST_TEST(run_in(folder, oscillator).summary.solver.second_attempts.value() == 0);
}

BOOST_AUTO_TEST_CASE(an_observable_that_is_not_a_number_is_said) {
  const TemporaryFolder folder;
  Json experiment = oscillator;
  experiment["observe"] = {{"n", "sqrt(q + 0.5)"}};
  const RunOutcome outcome = run_in(folder, experiment);
  BOOST_TEST((outcome.status == RunStatus::not_finite));
  BOOST_TEST(outcome.message == "n is nan at t = 2.1, and maybe later.");
  const Run run = read_run(folder / "run");
  BOOST_TEST((run.summary.status == RunStatus::not_finite));
  BOOST_TEST(run.trajectory.rows() == 101u);  // the motion goes on
}

// The implicit midpoint on the index-2 pendulum in Cartesian coordinates is unstable: constraints
// hold at the middle of steps only, and H grows by any amount.
BOOST_AUTO_TEST_CASE(a_change_of_energy_that_the_order_does_not_explain_is_said) {
  const TemporaryFolder folder;
  Json pendulum = Json::parse(R"json({
    "system": { "type": "implicit", "coordinates": ["x", "y", "v", "w"], "unknowns": ["l"],
      "equations": ["x' - v", "y' - w", "v' - l*x", "w' - l*y + 1", "x^2 + y^2 - 1"],
      "energy": "(v^2 + w^2)/2 + y" },
    "initial": { "x": 0.6, "y": -0.8, "v": 0.4, "w": 0.3 },
    "method": { "type": "discretize-first" },
    "time": { "step": 0.1, "end": 10 }
  })json");
  const RunOutcome outcome = run_in(folder, pendulum);
  const QuantityRecord& H = *outcome.summary.observable("H");
  BOOST_TEST(H.max_drift > 1.0);
  BOOST_TEST(outcome.summary.warnings.size() == 1u);
  // What it explains is not said.
  for (const double step : {0.2, 0.02}) {
    Json right = oscillator;
    right["time"]["step"] = step;
    const TemporaryFolder other;
    BOOST_TEST(run_in(other, right).summary.warnings.empty());
    right["system"]["hamiltonian"] = "p_q^2/2 - cos(q) + q^4/10";
    right["method"] = {{"type", "rk2"}};
    const TemporaryFolder third;
    BOOST_TEST(run_in(third, right).summary.warnings.empty());
  }
}

BOOST_AUTO_TEST_CASE(a_run_is_replaced_only_when_told_so) {
  const TemporaryFolder folder;
  run_in(folder, oscillator);
  const std::string before = read_text(folder / "run" / "summary.json");
  BOOST_CHECK_THROW(run_in(folder, oscillator), UnusableFolder);
  BOOST_TEST(read_text(folder / "run" / "summary.json") == before);
  Json longer = oscillator;
  longer["time"]["end"] = 20;
  RunOptions options;
  options.existing = ExistingRun::replace;
  run_in(folder, longer, options);
  BOOST_TEST(read_run(folder / "run").trajectory.rows() == 201u);
}

BOOST_AUTO_TEST_CASE(nothing_is_written_for_an_experiment_that_is_wrong) {
  const TemporaryFolder folder;
  Json experiment = oscillator;
  experiment["observe"]["inverse"] = "1/p_q";
  BOOST_CHECK_THROW(run_in(folder, experiment), ExperimentError);
  Json unfit = oscillator;
  unfit["system"]["manifold"] = "euclidean";
  unfit["system"]["coordinates"] = {"q", "p_q"};
  unfit["system"]["structure"] = {{"type", "bivector"}, {"matrix", {{0, 1}, {-1, 0}}}};
  unfit["method"] = {{"type", "constrain-first"}, {"projector", "momentum"}};
  BOOST_CHECK_THROW(run_in(folder, unfit), ExperimentError);
  BOOST_TEST(!std::filesystem::exists(folder / "run"));
}

BOOST_AUTO_TEST_CASE(an_inconsistent_system_has_no_trajectory) {
  const TemporaryFolder folder;
  Json experiment = {
      {"system", {{"type", "lagrangian"}, {"coordinates", {"q"}}, {"lagrangian", "q' + q"}}},
      {"initial", {{"q", 0}}}};
  BOOST_TEST((run_in(folder, experiment).status == RunStatus::failed));
  experiment["expect"] = {{{"verdict", "inconsistent"}}};
  RunOptions options;
  options.existing = ExistingRun::replace;
  const RunOutcome outcome = run_in(folder, experiment, options);
  BOOST_TEST((outcome.status == RunStatus::completed));
  BOOST_TEST(outcome.as_expected());
  BOOST_TEST(read_run(folder / "run").trajectory.rows() == 0u);
}

// A time-dependent system, by closed form: q'' = cos(3t) from rest.
BOOST_AUTO_TEST_CASE(time_may_appear_explicitly) {
  const TemporaryFolder folder;
  const Json experiment = {
      {"system",
       {{"type", "lagrangian"}, {"coordinates", {"q"}}, {"lagrangian", "q'^2/2 + q*cos(3*t)"}}},
      {"initial", {{"q", 0}, {"q'", 0}}},
      {"method", {{"type", "discretize-first"}}},
      {"time", {{"start", 0}, {"step", 0.001}, {"end", 3}}},
      {"expect",
       {{{"state", {{"q", "(1 - cos(3*t))/9"}, {"p_q", "sin(3*t)/3"}}}, {"tolerance", 1e-5}}}}};
  BOOST_TEST(run_in(folder, experiment).as_expected());
}

// |q'| has no derivative at q' = 0, and its energy is zero whatever the velocity.
BOOST_AUTO_TEST_CASE(the_energy_of_a_light_ray_is_zero) {
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, Json::parse(R"json({
    "title": "A light ray in a vacuum",
    "system": { "type": "lagrangian", "coordinates": ["x", "y"], "lagrangian": "sqrt(x'^2 + y'^2)" },
    "initial": { "x": 1, "y": 0, "x'": 1, "y'": 1 },
    "expect": [ { "verdict": "gauge" } ]
  })json"));
  BOOST_TEST((outcome.status == RunStatus::completed), outcome.message);
  BOOST_TEST(std::abs(outcome.summary.observable("H")->initial) < 1e-15);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
