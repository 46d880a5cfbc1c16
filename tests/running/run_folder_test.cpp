#include "courant/running/run_folder.hpp"

#include <boost/test/unit_test.hpp>

#include "run_in.hpp"

namespace courant {
namespace {

const Json experiment = {{"title", "one"}};
const Json summary = {{"status", "completed"}, {"ladder", Json::object()}};

std::string refusal(const std::filesystem::path& path, bool replace) {
  std::string first;
  try {
    RunFolder::check(path, replace);
  } catch (const UnusableFolder& error) {
    first = error.what();
  }
  try {
    const RunFolder folder(path, replace, experiment);
  } catch (const UnusableFolder& error) {
    BOOST_TEST(first == error.what());
    return first;
  }
  BOOST_TEST(first == "");
  return "";
}

}  // namespace

BOOST_AUTO_TEST_SUITE(run_folder)

BOOST_AUTO_TEST_CASE(a_run_is_replaced_only_if_it_may_be) {
  const TemporaryFolder folder;
  const auto path = folder / "a" / "run";
  RunFolder::check(path, false);
  BOOST_TEST(!std::filesystem::exists(folder / "a"));
  std::string id;
  {
    const RunFolder run(path, false, experiment);
    run.write_summary(summary);
    id = run.id();
    BOOST_TEST(Json::parse(read_text(path / "experiment.json"))["$run"] == id);
  }
  write_text(path / "notes.txt", "mine");
  BOOST_TEST(refusal(path, false).find("there is a run in this folder") != std::string::npos);
  const RunFolder again(path, true, experiment);
  BOOST_TEST(again.id() != id);
  BOOST_TEST(!std::filesystem::exists(path / "summary.json"));
  BOOST_TEST(read_text(path / "notes.txt") == "mine");
}

BOOST_AUTO_TEST_CASE(a_folder_belongs_to_one_run_at_a_time) {
  const TemporaryFolder folder;
  const auto path = folder / "run";
  BOOST_TEST(!RunFolder::is_in_use(path));
  {
    const RunFolder run(path, false, experiment);
    BOOST_TEST(RunFolder::is_in_use(path));
    for (const bool replace : {false, true})
      BOOST_TEST(refusal(path, replace).find("another run is being written") != std::string::npos);
  }
  BOOST_TEST(!RunFolder::is_in_use(path));
  BOOST_TEST(refusal(path, true) == "");
}

// An experiment that somebody keeps in the folder is not the copy of a run.
BOOST_AUTO_TEST_CASE(what_no_run_wrote_is_never_removed) {
  const TemporaryFolder folder;
  const auto path = folder / "mine";
  write_text(path / "experiment.json", "{\"title\": \"mine\"}");
  for (const bool replace : {false, true})
    BOOST_TEST(refusal(path, replace).find("no run wrote it") != std::string::npos);
  BOOST_TEST(read_text(path / "experiment.json") == "{\"title\": \"mine\"}");
}

BOOST_AUTO_TEST_CASE(a_folder_that_cannot_be_made_is_refused) {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  BOOST_TEST(refusal(folder / "file" / "run", false)
                 .ends_with("the folder cannot be made: Not a directory"));
}

// Before the constraint algorithm, which may take long and here would be an error of its own.
BOOST_AUTO_TEST_CASE(a_folder_is_refused_before_anything_is_computed) {
  const TemporaryFolder folder;
  write_text(folder / "run" / "summary.json", summary.dump());
  const Json nowhere = {
      {"system", {{"type", "hamiltonian"}, {"coordinates", {"q"}}, {"hamiltonian", "1/q"}}},
      {"initial", {{"q", 0}, {"p_q", 0}}}};
  BOOST_CHECK_THROW(run_in(folder, nowhere), UnusableFolder);
}

// The experiment of a run is one that can be run.
BOOST_AUTO_TEST_CASE(the_experiment_of_a_run_runs_again) {
  const TemporaryFolder folder, other;
  const Json oscillator = {
      {"system",
       {{"type", "hamiltonian"}, {"coordinates", {"q"}}, {"hamiltonian", "(p_q^2 + q^2)/2"}}},
      {"initial", {{"q", 1}, {"p_q", 0}}},
      {"method", "discretize-first"},
      {"time", {{"step", 0.1}, {"end", 1}}}};
  const Json first = run_in(folder, oscillator).summary;
  const Json second =
      run_in(other, Json::parse(read_text(folder / "run" / "experiment.json"))).summary;
  BOOST_TEST(first["final"] == second["final"]);
  BOOST_TEST(first["id"] != second["id"]);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
