#include "courant/cli/ensemble.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "../core/files/temporary_folder.hpp"
#include "answer.hpp"
#include "courant/reading/findings.hpp"
#include "courant/tests/core/says.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a sweep of an ensemble sweeps one member (cli/sweep.cpp)
//  * --jobs of a single run is taken and does nothing (cli/run.cpp)
//  * members that failed leave the exit status 0 (cli/ensemble.cpp)
BOOST_AUTO_TEST_SUITE(ensemble_command)

namespace {

using test::Answer;
using test::courant_command;

const std::string oscillators = R"json({
  "title": "Oscillators",
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + k*q^2)/2", "parameters": { "k": 1 } },
  "initial": { "q": 1, "p_q": 0 },
  "ensemble": { "values": { "q": [1, 2, 4], "k": "1 + i" } },
  "method": "discretize-first",
  "time": { "step": 0.1, "end": 1 },
  "expect": [ { "observable": "H", "max_drift": 1e-12 } ]
})json";

Answer run(const std::string& folder, std::vector<std::string> more = {},
           const std::string& text = oscillators) {
  std::vector<std::string> arguments = {"run", "-", "-o", folder};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return courant_command(arguments, text);
}

}  // namespace

BOOST_AUTO_TEST_CASE(an_ensemble_is_a_folder_with_its_spread) {
  const TemporaryFolder folder;
  const std::string there = (folder / "ensemble").string();
  const Answer answer = run(there, {"--jobs", "2"});
  BOOST_TEST(answer.status == 0, answer.err);
  BOOST_TEST(answer.err == "");
  for (const char* part : {"at the end", "max |H - H(0)|", "3 of 3 members",
                           "greatest drift of H, every member", "completed; files in "})
    BOOST_TEST(says(answer.out, part), answer.out);
  for (const char* file : {"ensemble.npy", "columns.json", "summary.json", "members.jsonl",
                           "statistics.csv", "experiment.json"})
    BOOST_TEST(std::filesystem::exists(folder / "ensemble" / file), file);
  const Json summary = Json::parse(read_text(folder / "ensemble/summary.json"));
  BOOST_TEST(summary["members"] == 3);
  BOOST_TEST(summary["member_steps_per_cpu_second"].is_number());
  // Its experiment.json is an experiment with the same members.
  const std::string numbers = read_text(folder / "ensemble/ensemble.npy");
  const Answer again =
      run((folder / "again").string(), {"--quiet"}, read_text(folder / "ensemble/experiment.json"));
  BOOST_TEST(again.status == 0, again.err);
  BOOST_TEST(again.out == "");
  BOOST_TEST((read_text(folder / "again/ensemble.npy") == numbers));

  BOOST_TEST(run(there).status == 2);
  BOOST_TEST(says(run(there).err, "there is a run in this folder"));
  BOOST_TEST(says(run(there, {"--resume"}).err, "the run is complete"));
  BOOST_TEST(run(there, {"--force", "--quiet"}).status == 0);

  const std::string figure = (folder / "spread.svg").string();
  BOOST_TEST(courant_command({"plot", there, "--figure", "ensemble", "-o", figure}).status == 0);
  BOOST_TEST(says(read_text(folder / "spread.svg"), "standard deviation"));
  const Answer report = courant_command({"report", there});
  BOOST_TEST(report.status == 2);
  BOOST_TEST(says(report.err, "has an ensemble of many runs; expected the folder of one"),
             report.err);
}

BOOST_AUTO_TEST_CASE(a_run_of_one_member_takes_the_place_of_an_ensemble_and_back) {
  const TemporaryFolder folder;
  const std::string there = (folder / "run").string();
  Json alone = Json::parse(oscillators);
  alone.erase("ensemble");
  BOOST_TEST(run(there, {"--quiet"}).status == 0);
  BOOST_TEST(run(there, {"--quiet", "--force"}, alone.dump()).status == 0);
  BOOST_TEST(!std::filesystem::exists(folder / "run/ensemble.npy"));
  BOOST_TEST(run(there, {"--quiet", "--force"}).status == 0);
  BOOST_TEST(!std::filesystem::exists(folder / "run/trajectory.csv"));
}

BOOST_AUTO_TEST_CASE(members_that_fail_are_told_of_in_lines) {
  const TemporaryFolder folder;
  const Answer answer =
      run((folder / "e").string(), {"--quiet", "--set", "/system/hamiltonian=p_q^2/2 + k*sqrt(q)",
                                    "--set", "/ensemble/values/q=[1, -1, 4]"});
  BOOST_TEST(answer.status == 3);
  BOOST_TEST(says(answer.err, "courant: -: /ensemble: member 1: "), answer.err);
  BOOST_TEST(says(answer.err, "courant: -: 1 of 3 members did not complete."), answer.err);
  const Answer expected =
      run((folder / "f").string(), {"--quiet", "--set", "/expect/0/max_drift=0"});
  BOOST_TEST(expected.status == 3);
  BOOST_TEST(says(expected.err, "/expect/0: greatest drift of H, every member: member "),
             expected.err);
}

BOOST_AUTO_TEST_CASE(what_does_not_go_together_is_refused_in_a_line) {
  const TemporaryFolder folder;
  const std::string there = (folder / "e").string();
  const auto refusal = [&](const std::vector<std::string>& more) {
    const Answer answer = run(there, more);
    BOOST_TEST(answer.status == 2, answer.err);
    BOOST_TEST(std::ranges::count(answer.err, '\n') == 1, answer.err);
    BOOST_TEST(!std::filesystem::exists(folder / "e"));
    return answer.err;
  };
  BOOST_TEST(
      says(refusal({"--sweep", "/time/step=0.1,0.05"}), "/ensemble: has many starts already"));
  BOOST_TEST(says(refusal({"--explain"}), "--explain is of one run"));
  BOOST_TEST(says(refusal({"--set", "/ensemble/values/r=1"}), "/ensemble/values/r: is neither"));
  BOOST_TEST(says(refusal({"--set", "/ensemble={\"table\": \"none.csv\"}"}),
                  "/ensemble/table: none.csv cannot be read"));
  BOOST_TEST(says(refusal({"--untrusted", "--set", "/ensemble={\"table\": \"/etc/passwd\"}"}),
                  "not trusted"));
  Json alone = Json::parse(oscillators);
  alone.erase("ensemble");
  const Answer jobs = run(there, {"--jobs", "2"}, alone.dump());
  BOOST_TEST(jobs.status == 2);
  BOOST_TEST(says(jobs.err, "--jobs is of a sweep or an ensemble"), jobs.err);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
