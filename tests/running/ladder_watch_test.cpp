#include "courant/integrators/certificate/ladder_watch.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "run_in.hpp"

BOOST_AUTO_TEST_SUITE(ladder_watch_test)

using namespace courant;

namespace {

// Two cranks of length 1 at the angles a and c, a coupler of length 2 at the angle b over a base of
// length 2, moments of inertia 1, a torque of 0.2 on the first crank. The parallelogram moves with
// a = c = 0.7 - t + t²/20, b = 0; at t = 10 - √86 = 0.7264 all bars are on one line.
Json linkage(double step, double end, long examine) {
  Json experiment = Json::parse(R"json({
    "system": {
      "type": "implicit",
      "coordinates": ["a", "b", "c", "pa", "pb", "pc"],
      "unknowns": ["l", "m"],
      "equations": [
        "a' - pa", "b' - pb", "c' - pc",
        "pa' - l*sin(a) + m*cos(a) - 0.2", "pb' - 2*l*sin(b) + 2*m*cos(b)", "pc' + l*sin(c) - m*cos(c)",
        "cos(a) + 2*cos(b) - cos(c) - 2", "sin(a) + 2*sin(b) - sin(c)"
      ]
    },
    "initial": { "a": 0.7, "b": 0, "c": 0.7, "pa": -1, "pb": 0, "pc": -1 },
    "method": { "type": "constrain-first" }
  })json");
  experiment["time"] = {{"step", step}, {"end", end}};
  experiment["examine"] = examine;
  return experiment;
}

}  // namespace

// Without the torque the bars carry no load: the multipliers are zero, and nearer and nearer to the
// singular point (at t = 0.7) round-off moves them further and further.
BOOST_AUTO_TEST_CASE(multipliers_that_vanish_do_not_stop_it) {
  const TemporaryFolder folder;
  Json experiment = linkage(0.01, 0.69, 0);
  experiment["system"]["equations"][3] = "pa' - l*sin(a) + m*cos(a)";
  experiment.erase("examine");
  const RunOutcome outcome = run_in(folder, experiment);
  BOOST_TEST((outcome.status == RunStatus::completed), outcome.message);
  BOOST_TEST(std::abs(final_value(outcome, "a") - 0.01) < 1e-10);
}

// No step hits it; the watch sees the rank fall before.
BOOST_AUTO_TEST_CASE(a_singular_configuration_stops_the_run) {
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, linkage(0.01, 1.0, 5));
  BOOST_TEST((outcome.status == RunStatus::failed));
  BOOST_TEST(outcome.message.find("The ranks change near t = 0.71") != std::string::npos,
             outcome.message);
  BOOST_TEST(outcome.message.find("at level 0 fell from 0.075") != std::string::npos,
             outcome.message);
  BOOST_TEST(outcome.message.find("to 0.014") != std::string::npos, outcome.message);
  BOOST_TEST(outcome.message.find("singular") != std::string::npos);
  BOOST_TEST(outcome.summary.time->end == 0.7, boost::test_tools::tolerance(1e-12));
}

// Examined at every step it goes on until just before.
BOOST_AUTO_TEST_CASE(closer_looks_stop_later) {
  const TemporaryFolder folder;
  const double stopped = run_in(folder, linkage(0.008, 1.0, 1)).summary.time->end;
  BOOST_TEST(stopped > 0.7);
  BOOST_TEST(stopped < 0.7264);
}

// From a state on either side nothing singular is seen, at the state itself it is.
BOOST_AUTO_TEST_CASE(the_state_itself_is_refused) {
  const Experiment experiment = read_experiment(linkage(0.01, 1.0, 1).dump());
  const ConstraintLadder start =
      ConstraintAlgorithm().run(experiment.model.system, {.x = experiment.initial.x.values});
  const auto at_angle = [&](double angle) {
    State state = start.point;
    state.x[0] = state.x[2] = angle;
    state.v = state.z = VectorXd();
    return state;
  };
  BOOST_TEST(LadderWatch(experiment.model.system, start).examine(at_angle(0.6)).empty());
  const std::string finding = LadderWatch(experiment.model.system, start).examine(at_angle(0.0));
  BOOST_TEST(finding.find("ranks change at t = 0") != std::string::npos, finding);
}

// Nothing is said where nothing happens, and nobody looks where nobody is asked to.
BOOST_AUTO_TEST_CASE(a_regular_run_goes_on) {
  const TemporaryFolder folder, other;
  BOOST_TEST((run_in(folder, linkage(0.01, 0.6, 5)).status == RunStatus::completed));
  const RunOutcome unwatched = run_in(other, linkage(0.008, 0.72, 0));
  BOOST_TEST(unwatched.message.find("The ranks change") == std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
