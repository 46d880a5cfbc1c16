#include "courant/running/unfinished_run.hpp"

#include <boost/test/unit_test.hpp>

#include "resumed_run.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a run goes on with another experiment
//  * a checkpoint at the new end is gone on from
//  * a run that is complete goes on
//  * rows that were damaged are kept
//  * a checkpoint that was edited is gone on from (running/checkpoint.cpp)
BOOST_AUTO_TEST_SUITE(unfinished_run_test)

namespace {

const Json oscillator = Json::parse(R"json({
  "title": "Oscillator",
  "system": { "type": "hamiltonian", "parameters": { "k": 1, "m": 2 }, "coordinates": ["q"],
              "hamiltonian": "p_q^2/(2*m) + k*q^2/2" },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first" },
  "time": { "step": 0.1, "end": 10 },
  "observe": { "a": "q", "b": "q^2" },
  "output": { "epoch": 16 }
})json");

// A folder with a run that was interrupted after step 40.
class Interrupted {
 public:
  Interrupted() {
    class Stop final : public RunWatcher {
      std::optional<RunEnd> watch(const RunMoment& moment) override {
        if (moment.k < 40) return std::nullopt;
        return RunEnd{RunStatus::interrupted, "Interrupted after step 40."};
      }
    } stop;
    RunOptions options;
    options.watchers = {&stop};
    run_in(folder_, oscillator, options);
  }
  std::filesystem::path path() const { return folder_ / "run"; }
  std::filesystem::path operator/(const std::string& name) const { return path() / name; }

  void change(const std::string& file, const std::string& pointer, const Json& value) const {
    Json json = Json::parse(read_text(*this / file));
    json[Json::json_pointer(pointer)] = value;
    write_text(*this / file, json.dump());
  }

  // What is said of it, by the function and by a run, which changes nothing.
  std::string refusal(const Json& experiment = oscillator) const {
    std::string said;
    const std::string summary = read_text(*this / "summary.json"),
                      trajectory = read_text(*this / "trajectory.csv"),
                      begun = read_text(*this / "experiment.json");
    try {
      unfinished_run(path(), read_experiment(experiment.dump()));
    } catch (const std::exception& error) {
      said = error.what();
    }
    if (said == "") return said;
    try {
      resume_in(path(), experiment);
      BOOST_ERROR("it goes on: " << said);
    } catch (const std::exception& error) {
      BOOST_TEST(said == error.what());
    }
    BOOST_TEST(summary == read_text(*this / "summary.json"));
    BOOST_TEST((trajectory == read_text(*this / "trajectory.csv")));
    BOOST_TEST(begun == read_text(*this / "experiment.json"));
    return said.find(path().string() + "/") == 0 ? said.substr(path().string().size() + 1)
           : said.find(path().string()) == 0     ? said.substr(path().string().size())
                                                 : said;
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_run_that_was_interrupted_is_unfinished) {
  const Interrupted run;
  const UnfinishedRun found = unfinished_run(run.path(), read_experiment(oscillator.dump()));
  BOOST_TEST(found.id == Json::parse(read_text(run / "summary.json"))["id"]);
  BOOST_TEST_REQUIRE(found.checkpoint.has_value());
  BOOST_TEST(found.checkpoint->k == 32);
  std::filesystem::remove(run / "checkpoint.json");
  BOOST_TEST(!unfinished_run(run.path(), read_experiment(oscillator.dump())).checkpoint);
}

BOOST_AUTO_TEST_CASE(whatever_changed_but_the_end_is_refused_by_name) {
  const Interrupted run;
  const auto with = [](const char* pointer, const Json& value) {
    Json experiment = oscillator;
    experiment[Json::json_pointer(pointer)] = value;
    return experiment;
  };
  BOOST_TEST(run.refusal(with("/time/end", 20)) == "");
  BOOST_TEST(run.refusal(with("/time/end", 3.3)) == "");
  BOOST_TEST(run.refusal(with("/time/end", 3.2)) ==
             "/time/end: is 3.2; the run would go on from t = 3.2, expected a later one");
  BOOST_TEST(run.refusal(with("/time/step", 0.05)) ==
             "/time/step: is 0.05; the run was begun with 0.1");
  BOOST_TEST(run.refusal(with("/title", "Other")) ==
             "/title: is \"Other\"; the run was begun with \"Oscillator\"");
  BOOST_TEST(run.refusal(with("/output/epoch", 32)) ==
             "/output/epoch: is 32; the run was begun with 16");
  BOOST_TEST(run.refusal(with("/output/format", "npy")) ==
             "/output/format: is \"npy\"; the run was begun with \"csv\"");
  BOOST_TEST(run.refusal(with("/system/parameters/k", 1.5)) ==
             "/system/parameters/k: is 1.5; the run was begun with 1");
  BOOST_TEST(run.refusal(with("/expect", Json::array({{{"index", 0}}}))) ==
             "/expect: is [{\"index\":0}]; the run was begun without it");
  Json without = with("/initial/q", 2);
  without["observe"].erase("b");
  BOOST_TEST(run.refusal(without) ==
             "/initial/q: is 2; the run was begun with 1\n"
             "/observe/b: is missing; the run was begun with \"q^2\"");
}

BOOST_AUTO_TEST_CASE(a_folder_without_a_run_is_refused) {
  const Interrupted run;
  std::filesystem::remove(run / "experiment.json");
  BOOST_TEST(run.refusal() == ": there is no run in this folder that could go on");
  write_text(run / "experiment.json", oscillator.dump());  // somebody's, no run's
  BOOST_TEST(run.refusal() == ": there is no run in this folder that could go on");
  std::filesystem::remove_all(run.path());
  BOOST_TEST(run.refusal() == ": there is no run in this folder that could go on");
  BOOST_TEST(!std::filesystem::exists(run.path()));
}

BOOST_AUTO_TEST_CASE(a_run_that_is_complete_is_refused) {
  const TemporaryFolder folder;
  run_in(folder, oscillator);
  try {
    resume_in(folder / "run", oscillator);
    BOOST_ERROR("it goes on");
  } catch (const UnusableFolder& error) {
    BOOST_TEST(std::string(error.what()) ==
               (folder / "run").string() +
                   ": the run is complete up to t = 10; expected a later /time/end to go on to");
  }
}

BOOST_AUTO_TEST_CASE(files_that_are_not_those_of_the_run_are_refused) {
  const auto refusal = [](const auto& change) {
    const Interrupted run;
    change(run);
    return run.refusal();
  };
  BOOST_TEST(refusal([](const Interrupted& run) { run.change("summary.json", "/id", "1"); }) ==
             "summary.json: is of another run than experiment.json");
  const Interrupted other;
  BOOST_TEST(refusal([&](const Interrupted& run) {
               write_text(run / "checkpoint.json", read_text(other / "checkpoint.json"));
             }) == "checkpoint.json: is of another run than experiment.json");
  BOOST_TEST(refusal([](const Interrupted& run) {
               run.change("checkpoint.json", "/state/x/0", 0.5);
             }).starts_with("checkpoint.json: is not as it was written; "));
  BOOST_TEST(refusal([](const Interrupted& run) {
               run.change("checkpoint.json", "/courant", "0.0.1");
             }).starts_with("checkpoint.json: version 0.0.1 of courant wrote it, this is "));
  BOOST_TEST(refusal([](const Interrupted& run) {
               std::filesystem::resize_file(run / "trajectory.csv", 100);
             }).starts_with("trajectory.csv: rows 1 to "));
  BOOST_TEST(refusal([](const Interrupted& run) {
               std::filesystem::remove(run / "trajectory.csv");
             }) == "trajectory.csv: is not there; expected the file that the run wrote");
  BOOST_TEST(refusal([](const Interrupted& run) {
               std::string text = read_text(run / "trajectory.csv");
               write_text(run / "trajectory.csv", text.replace(200, 100, 100, '\0'));
             }).find(" is not as it was written; expected it whole") != std::string::npos);
  BOOST_TEST(refusal([](const Interrupted& run) {
               write_text(run / "checkpoint.json", "{");
             }).starts_with("checkpoint.json:1: is not JSON: "));
  BOOST_TEST(refusal([](const Interrupted& run) { write_text(run / "summary.json", "{}"); }) ==
             "summary.json: /status: is missing.");
}

// A kill between the files of one moment leaves a run that goes on.
BOOST_AUTO_TEST_CASE(files_that_a_kill_leaves_are_enough) {
  const Interrupted run;
  std::filesystem::remove(run / "summary.json");
  write_text(run / ".courant-0123456789abcdef", "{\"sta");
  BOOST_TEST(run.refusal() == "");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
