#include "courant/running/run_folder.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/core/files/own_file.hpp"
#include "run_in.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a run writes into the folder of another (running/locked_folder.cpp)
//  * a folder whose name is too long is refused after the computation (running/locked_folder.cpp)
//  * the attempt to make a folder leaves folders (running/locked_folder.cpp)
BOOST_AUTO_TEST_SUITE(run_folder)

namespace {

Experiment titled(const char* title) {
  Experiment experiment;
  experiment.document = {{"title", title}};
  return experiment;
}
const Experiment experiment = titled("one");
const RunSummary summary{.status = RunStatus::completed, .ladder = LadderReport()};

std::string refusal(const std::filesystem::path& path, ExistingRun existing) {
  std::string first;
  try {
    RunFolder::check(path, existing, experiment);
  } catch (const UnusableFolder& error) {
    first = error.what();
  }
  try {
    const RunFolder folder(path, existing, experiment);
  } catch (const UnusableFolder& error) {
    BOOST_TEST(first == error.what());
    return first;
  }
  BOOST_TEST(first == "");
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_run_is_replaced_only_if_it_may_be) {
  const TemporaryFolder folder;
  const auto path = folder / "a" / "run";
  RunFolder::check(path, ExistingRun::refuse, experiment);
  BOOST_TEST(!std::filesystem::exists(folder / "a"));
  std::string id;
  {
    RunFolder run(path, ExistingRun::refuse, experiment);
    run.write_summary(summary);
    id = run.id();
    BOOST_TEST(Json::parse(read_text(path / "experiment.json"))["$run"] == id);
  }
  write_text(path / "notes.txt", "mine");
  BOOST_TEST(refusal(path, ExistingRun::refuse).find("there is a run in this folder") !=
             std::string::npos);
  const RunFolder again(path, ExistingRun::replace, experiment);
  BOOST_TEST(again.id() != id);
  BOOST_TEST(!std::filesystem::exists(path / "summary.json"));
  BOOST_TEST(read_text(path / "notes.txt") == "mine");
}

BOOST_AUTO_TEST_CASE(a_folder_belongs_to_one_run_at_a_time) {
  const TemporaryFolder folder;
  const auto path = folder / "run";
  BOOST_TEST(!LockedFolder::is_in_use(path));
  {
    const RunFolder run(path, ExistingRun::refuse, experiment);
    BOOST_TEST(LockedFolder::is_in_use(path));
    for (const ExistingRun existing :
         {ExistingRun::refuse, ExistingRun::replace, ExistingRun::resume})
      BOOST_TEST(refusal(path, existing).find("another run is being written") != std::string::npos);
  }
  BOOST_TEST(!LockedFolder::is_in_use(path));
  BOOST_TEST(refusal(path, ExistingRun::replace) == "");
}

// An experiment that somebody keeps in the folder is not the copy of a run.
BOOST_AUTO_TEST_CASE(what_no_run_wrote_is_never_removed) {
  const TemporaryFolder folder;
  const auto path = folder / "mine";
  write_text(path / "experiment.json", "{\"title\": \"mine\"}");
  for (const ExistingRun existing : {ExistingRun::refuse, ExistingRun::replace})
    BOOST_TEST(refusal(path, existing).find("no run wrote it") != std::string::npos);
  BOOST_TEST(read_text(path / "experiment.json") == "{\"title\": \"mine\"}");
}

// A run writes a trajectory in one format, and a report is ours if it has our mark.
BOOST_AUTO_TEST_CASE(files_beside_a_run_that_it_did_not_write_are_kept) {
  const TemporaryFolder folder;
  const auto path = folder / "run";
  { const RunFolder run(path, ExistingRun::refuse, experiment); }
  write_text(path / "report.html", "<p>mine</p>\n");
  BOOST_TEST(refusal(path, ExistingRun::replace) == "");
  BOOST_TEST(read_text(path / "report.html") == "<p>mine</p>\n");
  OwnFiles("report", true).write(path / "report.html", "<p>ours</p>\n");
  BOOST_TEST(refusal(path, ExistingRun::replace) == "");
  BOOST_TEST(!std::filesystem::exists(path / "report.html"));
  for (const char* name : {"trajectory.npy", "events.csv"}) {
    write_text(path / name, "mine");
    BOOST_TEST(refusal(path, ExistingRun::replace).find("no run wrote it") != std::string::npos);
    BOOST_TEST(read_text(path / name) == "mine");
    std::filesystem::remove(path / name);
  }
}

// Two runs that had the folder one after the other: neither writes into the other's.
BOOST_AUTO_TEST_CASE(a_folder_that_was_made_again_is_not_written_to) {
  const TemporaryFolder folder;
  const auto path = folder / "run";
  RunFolder first(path, ExistingRun::refuse, experiment);
  std::filesystem::rename(path, folder / "moved");
  BOOST_CHECK_THROW(first.write_summary(summary), OutputError);
  RunFolder second(path, ExistingRun::refuse, experiment);
  BOOST_CHECK_THROW(first.write_summary(summary), OutputError);
  BOOST_CHECK_THROW(first.write_checkpoint({.run = first.id()}), OutputError);
  BOOST_TEST(!std::filesystem::exists(path / "summary.json"));
  second.write_summary(summary);
}

BOOST_AUTO_TEST_CASE(a_folder_that_cannot_be_made_is_refused) {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  BOOST_TEST(refusal(folder / "file" / "run", ExistingRun::refuse)
                 .ends_with("the folder cannot be made: Not a directory"));
  // Only the attempt tells of this one; what it made is gone again.
  const auto check = [&](const std::string& name) {
    RunFolder::check(folder / "runs" / name, ExistingRun::refuse, experiment);
  };
  BOOST_CHECK_EXCEPTION(check(std::string(300, 'x')), UnusableFolder, [](const auto& error) {
    return std::string(error.what()).ends_with("the folder cannot be made: File name too long");
  });
  BOOST_TEST(!std::filesystem::exists(folder / "runs"));
  check("one");
  BOOST_TEST(!std::filesystem::exists(folder / "runs"));
}

// The run that goes on is the same run; killed before it reached an epoch, it has no checkpoint.
BOOST_AUTO_TEST_CASE(a_run_goes_on_in_its_folder) {
  const TemporaryFolder folder;
  const auto path = folder / "run";
  BOOST_TEST(refusal(path, ExistingRun::resume).find("there is no run") != std::string::npos);
  BOOST_TEST(!std::filesystem::exists(path));
  const std::string id = RunFolder(path, ExistingRun::refuse, experiment).id();
  const RunFolder again(path, ExistingRun::resume, experiment);
  BOOST_TEST(again.id() == id);
  BOOST_TEST(!again.checkpoint());
  BOOST_TEST(Json::parse(read_text(path / "experiment.json"))["$run"] == id);
}

BOOST_AUTO_TEST_CASE(a_run_does_not_go_on_with_another_experiment) {
  const TemporaryFolder folder;
  const auto path = folder / "run";
  { const RunFolder begun(path, ExistingRun::refuse, experiment); }
  const std::string before = read_text(path / "experiment.json");
  BOOST_CHECK_THROW(RunFolder::check(path, ExistingRun::resume, titled("two")), ExperimentError);
  BOOST_CHECK_THROW(RunFolder(path, ExistingRun::resume, titled("two")), ExperimentError);
  BOOST_TEST(!LockedFolder::is_in_use(path));
  BOOST_TEST(read_text(path / "experiment.json") == before);
}

// A kill while the first file is written leaves nothing but that.
BOOST_AUTO_TEST_CASE(what_a_kill_leaves_at_the_beginning_is_no_run) {
  const TemporaryFolder folder;
  const auto path = folder / "run";
  const auto left = path / ".courant-0123456789abcdef", mine = path / ".courant-mine";
  write_text(left, "{\"tit");
  write_text(mine, "mine");
  BOOST_TEST(refusal(path, ExistingRun::resume).find("there is no run") != std::string::npos);
  BOOST_TEST(refusal(path, ExistingRun::refuse) == "");
  BOOST_TEST(!std::filesystem::exists(left));
  BOOST_TEST(std::filesystem::exists(mine));
}

// Before the constraint algorithm, which may take long and here would be an error of its own.
BOOST_AUTO_TEST_CASE(a_folder_is_refused_before_anything_is_computed) {
  const TemporaryFolder folder;
  write_text(folder / "run" / "summary.json", to_json(summary).dump());
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
  const RunSummary first = run_in(folder, oscillator).summary;
  const RunSummary second =
      run_in(other, Json::parse(read_text(folder / "run" / "experiment.json"))).summary;
  BOOST_TEST((first.final == second.final));
  BOOST_TEST(first.id != second.id);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
