#include "courant/running/event_watch.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <fstream>
#include <numbers>

#include "courant/running/run_files.hpp"
#include "problems.hpp"
#include "run_in.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(event_watch)

namespace {

constexpr double kStep = 0.1;

// By the midpoint rule a step of h turns by 2 atan(h/2).
const Json oscillator = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2" },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.1, "end": 20 },
  "observe": { "square": "q^2" },
  "events": { "centre": "q", "up": { "zero": "q", "direction": "rising" },
              "down": { "zero": "q", "direction": "falling" }, "turn": "q'" }
})json");

// When that has turned by `angle`: whole steps first, and a part of one.
double time_of(double angle) {
  const double a_step = 2.0 * std::atan(kStep / 2.0);
  const double steps = std::floor(angle / a_step);
  return steps * kStep + 2.0 * std::tan((angle - steps * a_step) / 2.0);
}

struct Line {
  std::string name;
  double t, q, p;
};

std::vector<Line> lines(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string text;
  std::getline(stream, text);
  BOOST_TEST(text == "event,t,q,p_q,H,square");
  std::vector<Line> found;
  for (Line line; std::getline(stream, line.name, ',');) {
    char comma = 0;
    stream >> line.t >> comma >> line.q >> comma >> line.p;
    std::getline(stream, text);
    found.push_back(line);
  }
  return found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(zeros_are_on_the_curve_of_the_step) {
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, oscillator);
  BOOST_TEST((outcome.status == RunStatus::completed));
  const auto found = lines(folder / "run" / "events.csv");
  // Six quarters of turns at odd multiples of pi/2 before t = 20, each under two names, and six
  // turning points after the start, which is none.
  std::map<std::string, int> count;
  double last = 0.0;
  for (const Line& line : found) {
    BOOST_TEST(line.t >= last);
    last = line.t;
    const int k = count[line.name]++;
    const double pi = std::numbers::pi;
    const double angle = line.name == "turn"   ? (k + 1) * pi
                         : line.name == "up"   ? (2 * k + 1.5) * pi
                         : line.name == "down" ? (2 * k + 0.5) * pi
                                               : (k + 0.5) * pi;
    BOOST_TEST(std::abs(line.t - time_of(angle)) < 1e-13, line.name << " at " << line.t);
    BOOST_TEST(std::abs(line.q - std::cos(angle)) < 1e-13);
    BOOST_TEST(std::abs(line.p + std::sin(angle)) < 1e-13);
  }
  BOOST_TEST(count["centre"] == 6);
  BOOST_TEST(count["up"] == 3);
  BOOST_TEST(count["down"] == 3);
  BOOST_TEST(count["turn"] == 6);
  const Json summary = to_json(outcome.summary);
  const Json& up = summary["events"]["up"];
  BOOST_TEST(up["count"] == 3);
  BOOST_TEST(std::abs(up["first"].get<double>() - time_of(1.5 * std::numbers::pi)) < 1e-13);
  BOOST_TEST(std::abs(up["last"].get<double>() - time_of(5.5 * std::numbers::pi)) < 1e-13);
  // The folder can be read as before, and replaced.
  BOOST_TEST(read_run(folder / "run").trajectory.rows() == 201u);
  RunOptions again;
  again.existing = ExistingRun::replace;
  BOOST_TEST((run_in(folder, oscillator, again).status == RunStatus::completed));
}

// x' = 1: x is zero at a step, x - 1e-13 just after it; (x - 0.1)² touches zero between two.
BOOST_AUTO_TEST_CASE(a_zero_at_a_step_counts_once) {
  Json straight = {
      {"system", {{"type", "implicit"}, {"coordinates", {"x"}}, {"equations", {"x' - 1"}}}},
      {"initial", {{"x", -0.5}}},
      {"method", "discretize-first"},
      {"time", {{"step", 0.25}, {"end", 1}}},
      {"events",
       {{"at", "x"},
        {"start", "x + 0.5"},
        {"just_after", "x - 1e-13"},
        {"just_before", "x + 1e-13"},
        {"touched", "(x - 0.1)^2"}}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, straight);
  BOOST_TEST((outcome.status == RunStatus::completed), outcome.message);
  const Json summary = to_json(outcome.summary);
  const Json& events = summary["events"];
  BOOST_TEST(events["at"]["count"] == 1);
  BOOST_TEST(events["at"]["first"] == 0.5);
  BOOST_TEST(events["start"]["count"] == 0);
  BOOST_TEST(events["start"]["first"].is_null());
  BOOST_TEST(events["just_after"]["count"] == 1);
  BOOST_TEST(std::abs(events["just_after"]["first"].get<double>() - 0.5 - 1e-13) < 1e-15);
  BOOST_TEST(events["just_before"]["count"] == 1);
  BOOST_TEST(std::abs(events["just_before"]["first"].get<double>() - 0.5 + 1e-13) < 1e-15);
  BOOST_TEST(events["touched"]["count"] == 0);
}

// Kepler's planet with e = 0.6 is at its perihelion after whole periods of 2 pi.
BOOST_AUTO_TEST_CASE(times_are_as_right_as_the_method) {
  std::vector<double> steps, errors;
  // Of m = 1.7, k = 2.3, a = 1.25.
  const double period = 2.0 * std::numbers::pi * std::sqrt(1.7 * std::pow(1.25, 3) / 2.3);
  for (const long count : {64, 96, 128, 192}) {
    Json experiment = test::experiment_file("kepler_order_8");
    for (const char* key : {"expect", "observe", "output"}) experiment.erase(key);
    experiment["method"]["order"] = 4;
    const double h = period / static_cast<double>(count);
    experiment["time"] = {{"step", h}, {"end", 1.25 * static_cast<double>(count) * h}};
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, experiment);
    BOOST_TEST_REQUIRE(outcome.summary.events.at(0).second.count == 1);
    steps.push_back(h);
    errors.push_back(std::abs(outcome.summary.events.at(0).second.first - period));
  }
  const double order = log_log_slope(steps, errors, 1e-12);
  BOOST_TEST(std::abs(order - 4.0) < 0.3, "order " << order);
}

BOOST_AUTO_TEST_CASE(expectations_of_events) {
  Json experiment = oscillator;
  const double first = time_of(0.5 * std::numbers::pi), second = time_of(2.5 * std::numbers::pi);
  experiment["expect"] = {
      {{"event", "up"}, {"count", 3}},
      {{"event", "down"}, {"number", 2}, {"time", second}, {"tolerance", 1e-12}},
      {{"event", "down"},
       {"time", first},
       {"state", {{"q", 0}, {"p_q", "-1"}}},
       {"tolerance", 1e-12}},
      {{"event", "up"}, {"count", 2}},
      {{"event", "down"}, {"number", 2}, {"time", second + 2e-12}, {"tolerance", 1e-12}},
      {{"event", "down"}, {"number", 4}, {"state", {{"q", 0}}}, {"tolerance", 1e-12}}};
  const TemporaryFolder folder;
  const RunOutcome outcome = run_in(folder, experiment);
  std::vector<bool> passed;
  for (const ExpectationResult& result : outcome.expectations) passed.push_back(result.passed);
  BOOST_TEST(passed == (std::vector<bool>{true, true, true, true, true, false, false, false}),
             boost::test_tools::per_element());
  BOOST_TEST(outcome.expectations[2].description == "t = " + Json(first).dump() + " at down 1");
  BOOST_TEST(outcome.expectations[5].finding == "is 3; expected 2");
  BOOST_TEST(outcome.expectations[7].finding == "is not known: the run did not come to it");
}

BOOST_AUTO_TEST_CASE(what_is_wrong_with_events) {
  const auto problem = [](const Json& events, const Json& expect) -> std::string {
    Json experiment = oscillator;
    experiment["events"] = events;
    experiment["expect"] = Json::array({expect});
    try {
      read_experiment(experiment.dump());
    } catch (const ExperimentError& error) {
      return error.what();
    }
    return "";
  };
  const Json good = {{"observable", "H"}, {"max_drift", 1}};
  BOOST_TEST(problem({{"up", "q"}}, good) == "");
  BOOST_TEST(problem({{"up", "qq"}}, good).find("/events/up: ") == 0u);
  BOOST_TEST(problem({{"up", "pi"}}, good) ==
             "/events/up: is constant; expected a formula that has zeros");
  BOOST_TEST(problem({{"a,b", "q"}}, good).find("/events/a,b: key, ") == 0u);
  BOOST_TEST(problem({{"up", {{"direction", "rising"}}}}, good) == "/events/up/zero: is missing");
  BOOST_TEST(problem({{"up", {{"zero", "q"}, {"direction", "upwards"}}}}, good)
                 .find("/events/up/direction: is \"upwards\"; expected") == 0u);
  BOOST_TEST(problem({{"up", "q"}}, {{"event", "upp"}, {"count", 1}}) ==
             "/expect/0/event: unknown event \"upp\" (did you mean \"up\"?)");
  BOOST_TEST(problem({{"up", "q"}}, {{"event", "up"}}) ==
             "/expect/0: expects nothing; expected \"count\", \"time\" or \"state\"");
  BOOST_TEST(problem({{"up", "q"}}, {{"event", "up"}, {"number", 2}, {"tolerance", 1}}) ==
             "/expect/0/number: tests nothing; expected \"time\" or \"state\" beside it");
  BOOST_TEST(problem({{"up", "q"}}, {{"event", "up"}, {"time", 2}}) ==
             "/expect/0/tolerance: is missing");
  BOOST_TEST(problem({{"up", "q"}}, {{"event", "up"}, {"time", "t"}, {"tolerance", 1}})
                 .find("/expect/0/time: ") == 0u);
}

// The run ends at the first zero of such an event, with what is known of the state there.
BOOST_AUTO_TEST_CASE(an_event_may_stop_the_run) {
  const TemporaryFolder folder;
  Json document = oscillator;
  document["events"]["centre"] = {{"zero", "q"}, {"stop", true}};
  document["output"] = {{"every", 7}};
  const RunOutcome outcome = run_in(folder, document);
  BOOST_TEST((outcome.status == RunStatus::completed), outcome.message);
  const double expected = time_of(std::numbers::pi / 2.0);
  const RunSummary summary = read_run(folder / "run").summary;
  BOOST_TEST(summary.stopped_by == "centre");
  BOOST_TEST(std::abs(summary.time->end - expected) < 1e-12);
  BOOST_TEST(summary.steps == 16);
  const TrajectoryTable table = read_run(folder / "run").trajectory;
  BOOST_TEST(table.rows() == 4u);  // steps 0, 7, 14 and the zero
  BOOST_TEST(std::abs(table.column("t").back() - expected) < 1e-12);
  BOOST_TEST(std::abs(table.column("q").back()) < 1e-12);
  BOOST_TEST(std::abs(final_value(outcome, "p_q") + 1.0) < 1e-12);
  // It is complete: there is nothing to go on with.
  RunOptions onward;
  onward.existing = ExistingRun::resume;
  BOOST_CHECK_THROW(run_in(folder, document, onward), UnusableFolder);
  document["events"]["centre"]["stop"] = 1;
  BOOST_CHECK_THROW(read_experiment_document(document), ExperimentError);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
