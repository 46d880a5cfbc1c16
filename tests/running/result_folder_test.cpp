#include "courant/running/result_folder.hpp"

#include <boost/test/unit_test.hpp>

#include "../core/files/temporary_folder.hpp"
#include "courant/running/run_folder.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * --force goes up and removes runs elsewhere
BOOST_AUTO_TEST_SUITE(result_folder)

namespace {

const Json one_run = {
    {"status", "completed"},
    {"runs", {{{"folder", "1-k=1"}}, {{"folder", ""}}, {{"folder", "../other"}}}}};

void write_run(const std::filesystem::path& folder) {
  Experiment experiment;
  experiment.document = Json::object();
  RunFolder run(folder, ExistingRun::refuse, experiment);
  run.write_summary({.status = RunStatus::completed, .ladder = LadderReport()});
}

std::string refusal(const std::filesystem::path& path, bool replace = false) {
  try {
    ResultFolder::check(path, "sweep", replace);
  } catch (const UnusableFolder& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_CASE(an_earlier_one_is_replaced_with_its_runs_and_nothing_else) {
  const TemporaryFolder temporary;
  const auto path = temporary / "sweep";
  ResultFolder(path, "sweep", false).write(one_run, "folder\n");
  write_run(path / "1-k=1");
  write_run(temporary / "other");
  write_run(path / "mine");
  write_text(path / "notes.txt", "mine");
  BOOST_TEST(refusal(path).find("there is a sweep in this folder; expected another folder (-o), or "
                                "--force to replace it") != std::string::npos);
  BOOST_CHECK_THROW(ResultFolder(path, "sweep", false), UnusableFolder);
  BOOST_TEST(std::filesystem::exists(path / "1-k=1" / "summary.json"));
  BOOST_TEST(refusal(path, true) == "");
  const ResultFolder again(path, "sweep", true);
  BOOST_TEST(!std::filesystem::exists(path / "1-k=1"));
  BOOST_TEST(!std::filesystem::exists(path / "sweep.json"));
  BOOST_TEST(std::filesystem::exists(path / "mine" / "summary.json"));
  BOOST_TEST(std::filesystem::exists(path / "notes.txt"));
  BOOST_TEST(std::filesystem::exists(temporary / "other" / "summary.json"));
}

BOOST_AUTO_TEST_CASE(a_run_with_something_else_in_it_keeps_that) {
  const TemporaryFolder temporary;
  const auto path = temporary / "sweep";
  ResultFolder(path, "sweep", false).write(one_run, "");
  write_run(path / "1-k=1");
  write_text(path / "1-k=1" / "notes.txt", "mine");
  const ResultFolder again(path, "sweep", true);
  BOOST_TEST(!std::filesystem::exists(path / "1-k=1" / "summary.json"));
  BOOST_TEST(std::filesystem::exists(path / "1-k=1" / "notes.txt"));
}

// A run that was put elsewhere, to be kept.
BOOST_AUTO_TEST_CASE(of_a_link_to_a_run_the_link_alone_is_removed) {
  const TemporaryFolder temporary;
  const auto path = temporary / "sweep";
  ResultFolder(path, "sweep", false).write(one_run, "");
  write_run(temporary / "kept");
  std::filesystem::create_directory_symlink("../kept", path / "1-k=1");
  const ResultFolder again(path, "sweep", true);
  BOOST_TEST(!std::filesystem::is_symlink(path / "1-k=1"));
  BOOST_TEST(std::filesystem::exists(temporary / "kept" / "summary.json"));
}

BOOST_AUTO_TEST_CASE(folders_that_cannot_be_used_are_refused) {
  const TemporaryFolder temporary;
  write_text(temporary / "foreign" / "sweep.json", "[1, 2]");
  BOOST_TEST(refusal(temporary / "foreign", true).find("no sweep wrote it") != std::string::npos);
  write_text(temporary / "file", "");
  BOOST_TEST(refusal(temporary / "file" / "sweep").find("cannot be made") != std::string::npos);
  const ResultFolder held(temporary / "held", "sweep", false);
  BOOST_TEST(refusal(temporary / "held").find("is being written") != std::string::npos);
  BOOST_CHECK_THROW(ResultFolder(temporary / "held", "study", true), UnusableFolder);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
