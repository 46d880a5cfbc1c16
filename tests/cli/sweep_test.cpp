#include "courant/cli/sweep.hpp"

#include <boost/test/unit_test.hpp>

#include "../core/files/temporary_folder.hpp"
#include "answer.hpp"
#include "courant/running/run_files.hpp"
#include "courant/tests/core/says.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(sweep_command)

namespace {

using test::Answer;
using test::courant_command;

const std::string oscillator = R"json({
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2" },
  "initial": { "q": 1, "p_q": 0 },
  "method": { "type": "discretize-first", "discretization": { "type": "theta", "theta": 0.5 } },
  "time": { "step": 0.1, "end": 1 },
  "expect": [ { "observable": "H", "max_drift": 1e-12 },
              { "state": { "q": "cos(t)", "p_q": "-sin(t)" }, "tolerance": 1 } ]
})json";

const std::string theta = "/method/discretization/theta";

}  // namespace

BOOST_AUTO_TEST_CASE(a_sweep_is_a_folder_of_runs_with_a_table_and_a_figure) {
  const TemporaryFolder folder;
  const std::string runs = (folder / "sweep").string();
  const Answer answer =
      courant_command({"run", "-", "-o", runs, "--backend", "interpreter", "--set", "/expect=[]",
                       "--sweep", theta + "=0:1:3", "--sweep", "/time/step=0.1,0.05"},
                      oscillator);
  BOOST_TEST(answer.status == 0, answer.err);
  BOOST_TEST(answer.err == "");
  BOOST_TEST(says(answer.out, "theta  step     status"), answer.out);
  BOOST_TEST(says(answer.out, "6 cases"), answer.out);
  BOOST_TEST(read_run(folder / "sweep" / "6-theta=1,step=0.05").trajectory.rows() == 21u);
  for (const char* file : {"sweep.csv", "sweep.json", "sweep.svg"})
    BOOST_TEST(std::filesystem::exists(folder / "sweep" / file), file);

  const Answer again =
      courant_command({"run", "-", "-o", runs, "--sweep", theta + "=0,1"}, oscillator);
  BOOST_TEST(again.status == 2);
  BOOST_TEST(says(again.err, "there is a sweep in this folder"), again.err);
  const Answer forced = courant_command({"run", "-", "-o", runs, "--force", "--backend",
                                         "interpreter", "--quiet", "--sweep", theta + "=0.5"},
                                        oscillator);
  BOOST_TEST(forced.status == 0, forced.err);
  BOOST_TEST(forced.out == "");
  BOOST_TEST(!std::filesystem::exists(folder / "sweep" / "6-theta=1,step=0.05"));
  BOOST_TEST(std::filesystem::exists(folder / "sweep" / "1-theta=0.5" / "summary.json"));
}

BOOST_AUTO_TEST_CASE(runs_that_fail_are_said_and_the_others_are_made) {
  const TemporaryFolder folder;
  const Answer answer = courant_command({"run", "-", "-o", (folder / "sweep").string(), "--backend",
                                         "interpreter", "--sweep", theta + "=0.5,1,7"},
                                        oscillator);
  BOOST_TEST(answer.status == 3);
  BOOST_TEST(says(answer.out, "not as expected"), answer.out);
  BOOST_TEST(says(answer.err, "courant: -: " + theta + "=1: /expect/0: "), answer.err);
  BOOST_TEST(says(answer.err, "courant: -: " + theta + "=7: " + theta + ": is 7; expected"),
             answer.err);
  BOOST_CHECK(read_run(folder / "sweep" / "1-theta=0.5").summary.status == RunStatus::completed);
}

BOOST_AUTO_TEST_CASE(nothing_is_written_where_nothing_can_be_run) {
  const TemporaryFolder folder;
  const std::string runs = (folder / "sweep").string();
  for (const std::string& sweep :
       {theta + "=7,8", std::string("/tim/step=1,2"), std::string("x=1")}) {
    const Answer answer = courant_command({"run", "-", "-o", runs, "--sweep", sweep}, oscillator);
    BOOST_TEST(answer.status == 2, sweep);
    BOOST_TEST(answer.err.find("courant: -: ") == 0u, answer.err);
    BOOST_TEST(!std::filesystem::exists(folder / "sweep"));
  }
  BOOST_TEST(courant_command({"run", "-", "--explain", "--sweep", "/a=1"}, oscillator).status == 2);
  BOOST_TEST(courant_command({"run", "-", "--jobs", "2"}, oscillator).status == 2);
}

BOOST_AUTO_TEST_CASE(an_interrupt_has_its_status) {
  const TemporaryFolder folder;
  const std::atomic<bool> stop{true};
  const Answer answer =
      courant_command({"run", "-", "-o", (folder / "sweep").string(), "--sweep", theta + "=0,1"},
                      oscillator, &stop);
  BOOST_TEST(answer.status == 130);
  BOOST_TEST(read_json(folder / "sweep" / "sweep.json")["status"] == "interrupted");
}

BOOST_AUTO_TEST_CASE(constraints_are_swept) {
  const TemporaryFolder folder;
  const std::string file = (folder / "sweep").string();
  const Answer answer =
      courant_command({"constraints", "-", "--sweep", "/initial/q=0:2:3", "-o", file}, oscillator);
  BOOST_TEST(answer.status == 0, answer.err);
  BOOST_TEST(says(answer.out, "(2 2)"), answer.out);
  BOOST_TEST(std::filesystem::exists(folder / "sweep" / "sweep.csv"));
  const Answer json =
      courant_command({"constraints", "-", "--sweep", "/initial/q=0:2:3", "--json"}, oscillator);
  BOOST_TEST(Json::parse(json.out)["runs"][2]["values"]["verdict"] == "regular");
}

BOOST_AUTO_TEST_CASE(a_study_shows_errors_and_orders) {
  const TemporaryFolder folder;
  const std::vector<std::string> study = {"study", "-", "--backend", "interpreter"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), study.begin(), study.end());
    return courant_command(more, oscillator);
  };
  const Answer text =
      with({"--method", "rk2", "--method", "rk4", "-o", (folder / "study").string()});
  BOOST_TEST(text.status == 0, text.err);
  for (const char* part : {"stdin: rk2", "stdin: rk4", "order ", "reference: closed form",
                           "The error is the greatest distance of (q, p_q) from the reference."})
    BOOST_TEST(says(text.out, part), part << " is not in\n" << text.out);
  for (const char* file : {"study.csv", "study.json", "study.svg"})
    BOOST_TEST(std::filesystem::exists(folder / "study" / file), file);
  BOOST_TEST(with({"-o", (folder / "study").string()}).status == 2);
  BOOST_TEST(with({"-o", (folder / "study").string(), "--force"}).status == 0);

  const Answer json = with({"--json", "--steps", "3", "--of", "q"});
  const Json found = Json::parse(json.out);
  BOOST_TEST(found["reference"] == "closed form");
  BOOST_TEST(found["quantities"] == Json::array({"q"}));
  BOOST_TEST(found["methods"][0]["rows"].size() == 3u);
  BOOST_TEST(std::abs(found["methods"][0]["order"].get<double>() - 2.0) < 0.1);

  const Answer unknown = with({"--of", "qq"});
  BOOST_TEST(unknown.status == 2);
  BOOST_TEST(says(unknown.err, "--of qq: there is no such quantity (did you mean \"q\"?)"),
             unknown.err);
  BOOST_TEST(with({"--method", "rk5"}).status == 2);
}

BOOST_AUTO_TEST_CASE(studies_are_swept) {
  const TemporaryFolder folder;
  const Answer answer =
      courant_command({"study", "-", "--backend", "interpreter", "--sweep",
                       "/method=rk2,rk4,dopri5", "-o", (folder / "sweep").string()},
                      oscillator);
  BOOST_TEST(answer.status == 0, answer.err);
  const Json table = read_json(folder / "sweep" / "sweep.json");
  for (const auto& [i, order] : {std::pair(0, 2.0), std::pair(1, 4.0)})
    BOOST_TEST(
        std::abs(table["runs"][static_cast<std::size_t>(i)]["values"]["order"].get<double>() -
                 order) < 0.15);
  BOOST_TEST(std::filesystem::exists(folder / "sweep" / "1-method=rk2" / "study.csv"));
  // Replaced as a whole.
  const Answer again =
      courant_command({"study", "-", "--backend", "interpreter", "--force", "--sweep",
                       "/method=rk2", "-o", (folder / "sweep").string()},
                      oscillator);
  BOOST_TEST(again.status == 0, again.err);
  BOOST_TEST(!std::filesystem::exists(folder / "sweep" / "2-method=rk4"));
}

// A table of cases, in two parts, one of which goes on after an interrupt: the bytes of one process.
BOOST_AUTO_TEST_CASE(cases_of_a_table_in_parts_that_are_joined) {
  const TemporaryFolder folder;
  const std::string cases = (folder / "cases.csv").string();
  std::string text = theta + ",/initial/q\n";
  for (int i = 0; i < 12; ++i)
    text += std::to_string(0.5 + i / 40.0) + "," + std::to_string(i) + "\n";
  write_text(cases, text);
  const auto sweep = [&](const std::string& name, std::vector<std::string> more,
                         const std::atomic<bool>* stop = nullptr) {
    std::vector<std::string> words = {"run",       "-",           "-o",    (folder / name).string(),
                                      "--backend", "interpreter", "--set", "/expect=[]",
                                      "--quiet",   "--sweep",     cases};
    words.insert(words.end(), more.begin(), more.end());
    return courant_command(words, oscillator, stop);
  };
  BOOST_TEST(sweep("whole", {}).status == 0);
  const std::atomic<bool> stop{true};
  BOOST_TEST(sweep("one", {"--shard", "1/2"}, &stop).status == 130);
  const std::vector<std::string> merge = {"sweep",
                                          "--merge",
                                          (folder / "one").string(),
                                          (folder / "two").string(),
                                          "-o",
                                          (folder / "both").string()};
  BOOST_TEST(sweep("two", {"--shard", "2/2"}).status == 0);
  const Answer unfinished = courant_command(merge, "");
  BOOST_TEST(unfinished.status == 2);
  BOOST_TEST(says(unfinished.err, "shard 1/2 is interrupted"), unfinished.err);
  const Answer other = sweep("one", {"--shard", "2/2", "--resume"});
  BOOST_TEST(other.status == 2);
  BOOST_TEST(says(other.err, "the sweep in this folder is another one"), other.err);
  BOOST_TEST(sweep("one", {"--shard", "1/2", "--resume"}).status == 0);
  const Answer merged = courant_command(merge, "");
  BOOST_TEST(merged.status == 0, merged.err);
  for (const char* file : {"sweep.csv", "sweep.json", "sweep.svg"})
    BOOST_TEST(read_text(folder / "both" / file) == read_text(folder / "whole" / file), file);
  const Json table = read_json(folder / "both" / "sweep.json");
  for (const Json& row : table["runs"]) {
    const std::string run = row["folder"];
    BOOST_TEST(read_text(folder / "both" / run / "trajectory.csv") ==
               read_text(folder / "whole" / run / "trajectory.csv"));
  }
  // A page and figures of its runs.
  const Answer page = courant_command({"report", (folder / "both").string()}, "");
  BOOST_TEST(page.status == 0, page.err);
  BOOST_TEST(says(page.out, "12-theta"), page.out);
  const Answer figure = courant_command({"plot", (folder / "both").string(), "--figure", "phase",
                                         "-o", (folder / "phase.svg").string()},
                                        "");
  BOOST_TEST(figure.status == 0, figure.err);
}

BOOST_AUTO_TEST_CASE(slips_are_refused) {
  const TemporaryFolder folder;
  const auto refused = [&](std::vector<std::string> words, const std::string& what) {
    words.insert(words.begin(), {"run", "-", "-o", (folder / "none").string()});
    const Answer answer = courant_command(words, oscillator);
    BOOST_TEST(answer.status == 2);
    BOOST_TEST(says(answer.err, what), answer.err);
  };
  refused({"--sweep", "cases"}, "--sweep cases: is no file");
  refused({"--sweep", theta + "=0,1", "--shard", "3/2"}, "--shard 3/2: is no part");
  refused({"--set", "/system/parameters={\"k\": 1}", "--set", "/system/parameters/kk=2"},
          "--set /system/parameters/kk: nothing uses the parameter \"kk\"");
  BOOST_TEST(!std::filesystem::exists(folder / "none"));
}

BOOST_AUTO_TEST_CASE(a_setting_of_a_method_in_its_short_form) {
  const TemporaryFolder folder;
  const Answer answer =
      courant_command({"run", "-", "-o", (folder / "run").string(), "--backend", "interpreter",
                       "--set", "/expect=[]", "--set", "/method=discretize-first", "--set",
                       "/method/discretization=midpoint"},
                      oscillator);
  BOOST_TEST(answer.status == 0, answer.err);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
