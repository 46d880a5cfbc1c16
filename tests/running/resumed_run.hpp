// Runs that are killed and go on, for tests.
#pragma once

#include <boost/test/unit_test.hpp>
#include <string>

#include "run_in.hpp"

namespace courant {

// Copies the folder of a run after step k: what a kill leaves at that moment. A kill while rows are
// written tears the last one.
class Killer final : public RunWatcher {
 public:
  Killer(std::filesystem::path run, std::filesystem::path copy, long k)
      : run_(std::move(run)), copy_(std::move(copy)), k_(k) {}
  std::optional<RunEnd> watch(const RunMoment& moment) override {
    if (moment.k != k_) return std::nullopt;
    std::filesystem::copy(run_, copy_);
    for (const char* name : {"trajectory.csv", "trajectory.npy", "events.csv"})
      if (std::filesystem::exists(copy_ / name))
        std::ofstream(copy_ / name, std::ios::binary | std::ios::app) << "0.125,-3.1";
    return std::nullopt;
  }

 private:
  std::filesystem::path run_, copy_;
  long k_;
};

inline RunOutcome resume_in(const std::filesystem::path& folder, const Json& experiment,
                            RunOptions options = {}) {
  options.folder = folder;
  options.backend = Backend::interpreter;
  options.existing = ExistingRun::resume;
  return run(read_experiment(experiment.dump()), options);
}

// What is the same in two summaries of one run, however often it was stopped.
inline std::string lasting(const Json& summary) {
  Json json = summary;
  for (const char* key : {"id", "wall_seconds", "cpu_seconds", "steps_per_second"}) json.erase(key);
  return json.dump(1);
}

// That the files are those of the same run, and nothing but what changes with it is different.
inline void check_same_files(const std::filesystem::path& run, const std::filesystem::path& other,
                             const std::string& what) {
  for (const char* name : {"trajectory.csv", "trajectory.npy", "columns.json", "events.csv"})
    BOOST_TEST((read_text(run / name) == read_text(other / name)), what << ": " << name);
  BOOST_TEST(lasting(Json::parse(read_text(run / "summary.json"))) ==
                 lasting(Json::parse(read_text(other / "summary.json"))),
             what);
  Json one = Json::parse(read_text(run / "experiment.json")),
       two = Json::parse(read_text(other / "experiment.json"));
  one.erase("$run");
  two.erase("$run");
  BOOST_TEST(one == two, what);
}

// Runs the experiment to its end, and again from what a kill after each of the steps `at` leaves.
inline void check_resumption(const Json& experiment, const std::vector<long>& at,
                             const std::string& what) {
  const TemporaryFolder folder;
  std::vector<std::unique_ptr<Killer>> killers;
  RunOptions options;
  options.checkpoint_interval = std::chrono::seconds(0);
  for (const long k : at) {
    killers.push_back(
        std::make_unique<Killer>(folder / "run", folder / ("killed" + std::to_string(k)), k));
    options.watchers.push_back(killers.back().get());
  }
  const RunOutcome whole = run_in(folder, experiment, options);
  for (const long k : at) {
    const auto killed = folder / ("killed" + std::to_string(k));
    const std::string where = what + ", killed after step " + std::to_string(k);
    BOOST_TEST_REQUIRE(std::filesystem::exists(killed), where);
    const RunOutcome resumed = resume_in(killed, experiment);
    BOOST_TEST((resumed.status == whole.status), where);
    check_same_files(folder / "run", killed, where);
  }
}

}  // namespace courant
