#include "courant/running/run_steps.hpp"

#include <boost/test/unit_test.hpp>
#include <string>
#include <thread>

#include "courant/reading/experiment.hpp"
#include "courant/running/consistent_start.hpp"
#include "resumed_run.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a state that was moved is not where the next step begins
//  * steps that have not been read are overwritten
//  * steps that are made ahead have no epochs
//  * an attempt that failed is not counted
//  * what a step took is not told
//  * all steps begin where the run does
//  * a run that goes on is prepared as one that begins
BOOST_AUTO_TEST_SUITE(run_steps)

namespace {

const Json oscillator = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "p_q^2/2 + q^4/4 + q" },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.05, "end": 100 }
})json");

// A method on M_f: what it prepares is not what the experiment says, and v and z are known after a step.
const Json pendulum = Json::parse(R"json({
  "system": {
    "type": "lagrangian", "coordinates": ["x", "y"],
    "lagrangian": "(x'^2 + y'^2)/2 - 9.81*y", "holonomic": ["x^2 + y^2 - 1"]
  },
  "initial": { "x": 0.6, "y": -0.8, "p_x": 0.4, "p_y": 0.3 },
  "method": { "type": "constrain-first", "discretization": "midpoint" },
  "time": { "step": 0.01, "end": 20 }
})json");

// q' = q²: 1/q = 1 - t, which no step leads beyond.
const Json explosion = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "p_q*q^2" },
  "initial": { "q": 1, "p_q": 1 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.0005, "end": 2 }
})json");

struct Prepared {
  explicit Prepared(const Json& json)
      : experiment(read_experiment(json.dump())),
        ladder(consistent_start(experiment)),
        method(experiment.method->prepare({.system = experiment.model.system,
                                           .ladder = ladder,
                                           .initial = ladder.point,
                                           .step = experiment.time->step,
                                           .backend = Backend::interpreter,
                                           .vocabulary = &experiment.model.vocabulary})) {}
  RunSteps steps(long epoch, bool ahead) const {
    return RunSteps(*method.integrator, *experiment.time, epoch, {.state = method.initial}, ahead);
  }

  Experiment experiment;
  ConstraintLadder ladder;
  PreparedMethod method;
};

bool is_same(const SolverStatistics& a, const SolverStatistics& b) {
  return a.steps == b.steps && a.iterations == b.iterations &&
         a.factorizations == b.factorizations && a.failures == b.failures &&
         a.confirmations == b.confirmations;
}

}  // namespace

BOOST_AUTO_TEST_CASE(steps_that_are_made_ahead_are_the_same) {
  for (const Json& json : {oscillator, pendulum}) {
    const Prepared prepared(json);
    for (const long epoch : {1L, 7L, 1L << 30}) {
      RunSteps ahead = prepared.steps(epoch, true), on_demand = prepared.steps(epoch, false);
      ahead.begin();
      on_demand.begin();
      BOOST_TEST((ahead.ended().after == on_demand.ended().after));
      BOOST_TEST((ahead.state() == on_demand.state()));
      for (long k = 1; k <= 300; ++k) {
        ahead.next();
        on_demand.next();
        BOOST_TEST_REQUIRE(ahead.k() == k);
        BOOST_TEST_REQUIRE((ahead.ended().after == on_demand.ended().after));
        // After an epoch a method on M_f prepares that state once more.
        BOOST_TEST_REQUIRE((ahead.ended().before.x - on_demand.ended().before.x).norm() < 1e-14);
        BOOST_TEST_REQUIRE(ahead.ended().h == on_demand.ended().h);
        BOOST_TEST_REQUIRE((ahead.state() == on_demand.state()));
        BOOST_TEST_REQUIRE(is_same(ahead.statistics(), on_demand.statistics()));
        BOOST_TEST_REQUIRE(ahead.is_epoch_over() == (k % epoch == 0));
        BOOST_TEST_REQUIRE(on_demand.is_epoch_over() == (k % epoch == 0));
        if (!ahead.is_epoch_over()) continue;
        const Motion of_ahead = ahead.end_epoch(), of_other = on_demand.end_epoch();
        BOOST_TEST_REQUIRE(of_ahead.is_predictable == of_other.is_predictable);
        BOOST_TEST_REQUIRE(
            (of_ahead.displacements.array() == of_other.displacements.array()).all());
      }
    }
  }
}

// A state that is moved between two steps is where the next one begins, whoever asked for it before.
BOOST_AUTO_TEST_CASE(a_state_may_be_moved_between_steps) {
  const Prepared prepared(oscillator);
  const auto stepper = prepared.method.integrator->stepper();
  RunSteps steps = prepared.steps(1L << 30, false);
  steps.begin();
  State state = prepared.method.initial;
  stepper->prepare(state, prepared.experiment.time->step);
  for (long k = 1; k <= 30; ++k) {
    if (k % 5 == 0) state.x[0] = steps.state().x[0] += 0.125;
    if (k % 7 == 0) BOOST_TEST((steps.state() == state));
    steps.next();
    stepper->step(state, prepared.experiment.time->step, prepared.experiment.time->time(k));
    BOOST_TEST((steps.ended().after == state));
  }
}

// What goes on from a checkpoint makes the steps of the run that wrote it.
BOOST_AUTO_TEST_CASE(a_start_after_an_epoch_goes_on) {
  const Prepared prepared(pendulum);
  RunSteps whole = prepared.steps(20, true);
  whole.begin();
  for (int k = 0; k < 20; ++k) whole.next();
  BOOST_TEST_REQUIRE(whole.is_epoch_over());
  const State at = whole.state();
  const Motion motion = whole.end_epoch();
  const long before = whole.statistics().iterations;
  for (const bool is_ahead : {false, true}) {
    RunSteps rest(*prepared.method.integrator, *prepared.experiment.time, 20,
                  {.k = 20, .state = at, .motion = motion}, is_ahead);
    rest.begin();
    BOOST_TEST((rest.state() == at));
    for (int k = 21; k <= 39; ++k) {
      rest.next();
      if (!is_ahead) whole.next();
      BOOST_TEST(rest.k() == k);
      BOOST_TEST(!rest.is_epoch_over());
    }
    BOOST_TEST((rest.state() == whole.state()));
    BOOST_TEST(rest.statistics().iterations == whole.statistics().iterations - before);
  }
}

// A reader that is late is waited for, and one that goes away ends the thread.
BOOST_AUTO_TEST_CASE(the_ring_is_not_overwritten) {
  Json longer = oscillator;
  longer["time"]["end"] = 50 * 100000;
  const Prepared prepared(longer);
  RunSteps ahead = prepared.steps(4096, true), on_demand = prepared.steps(4096, false);
  ahead.begin();
  on_demand.begin();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // tens of thousands of steps
  for (long k = 1; k <= 20000; ++k) {
    ahead.next();
    on_demand.next();
    BOOST_TEST_REQUIRE((ahead.state() == on_demand.state()));
    if (!on_demand.is_epoch_over()) continue;
    ahead.end_epoch();
    on_demand.end_epoch();
  }
}

BOOST_AUTO_TEST_CASE(a_step_that_cannot_be_made_is_told_when_it_is_asked_for) {
  const Prepared prepared(explosion);
  RunSteps ahead = prepared.steps(4096, true), on_demand = prepared.steps(4096, false);
  ahead.begin();
  on_demand.begin();
  const auto last = [](RunSteps& steps) {
    std::string message;
    try {
      for (;;) steps.next();
    } catch (const SolveError& error) {
      message = error.what();
    }
    return message;
  };
  const std::string of_ahead = last(ahead), of_other = last(on_demand);
  BOOST_TEST(!of_ahead.empty());
  BOOST_TEST(of_ahead == of_other);
  BOOST_TEST(ahead.k() == on_demand.k());
  BOOST_TEST(ahead.k() > 1000);
  BOOST_TEST((ahead.state() == on_demand.state()));
  BOOST_TEST(is_same(ahead.statistics(), on_demand.statistics()));
}

// A state off the manifold is refused before the first step.
BOOST_AUTO_TEST_CASE(a_start_that_cannot_be_prepared_is_told) {
  const Prepared prepared(oscillator);
  for (const bool is_ahead : {false, true}) {
    RunSteps steps(*prepared.method.integrator, *prepared.experiment.time, 4096,
                   {.state = {.x = VectorXd::Zero(3)}}, is_ahead);
    BOOST_CHECK_THROW(steps.begin(), std::invalid_argument);
  }
}

// Files of runs do not tell in which thread steps were made.
BOOST_AUTO_TEST_CASE(runs_leave_the_same_files) {
  for (Json json : {oscillator, pendulum, explosion}) {
    json["output"] = {{"every", 10}, {"epoch", 100}};
    const TemporaryFolder ahead, on_demand;
    RunOptions options;
    options.ahead = true;
    run_in(ahead, json, options);
    options.ahead = false;
    run_in(on_demand, json, options);
    check_same_files(ahead / "run", on_demand / "run", json.dump());
    BOOST_TEST(read_text(ahead / "run" / "trajectory.csv").size() > 1000u);
  }
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
