// Events that set something: where a run jumps, and goes on from there.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/running/c_program.hpp"
#include "courant/running/run_in_memory.hpp"
#include "problems.hpp"
#include "resumed_run.hpp"
#include "run_in.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * velocities of a stage stand for those at the event (running/observed_quantities.cpp)
//  * the second event of a step is not seen (running/event_watch.cpp, side_before)
//  * what the jump itself passes is not told (running/event_watch.cpp, go_on_behind)
//  * a run that goes on forgets what has just been set (running/checkpoint.cpp, behind)
//  * parts of a step have no account of powers (running/runner.cpp, over_resets)
BOOST_AUTO_TEST_SUITE(event_resets)

namespace {

const Json ball = Json::parse(R"json({
  "system": { "type": "lagrangian", "parameters": { "m": 0.5, "g": 9.81, "k": 0.8 }, "coordinates": ["y"],
              "lagrangian": "m*y'^2/2 - m*g*y" },
  "initial": { "y": 1, "y'": 0 },
  "events": { "bounce": { "zero": "y", "direction": "falling", "set": { "y'": "-k*y'" } } },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.05, "end": 3 }
})json");

// v' = s - v with a relay: s goes off where v rises above 3/4, on where it falls below 1/4.
const Json relay = Json::parse(R"json({
  "system": { "type": "implicit", "coordinates": ["v", "s"], "equations": ["v' - (s - v)", "s'"] },
  "initial": { "v": 0, "s": 1 },
  "events": { "up": { "zero": "v - 0.75", "direction": "rising", "set": { "s": 0 } },
              "down": { "zero": "v - 0.25", "direction": "falling", "set": { "s": 1 } } },
  "method": "rk4",
  "time": { "step": 0.05, "end": 12 },
  "output": { "epoch": 50 }
})json");

// A capacitor that a source charges and a switch with memory discharges.
const Json circuit = Json::parse(R"json({
  "system": { "type": "network", "nodes": ["0", "a", "c", "m"], "elements": [
    { "type": "voltage-source", "name": "V", "from": "a", "to": "0", "value": 2 },
    { "type": "resistor", "name": "R", "from": "a", "to": "c", "value": 1000 },
    { "type": "capacitor", "name": "C", "from": "c", "to": "0", "value": 1e-6 },
    { "type": "resistor", "name": "S", "from": "c", "to": "0", "current": "v_S/if(q_M > 0.5, 100, 1e12)" },
    { "type": "capacitor", "name": "M", "from": "m", "to": "0", "energy": "0" } ] },
  "initial": { "q_C": 0, "q_M": 0 },
  "events": { "on": { "zero": "potential_c - 1.5", "direction": "rising", "set": { "q_M": 1 } },
              "off": { "zero": "potential_c - 0.5", "direction": "falling", "set": { "q_M": 0 } } },
  "method": { "type": "discretize-first" },
  "time": { "step": 2e-5, "end": 4e-3 }
})json");

Json with(Json experiment, const std::string& pointer, const Json& value) {
  experiment[Json::json_pointer(pointer)] = value;
  return experiment;
}

RunInMemory run_of(const Json& experiment) {
  RunInMemoryOptions options;
  options.run.backend = Backend::interpreter;
  return run_in_memory(read_experiment(experiment.dump()), options);
}

std::vector<double> times(const RunInMemory& run, const std::string& event) {
  return run.events.at(event).column("t");
}

}  // namespace

// By hand: the ball falls for √(2/g), and flies 2 v/g with v = kⁿ √(2 g) from the n-th bounce on. Steps of the midpoint rule are exact.
BOOST_AUTO_TEST_CASE(a_ball_bounces_when_it_does) {
  for (const char* method : {"discretize-first", "constrain-first"}) {
    BOOST_TEST_CONTEXT(method) {
      const RunInMemory run = run_of(with(ball, "/method/type", method));
      BOOST_TEST((run.outcome.status == RunStatus::completed));
      const std::vector<double> found = times(run, "bounce");
      const double g = 9.81;
      double t = std::sqrt(2.0 / g), v = std::sqrt(2.0 * g);
      std::size_t count = 0;
      for (; t < 3.0; t += 2.0 * v / g, ++count) {
        BOOST_TEST_REQUIRE(count < found.size());
        BOOST_TEST(std::abs(found[count] - t) < 1e-12);
        v *= 0.8;
      }
      BOOST_TEST(found.size() == count);
      // Three bounces in one step, at the end: the height is that of the last of them.
      const double since = 3.0 - (t - 2.0 * v / 0.8 * 0.8 / g);
      BOOST_TEST(std::abs(run.rows.column("y").back() - (v * since - g * since * since / 2.0)) <
                 1e-11);
    }
  }
}

BOOST_AUTO_TEST_CASE(bounces_without_end_are_told) {
  const RunInMemory run = run_of(with(ball, "/time/end", 6));
  BOOST_TEST((run.outcome.status == RunStatus::failed));
  BOOST_TEST(
      run.outcome.message.starts_with("The times of the event bounce accumulate at t = 4.0"));
}

// By hand: it rises from 0 to 3/4 in ln 4, and then falls and rises in ln 3 each.
BOOST_AUTO_TEST_CASE(a_relay_remembers) {
  const RunInMemory run = run_of(relay);
  const std::vector<double> up = times(run, "up"), down = times(run, "down");
  BOOST_TEST_REQUIRE(up.size() == 5u);
  BOOST_TEST_REQUIRE(down.size() == 5u);
  for (std::size_t k = 0; k < up.size(); ++k) {
    const double first = std::log(4.0) + 2.0 * static_cast<double>(k) * std::log(3.0);
    BOOST_TEST(std::abs(up[k] - first) < 1e-6);
    BOOST_TEST(std::abs(down[k] - first - std::log(3.0)) < 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(a_run_with_jumps_goes_on_with_the_same_bytes) {
  check_resumption(relay, {0, 60, 130, 199}, "relay");
}

// The ball lands where the first step ends, and again within the second, which a run that goes on makes.
BOOST_AUTO_TEST_CASE(a_jump_where_an_epoch_ends_is_behind_the_run) {
  Json thrown = with(ball, "/system/parameters", {{"m", 1}, {"g", 2}, {"k", 0.45}});
  thrown["time"] = {{"step", 1}, {"end", 2}};
  thrown["output"] = {{"epoch", 1}};
  const std::vector<double> found = times(run_of(thrown), "bounce");
  BOOST_TEST_REQUIRE(found.size() == 2u);
  BOOST_TEST(found[0] == 1.0);
  BOOST_TEST(std::abs(found[1] - 1.9) < 1e-12);
  check_resumption(thrown, {1, 2}, "ball");
}

// What a jump of s passes is an event at its time: c follows s at once.
BOOST_AUTO_TEST_CASE(jumps_lead_to_events) {
  Json chain = relay;
  chain["system"]["coordinates"] = {"v", "s", "c"};
  chain["system"]["equations"] = {"v' - (s - v)", "s'", "c'"};
  chain["initial"] = {{"v", 0}, {"s", 1}, {"c", 0}};
  chain["events"]["copy"] = {
      {"zero", "0.5 - s"}, {"direction", "rising"}, {"set", {{"c", "c + 1"}}}};
  const RunInMemory run = run_of(chain);
  BOOST_TEST(times(run, "copy") == times(run, "up"), boost::test_tools::per_element());
  BOOST_TEST(run.rows.column("c").back() == 5.0);
  // Two that call each other never end.
  chain["events"]["back"] = {{"zero", "s - 0.5"}, {"direction", "rising"}, {"set", {{"s", 0}}}};
  chain["events"]["copy"]["set"] = {{"s", 1}};
  const RunInMemory endless = run_of(chain);
  BOOST_TEST((endless.outcome.status == RunStatus::failed));
  BOOST_TEST(endless.outcome.message.find("each leads to the next") != std::string::npos);
}

// Two relays with the same thresholds go over together.
BOOST_AUTO_TEST_CASE(what_happens_at_one_time_is_all_done) {
  Json both = relay;
  both["system"]["coordinates"] = {"v", "s", "c"};
  both["system"]["equations"] = {"v' - (s - v)", "s'", "c'"};
  both["initial"] = {{"v", 0}, {"s", 1}, {"c", 1}};
  both["events"]["up_too"] = {{"zero", "v - 0.75"}, {"direction", "rising"}, {"set", {{"c", 0}}}};
  both["events"]["down_too"] = {
      {"zero", "v - 0.25"}, {"direction", "falling"}, {"set", {{"c", 1}}}};
  const RunInMemory run = run_of(both);
  BOOST_TEST(times(run, "up_too") == times(run, "up"), boost::test_tools::per_element());
  BOOST_TEST(times(run, "down_too") == times(run, "down"), boost::test_tools::per_element());
  BOOST_TEST(run.rows.column("c") == run.rows.column("s"), boost::test_tools::per_element());
}

// A pendulum of two Cartesian coordinates and a wall at its lowest point: it comes back to where it was released, again and again.
BOOST_AUTO_TEST_CASE(constraints_hold_behind_a_jump) {
  const Json pendulum = Json::parse(R"json({
    "system": { "type": "mechanical", "parameters": { "g": 9.81 }, "coordinates": ["x", "y"],
                "potential": "g*y", "holonomic": ["x^2 + y^2 - 1"] },
    "initial": { "x": 1, "y": 0, "x'": 0, "y'": 0 },
    "events": { "wall": { "zero": "x", "direction": "falling", "set": { "x'": "-x'", "y'": "-y'" } } },
    "method": { "type": "constrain-first", "order": 4 },
    "time": { "step": 0.01, "end": 6 }
  })json");
  const RunInMemory run = run_of(pendulum);
  BOOST_TEST((run.outcome.status == RunStatus::completed));
  BOOST_TEST(run.outcome.summary.max_violation.value_or(1.0) < 1e-13);
  // A quarter of the period of a pendulum that is released from the horizontal, K(1/√2)/√g.
  const double quarter = std::comp_ellint_1(std::sqrt(0.5)) / std::sqrt(9.81);
  const std::vector<double> found = times(run, "wall");
  BOOST_TEST(found.size() == 5u);
  for (std::size_t k = 0; k < found.size(); ++k)
    BOOST_TEST(std::abs(found[k] - static_cast<double>(2 * k + 1) * quarter) < 1e-6);
  BOOST_TEST(run.outcome.summary.observable("H")->max_drift < 1e-5);
  for (const double x : run.rows.column("x")) BOOST_TEST(x > -1e-12);

  // A velocity that the rod does not allow: what an impulse makes of it is said.
  const RunInMemory moved =
      run_of(with(with(pendulum, "/events/wall/set", {{"y'", 1.0}}), "/time/end", 1));
  BOOST_TEST((moved.outcome.status == RunStatus::completed));
  BOOST_TEST_REQUIRE(!moved.outcome.summary.warnings.empty());
  BOOST_TEST(moved.outcome.summary.warnings[0].find("the event wall moves also") !=
             std::string::npos);
}

// By hand: charging from 0 to 3/4 of the source takes R C ln 4, and what is charged, supplied and lost is in balance.
BOOST_AUTO_TEST_CASE(a_jump_keeps_the_account_of_powers) {
  const RunInMemory run = run_of(circuit);
  BOOST_TEST((run.outcome.status == RunStatus::completed));
  const std::vector<double> on = times(run, "on");
  BOOST_TEST_REQUIRE(on.size() == 3u);
  BOOST_TEST(std::abs(on[0] / 1e-3 - std::log(4.0)) < 1e-4);
  const double supplied = run.rows.column("supplied").back();
  for (const double balance : run.rows.column("balance"))
    BOOST_TEST(std::abs(balance) < 1e-12 * supplied);
  // Steps of several parts, which lose what damping takes.
  const RunInMemory damped =
      run_of(with(circuit, "/method", {{"type", "discretize-first"}, {"damping", "l-stable"}}));
  BOOST_TEST((damped.outcome.status == RunStatus::completed));
  BOOST_TEST(std::abs(times(damped, "on").at(2) / on[2] - 1.0) < 1e-3);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_set_is_refused) {
  const auto problem = [](const Json& set) {
    return problem_of_run(with(ball, "/events/bounce/set", set));
  };
  BOOST_TEST(problem({{"z", 1}}).find("unknown name \"z\"") != std::string::npos);
  BOOST_TEST(problem(Json::object()).find("sets nothing") != std::string::npos);
  BOOST_TEST(problem({{"y", "q"}}).find("unknown name \"q\"") != std::string::npos);
  BOOST_TEST(problem_of_run(with(relay, "/events/up/set", {{"v'", 1}}))
                 .find("is set as a velocity that has no momentum") != std::string::npos);
  BOOST_TEST(problem_of_run(with(ball, "/events/bounce/stop", true))
                 .find("/events/bounce/set: is for a run that goes on") != std::string::npos);
  BOOST_TEST(problem_of_run(with(ball, "/sensitivities", {{"by", {"g"}}, {"of", {"y"}}}))
                 .find("/events/bounce/set: jumps") != std::string::npos);
  const Experiment experiment = read_experiment(ball.dump());
  BOOST_CHECK_THROW(c_program(experiment), ExperimentError);
  // Where it is no number the run ends there.
  const RunInMemory run = run_of(with(ball, "/events/bounce/set", {{"y'", "log(-1 + y)"}}));
  BOOST_TEST((run.outcome.status == RunStatus::failed));
  BOOST_TEST(run.outcome.message.find("sets y' to nan; expected a number") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
