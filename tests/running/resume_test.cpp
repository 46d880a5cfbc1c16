// Runs that were stopped go on, and leave the files of runs that never were.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/files/own_file.hpp"
#include "courant/running/run_files.hpp"
#include "resumed_run.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the observer knows at an epoch what it knew before, after a stop it does not
//    (running/runner.cpp)
//  * iterations before the stop are not counted (running/runner.cpp)
//  * statistics begin at the checkpoint (running/runner.cpp)
//  * rows at times before the stop are lost (running/runner.cpp)
//  * what was not finite before the stop is forgotten (running/runner.cpp)
//  * the account of powers begins at the checkpoint (running/runner.cpp)
//  * so does the method (running/run_steps.cpp)
//  * a run that goes on confirms its first step, one that was not stopped does not
//    (running/run_steps.cpp)
//  * rows after the checkpoint stay in the file (running/growing_file.cpp)
//  * a checkpoint at the end counts a row that a longer run has not (running/run_steps.hpp)
//  * the report of the run as it was stays (running/run_folder.cpp)
BOOST_AUTO_TEST_SUITE(resume)

namespace {

// Ends where q = 0, at t = 1.886.
const Json collision = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "p_q^2/2 + sqrt(q)" },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.01, "end": 10 },
  "output": { "epoch": 50 }
})json");

// All that a run can keep: expectations at times, of deviations and of events, observables that are
// not numbers at some states, and an energy that an unstable method does not conserve.
const Json oscillator = Json::parse(R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2 + q^4/10" },
  "initial": { "q": 1, "p_q": 0.5 },
  "method": "rk2",
  "time": { "step": 0.2, "end": 30 },
  "observe": { "speed": "q'", "n": "sqrt(q + 1)" },
  "events": { "turn": "p_q", "up": { "zero": "q", "direction": "rising" } },
  "expect": [ { "event": "turn", "number": 2, "time": 4, "state": { "q": 1 }, "tolerance": 3 }, { "at": 4, "state": { "q": 0.3 }, "tolerance": 1 }, { "at": 24, "state": { "q": 0.3 }, "tolerance": 1 },
              { "state": { "q": "cos(t)" }, "tolerance": 3 }, { "observable": "H", "max_drift": 1e-3, "max_slope": 1 } ],
  "output": { "epoch": 40, "every": 7 }
})json");

Json of_file(const std::string& name, long steps, long epoch) {
  Json experiment = Json::parse(read_text("experiments/" + name + ".json"));
  experiment.erase("expect");
  const double step = experiment["time"]["step"].get<double>();
  experiment["time"]["end"] = static_cast<double>(steps) * step;
  experiment["output"] = {{"epoch", epoch}};
  return experiment;
}

Json npy(Json experiment) {
  experiment["output"]["format"] = "npy";
  return experiment;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_run_that_was_killed_goes_on_with_the_same_bytes) {
  for (const Json& experiment : {oscillator, npy(oscillator)})
    check_resumption(experiment, {0, 17, 40, 41, 100, 149, 150}, experiment["output"].dump());
}

BOOST_AUTO_TEST_CASE(with_an_account_of_powers) {
  Json ports = of_file("discrete_gradient_ports", 50, 16);
  check_resumption(ports, {20, 47}, "discrete gradient, ports");
  ports["method"] = "discretize-first";
  ports["output"]["every"] = 7;
  check_resumption(npy(ports), {20}, "Method 1, ports, npy");
}

BOOST_AUTO_TEST_CASE(a_run_that_was_interrupted_goes_on) {
  const TemporaryFolder folder, other;
  const RunOutcome whole = run_in(other, oscillator);
  class Stopper final : public RunWatcher {
   public:
    Stopper(long at, std::atomic<bool>& stop) : at_(at), stop_(stop) {}
    std::optional<RunEnd> watch(const RunMoment& moment) override {
      if (moment.k == at_) stop_ = true;
      return std::nullopt;
    }

   private:
    long at_;
    std::atomic<bool>& stop_;
  };
  std::atomic<bool> stop = false;
  long went_on_after = -1;
  RunOptions options;
  options.stop = &stop;
  options.on_resume = [&](long k, double t) {
    went_on_after = k;
    BOOST_TEST(t == 0.2 * static_cast<double>(k));
  };
  std::vector<long> began;
  for (const long at : {10L, 90L, 140L}) {
    Stopper stopper(at, stop);
    options.watchers = {&stopper};
    const RunOutcome outcome = at == 10 ? run_in(folder, oscillator, options)
                                        : resume_in(folder / "run", oscillator, options);
    BOOST_TEST((outcome.status == RunStatus::interrupted));
    BOOST_TEST(outcome.summary.steps == at + 1);
    began.push_back(went_on_after);
    stop = false;
  }
  BOOST_TEST(began == (std::vector<long>{-1, 0, 80}));
  options.watchers = {};
  BOOST_TEST((resume_in(folder / "run", oscillator, options).status == whole.status));
  BOOST_TEST(went_on_after == 120);
  check_same_files(other / "run", folder / "run", "interrupted");
}

BOOST_AUTO_TEST_CASE(a_run_that_failed_fails_in_the_same_way) {
  check_resumption(collision, {20, 120}, "collision");
  const TemporaryFolder folder, other;
  const RunOutcome first = run_in(folder, collision);
  BOOST_TEST((first.status == RunStatus::failed));
  const RunOutcome again = resume_in(folder / "run", collision);
  BOOST_TEST(first.message == again.message);
  run_in(other, collision);
  check_same_files(other / "run", folder / "run", "failed");
}

BOOST_AUTO_TEST_CASE(a_run_that_is_complete_goes_on_to_a_later_end) {
  for (const long steps : {25L, 80L, 81L, 130L})
    for (const bool binary : {false, true}) {
      const TemporaryFolder folder, other;
      Json experiment = oscillator;
      experiment.erase("expect");
      if (binary) experiment = npy(experiment);
      Json shorter = experiment;
      shorter["time"]["end"] = 0.2 * static_cast<double>(steps);
      run_in(folder, shorter);
      OwnFiles("report").write(folder / "run" / "report.html", "<p>of the run as it was</p>");
      write_text(folder / "run" / "notes.txt", "mine");
      resume_in(folder / "run", experiment);
      run_in(other, experiment);
      check_same_files(other / "run", folder / "run", std::to_string(steps) + " steps first");
      BOOST_TEST(!std::filesystem::exists(folder / "run" / "report.html"));
      BOOST_TEST(std::filesystem::exists(folder / "run" / "notes.txt"));
    }
}

// At an epoch the bits change, but nothing that can be seen.
BOOST_AUTO_TEST_CASE(epochs_change_nothing_but_round_off) {
  for (const char* name : {"heavy_top_so3", "point_vortices", "pendulum_holonomic"}) {
    Json experiment = of_file(name, 100, 1000);
    const TemporaryFolder folder, other;
    const auto without = run_in(folder, experiment).summary.final;
    experiment["output"]["epoch"] = 9;
    const RunOutcome with = run_in(other, experiment);
    for (const auto& [coordinate, value] : without)
      BOOST_TEST(std::abs(value - final_value(with, coordinate)) < 1e-11,
                 name << ": " << coordinate);
  }
}

BOOST_AUTO_TEST_CASE(there_may_be_no_method) {
  const TemporaryFolder folder, other;
  Json point = oscillator;
  for (const char* key : {"method", "time", "events", "expect", "output"}) point.erase(key);
  run_in(folder, point);
  BOOST_CHECK_THROW(resume_in(folder / "run", point), UnusableFolder);
  run_in(other, point);
  std::filesystem::remove(folder / "run" / "summary.json");  // killed early
  resume_in(folder / "run", point);
  check_same_files(other / "run", folder / "run", "at a point");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
