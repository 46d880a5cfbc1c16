#include "courant/cli/command.hpp"

#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <sstream>

#include "../core/files/temporary_folder.hpp"
#include "answer.hpp"
#include "courant/core/expressions/native.hpp"
#include "courant/core/words/text_layout.hpp"
#include "courant/running/run_files.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a run that failed exits with 0 (cli/run.cpp)
//  * an interrupt exits with 0 (cli/run.cpp)
//  * what was not as expected exits with 0 (cli/run.cpp)
//  * a wrong experiment exits with 0 (cli/experiment_file.cpp)
//  * help that is lost is not told
//  * an empty name of a folder means the default one
//  * descriptions go on at the left edge (cli/help_formatter.cpp)
//  * lists of kinds are one word (cli/help_formatter.cpp)
BOOST_AUTO_TEST_SUITE(command)

namespace {

using test::Answer;
using test::courant_command;

const std::string oscillator = R"json({
  "title": "Oscillator",
  "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2" },
  "initial": { "q": 1, "p_q": 0 },
  "method": "discretize-first",
  "time": { "step": 0.1, "end": 1 },
  "expect": [ { "observable": "H", "max_drift": 1e-12 } ]
})json";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

BOOST_AUTO_TEST_CASE(runs_a_file) {
  const TemporaryFolder folder;
  const std::string file = (folder / "oscillator.json").string(), runs = (folder / "run").string();
  write_text(file, oscillator);
  const Answer answer = courant_command({"run", file, "-o", runs, "--backend", "interpreter"});
  BOOST_TEST(answer.status == 0, answer.err);
  BOOST_TEST(answer.err == "");
  for (const char* part :
       {"Oscillator", "(dim S, dim M): (2, 2)", "Regular.", "passed", "10 steps of 0.1"})
    BOOST_TEST(answer.out.find(part) != std::string::npos, part << " is not in\n" << answer.out);
  BOOST_TEST(read_run(runs).trajectory.rows() == 11u);

  const Answer again = courant_command({"run", file, "-o", runs});
  BOOST_TEST(again.status == 2);
  BOOST_TEST(again.err == "courant: " + runs +
                              ": there is a run in this folder; expected another folder (-o), "
                              "--force to replace it, or --resume to go on with it\n");
  const Answer forced =
      courant_command({"run", file, "-o", runs, "--force", "--quiet", "--backend", "interpreter"});
  BOOST_TEST(forced.status == 0);
  BOOST_TEST(forced.out == "");
}

BOOST_AUTO_TEST_CASE(goes_on_with_a_run) {
  const TemporaryFolder folder;
  const std::string runs = (folder / "run").string();
  const auto resume = [&](const char* setting) {
    return courant_command({"run", "-", "-o", runs, "--backend", "interpreter", "--resume", "--set",
                            "/output={\"epoch\": 4}", "--set", setting},
                           oscillator);
  };
  const Answer nothing = resume("/time/end=1");
  BOOST_TEST(nothing.status == 2);
  BOOST_TEST(nothing.err ==
             "courant: " + runs + ": there is no run in this folder that could go on\n");
  BOOST_TEST(courant_command({"run", "-", "-o", runs, "--backend", "interpreter", "--quiet",
                              "--set", "/output={\"epoch\": 4}"},
                             oscillator)
                 .status == 0);
  BOOST_TEST(resume("/time/end=1").err ==
             "courant: " + runs +
                 ": the run is complete up to t = 1; expected a later /time/end to go on to\n");
  const Answer changed = resume("/time/step=0.05");
  BOOST_TEST(changed.status == 2);
  BOOST_TEST(changed.err == "courant: -: /time/step: is 0.05; the run was begun with 0.1\n");
  const Answer longer = resume("/time/end=2");
  BOOST_TEST(longer.status == 0, longer.err);
  BOOST_TEST(longer.out.find("goes on after step 8, at t = 0.8") != std::string::npos, longer.out);
  BOOST_TEST(read_run(runs).trajectory.rows() == 21u);
}

BOOST_AUTO_TEST_CASE(runs_standard_input) {
  const TemporaryFolder folder;
  const Answer answer = courant_command(
      {"run", "-", "-o", (folder / "run").string(), "--quiet", "--backend", "interpreter"},
      oscillator);
  BOOST_TEST(answer.status == 0, answer.err);
  BOOST_TEST(std::filesystem::exists(folder / "run" / "summary.json"));
}

// Each a line that begins with the file and the place, status 2, and nothing written.
BOOST_AUTO_TEST_CASE(wrong_experiments_are_refused_in_one_line) {
  const std::string vortices =
      R"json({"system": {"type": "point-vortices", "strengths": [1, 1]}, "initial": {"x": [0, 1], "y": [0, 0]},
    "method": "rk2", "time": {"step": 1, "end": 2}})json";
  const std::pair<std::string, std::string> cases[] = {
      {replaced(vortices, "\"x\": [0, 1]", "\"x\": [0, 0]"),
       "/initial: vortices 0 and 1 are at one place"},
      {replaced(vortices, "\"step\": 1", "\"step\": -1"),
       "/time/step: is -1; expected a number greater than 0"},
      {replaced(vortices, "[1, 1]", "[1, 0]"), "/system/strengths/1: is 0; expected"},
      {replaced(oscillator, "q^2)/2", "qq^2)/2"),
       "/system/hamiltonian: column 10: unknown name \"qq\" (did you mean \"q\"?)"},
      {oscillator.substr(0, 200), "line 6, column 12: the text ends too soon"},
      {replaced(oscillator, "\"method\"", "\"metod\""), "/method: is missing"},
      {replaced(oscillator, "\"title\"", "\"titel\""),
       "/titel: unknown key (did you mean \"title\"?)"},
      {"", "line 1, column 1: the text ends too soon"},
  };
  for (const auto& [text, message] : cases) {
    const TemporaryFolder folder;
    const Answer answer = courant_command({"run", "-", "-o", (folder / "run").string()}, text);
    BOOST_TEST(answer.status == 2);
    BOOST_TEST(answer.out == "");
    BOOST_TEST(answer.err.find("courant: -: " + message) == 0u,
               answer.err << " does not begin with " << message);
    BOOST_TEST(!std::filesystem::exists(folder / "run"));
  }
}

BOOST_AUTO_TEST_CASE(every_problem_has_its_line) {
  std::string text = replaced(oscillator, "\"title\"", "\"titel\"");
  text = replaced(text, "q^2)/2", "qq^2)/2");
  text = replaced(text, "\"step\": 0.1", "\"step\": 0");
  const Answer answer = courant_command({"run", "-"}, text);
  BOOST_TEST(answer.status == 2);
  BOOST_TEST(std::count(answer.err.begin(), answer.err.end(), '\n') == 3);
}

BOOST_AUTO_TEST_CASE(files_and_folders_that_cannot_be_used) {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  const std::string missing = (folder / "none.json").string();
  const Answer absent = courant_command({"run", missing});
  BOOST_TEST(absent.status == 2);
  BOOST_TEST(absent.err == "courant: " + missing + ": cannot be read: No such file or directory\n");
  const Answer directory = courant_command({"run", folder.path().string()});
  BOOST_TEST(directory.err ==
             "courant: " + folder.path().string() + ": cannot be read: is a folder\n");
  const std::string below = (folder / "file" / "run").string();
  const Answer unwritable =
      courant_command({"run", "-", "-o", below, "--quiet", "--backend", "interpreter"}, oscillator);
  BOOST_TEST(unwritable.status == 2);
  BOOST_TEST(unwritable.err ==
             "courant: " + below + ": the folder cannot be made: Not a directory\n");
}

BOOST_AUTO_TEST_CASE(a_failed_expectation_is_status_3) {
  const TemporaryFolder folder;
  const Answer answer = courant_command(
      {"run", "-", "-o", (folder / "run").string(), "--quiet", "--backend", "interpreter"},
      replaced(oscillator, "\"max_drift\": 1e-12", "\"min_drift\": 1e-3"));
  BOOST_TEST(answer.status == 3);
  BOOST_TEST(answer.err.find("courant: -: /expect/0: greatest drift of H, at least: is ") == 0u,
             answer.err);
  BOOST_TEST(std::filesystem::exists(folder / "run" / "summary.json"));
}

// Falls onto q = 0, where the formula for the energy ends: whatever is expected, the run failed.
BOOST_AUTO_TEST_CASE(a_run_that_fails_is_status_3) {
  std::string collision = replaced(oscillator, "(p_q^2 + q^2)/2", "p_q^2/2 + sqrt(q)");
  collision = replaced(collision, "\"step\": 0.1, \"end\": 1", "\"step\": 0.01, \"end\": 10");
  for (const char* expectation :
       {R"({ "observable": "H", "max_drift": 1e9 })", R"({ "verdict": "regular" })"}) {
    const TemporaryFolder folder;
    const Answer answer = courant_command(
        {"run", "-", "-o", (folder / "run").string(), "--quiet", "--backend", "interpreter"},
        replaced(collision, R"({ "observable": "H", "max_drift": 1e-12 })", expectation));
    BOOST_TEST(answer.status == 3);
    BOOST_TEST(answer.err.find("courant: -: ") == 0u, answer.err);
    BOOST_TEST((read_run(folder / "run").summary.status == RunStatus::failed));
  }
}

// No point of S_1 is near q = 0: nothing can be run, and the ladder itself is what was asked for.
BOOST_AUTO_TEST_CASE(an_inconsistent_system_is_status_3_where_it_is_run) {
  const std::string text =
      R"json({"system": {"type": "lagrangian", "coordinates": ["q"], "lagrangian": "q' + q"},
    "initial": {"q": 0}})json";
  const TemporaryFolder folder;
  const Answer answer =
      courant_command({"run", "-", "-o", (folder / "run").string(), "--quiet"}, text);
  BOOST_TEST(answer.status == 3);
  BOOST_TEST(answer.err.find("inconsistent") != std::string::npos, answer.err);
}

BOOST_AUTO_TEST_CASE(an_interrupt_is_status_130) {
  const TemporaryFolder folder;
  std::istringstream in(oscillator);
  std::ostringstream out, err;
  const std::atomic<bool> stop{true};
  const int status =
      cli::command({"run", "-", "-o", (folder / "run").string(), "--backend", "interpreter"},
                   {.in = in, .out = out, .err = err, .stop = &stop});
  BOOST_TEST(status == 130);
  BOOST_TEST((read_run(folder / "run").summary.status == RunStatus::interrupted));
}

BOOST_AUTO_TEST_CASE(set_changes_a_value) {
  const TemporaryFolder folder;
  const std::string runs = (folder / "run").string();
  const Answer answer =
      courant_command({"run", "-", "-o", runs, "--quiet", "--backend", "interpreter", "--set",
                       "/time/step=pi/8", "--set", "/time/end=2*pi", "--set", "/method=rk4",
                       "--set", "/initial/q=3", "--set", "/expect=[]"},
                      oscillator);
  BOOST_TEST(answer.status == 0, answer.err);
  const Run run = read_run(runs);
  BOOST_TEST(run.trajectory.rows() == 17u);
  BOOST_TEST(run.trajectory.column("q")[0] == 3.0);
  BOOST_TEST(run.experiment["time"]["step"] == "pi/8");
  BOOST_TEST(run.experiment["method"]["type"] == "rk4");
  const Answer ladder =
      courant_command({"constraints", "-", "--json", "--set", "/initial/p_q=0.5"}, oscillator);
  BOOST_TEST(nlohmann::json::parse(ladder.out)["consistent_point"]["p_q"] == 0.5);
  for (const auto& [setting, message] :
       {std::pair("/sistem/x=1", "--set /sistem/x: there is no such place"),
        std::pair("time=1", "--set time: is not a change"),
        std::pair("/time/step", "--set /time/step: is not a change"),
        std::pair("/time/step=two", "/time/step: column 1: unknown name \"two\""),
        std::pair("/a~=1", "--set /a~: is not a JSON pointer")}) {
    const Answer wrong = courant_command({"constraints", "-", "--set", setting}, oscillator);
    BOOST_TEST(wrong.status == 2);
    BOOST_TEST(wrong.err.starts_with("courant: -: " + std::string(message)), wrong.err);
  }
}

BOOST_AUTO_TEST_CASE(constraints_prints_the_ladder) {
  const std::string text =
      R"json({"system": {"type": "lagrangian", "coordinates": ["x", "y"], "lagrangian": "x*y' - x^2/2 - y^2/2"},
    "initial": {"x": 1, "y": 0}})json";
  const Answer answer = courant_command({"constraints", "-"}, text);
  BOOST_TEST(answer.status == 0);
  BOOST_TEST(answer.out.find("(4, 2) ⊇ (2, 2)") != std::string::npos, answer.out);
  const Answer json = courant_command({"constraints", "-", "--json"}, text);
  BOOST_TEST(json.status == 0);
  const auto ladder = nlohmann::json::parse(json.out);
  BOOST_TEST(ladder["verdict"] == "regular");
  BOOST_TEST(ladder["index"] == 1);
  BOOST_TEST(ladder["levels"].size() == 3u);
  BOOST_TEST(ladder["levels"][0]["dim_S"] == 4);
  BOOST_TEST(ladder["degrees_of_freedom"] == 2);
  BOOST_TEST(ladder["consistent_point"]["p_y"] == 1.0);
}

BOOST_AUTO_TEST_CASE(an_interrupt_before_the_first_step_is_no_failure) {
  const TemporaryFolder folder;
  const std::atomic<bool> stop = true;
  const std::string file = "experiments/boundary_lambert.json",
                    out = (folder.path() / "run").string();
  const Answer answer = courant_command({"run", "--quiet", "-o", out, file}, "", &stop);
  BOOST_TEST(answer.status == 130);
  BOOST_TEST(answer.err == "courant: " + file + ": interrupted\n");
  BOOST_TEST(!std::filesystem::exists(out));
}

BOOST_AUTO_TEST_CASE(list_has_every_kind) {
  const Answer text = courant_command({"list"});
  BOOST_TEST(text.status == 0);
  BOOST_TEST(text.out.find("point-vortices") != std::string::npos);
  std::istringstream lines(text.out);
  for (std::string line; std::getline(lines, line);) BOOST_TEST(text_width(line) <= 100u, line);
  const auto json = nlohmann::json::parse(courant_command({"list", "--json"}).out);
  for (const char* shelf :
       {"systems", "manifolds", "structures", "methods", "discretizations", "projectors"})
    BOOST_TEST(json[shelf].size() > 1u);
}

BOOST_AUTO_TEST_CASE(list_has_the_kinds_that_are_asked_for) {
  const Answer two = courant_command({"list", "lagrangian", "so3"});
  BOOST_TEST(two.status == 0);
  BOOST_TEST(two.out.starts_with("systems\n  lagrangian: "));
  BOOST_TEST(two.out.find("manifolds\n  so3: ") != std::string::npos);
  BOOST_TEST(two.out.find("\"definitions\"") != std::string::npos);
  BOOST_TEST(two.out.find("mechanical:") == std::string::npos);
  // What all kinds take is said once.
  const Answer systems = courant_command({"list", "systems"});
  const std::string once = "\"definitions\"";
  const std::size_t at = systems.out.find(once);
  BOOST_TEST(at != std::string::npos);
  BOOST_TEST(systems.out.find(once, at + 1) == std::string::npos);
  BOOST_TEST(systems.out.find("manifolds") == std::string::npos);
  const Answer none = courant_command({"list", "lagrangain"});
  BOOST_TEST(none.status == 2);
  BOOST_TEST(none.err.find("lagrangain: there is no such kind (did you mean \"lagrangian\"?)") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(report_compares_runs) {
  const TemporaryFolder folder;
  for (const char* name : {"a", "b"})
    courant_command(
        {"run", "-", "-o", (folder / name).string(), "--quiet", "--backend", "interpreter"},
        oscillator);
  const Answer answer = courant_command({"report", (folder / "a").string(), (folder / "b").string(),
                                         "-o", (folder / "page.html").string()});
  BOOST_TEST(answer.status == 0, answer.err);
  BOOST_TEST(answer.out.find("discretize-first, midpoint") != std::string::npos);
  BOOST_TEST(std::filesystem::exists(folder / "page.html"));
  BOOST_TEST(courant_command({"report", (folder / "none").string()}).status == 2);
}

BOOST_AUTO_TEST_CASE(cache_lists_and_clears, *boost::unit_test::precondition([](auto) {
                       return machine_compiler()->is_available();
                     })) {
  const TemporaryFolder folder;
  setenv("COURANT_CACHE", (folder / "cache").c_str(), 1);
  const Answer before = courant_command({"cache"});
  BOOST_TEST(before.status == 0);
  BOOST_TEST(before.out.find(": 0 entries, 0 kB") != std::string::npos, before.out);
  courant_command({"run", "-", "-o", (folder / "run").string(), "--backend", "native"}, oscillator);
  BOOST_TEST(courant_command({"cache"}).out.find("today") != std::string::npos);
  BOOST_TEST(courant_command({"cache", "--clear"}).out == before.out);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "cache"))
    BOOST_TEST(entry.path().filename() == "CACHEDIR.TAG");
  unsetenv("COURANT_CACHE");
}

// Once, with the reason, where code would be worth it; who asked for the interpreter, or for silence, is
// not told.
BOOST_AUTO_TEST_CASE(falling_back_to_the_interpreter_is_said) {
  const TemporaryFolder folder;
  setenv("COURANT_CC", "no-such-compiler", 1);
  const Answer answer = courant_command(
      {"run", "-", "-o", (folder / "a").string(), "--set", "/expect=[]", "--set", "/time/end=2000"},
      oscillator);
  BOOST_TEST(answer.status == 0);
  const Answer of_ten_steps =
      courant_command({"run", "-", "-o", (folder / "c").string()}, oscillator);
  BOOST_TEST(of_ten_steps.err == "");
  BOOST_TEST(answer.err ==
             "courant: formulas are interpreted, which is slower: no C compiler: no-such-compiler "
             "is not found. Install one, name one in COURANT_CC, or use the interpreter.\n");
  const Answer asked = courant_command(
      {"run", "-", "-o", (folder / "b").string(), "--backend", "interpreter"}, oscillator);
  BOOST_TEST(asked.err == "");
  unsetenv("COURANT_CC");
}

BOOST_AUTO_TEST_CASE(help_says_what_the_environment_does) {
  const std::string help = courant_command({"--help"}).out;
  for (const char* word : {"COURANT_CC", "COURANT_CACHE", "cache", "Exit status"})
    BOOST_TEST(help.find(word) != std::string::npos, help);
}

BOOST_AUTO_TEST_CASE(help_fits_a_terminal) {
  for (const char* command :
       {"run", "constraints", "check", "study", "list", "schema", "import", "export", "report",
        "plot", "new", "tour", "cache", "completion", "man"}) {
    const std::string help = courant_command({command, "--help"}).out;
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) BOOST_TEST(text_width(line) <= 100u, line);
  }
  // What an option means goes on below where it begins.
  const std::string run = courant_command({"run", "--help"}).out;
  BOOST_TEST(run.find("\n                              interpreter, slower") != std::string::npos,
             run);
  // All words are there, in their order.
  std::string kinds = courant_command({"new", "--help"}).out;
  std::erase_if(kinds, [](char c) { return c == ' ' || c == '\n'; });
  BOOST_TEST(kinds.find("|optimal-control|euler-poincare|port-hamiltonian|") != std::string::npos,
             kinds);
}

BOOST_AUTO_TEST_CASE(files_of_another_command_are_told_which) {
  const TemporaryFolder folder;
  const std::string netlist = (folder / "rc.cir").string(),
                    experiment = (folder / "o.json").string();
  write_text(netlist, "rc\nV1 a 0 1\nR1 a 0 1k\n.tran 1u 1m\n");
  write_text(experiment, oscillator);
  const Answer run = courant_command({"run", netlist}),
               import = courant_command({"import", experiment});
  BOOST_TEST(run.status == 2);
  BOOST_TEST(run.err ==
             "courant: " + netlist +
                 ": is a netlist or a robot; expected an experiment, which `courant import " +
                 netlist + " -o FILE.json` makes of it\n");
  BOOST_TEST(import.status == 2);
  BOOST_TEST(import.err.find("`courant run " + experiment + "`") != std::string::npos, import.err);
}

BOOST_AUTO_TEST_CASE(wrong_command_lines_are_status_2) {
  BOOST_TEST(courant_command({"rnu", "x"}).err ==
             "courant: unknown command \"rnu\" (did you mean \"run\"?); `courant --help` lists the "
             "commands\n");
  BOOST_TEST(
      courant_command({"--frobnicate"})
          .err.starts_with("courant: unknown option \"--frobnicate\"; expected a command first"));
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"run"},
                                                    {"run", "x", "--frce"},
                                                    {"run", "x", "--backend", "gpu"},
                                                    {"run", "x", "--resume", "--force"},
                                                    {"report"}}) {
    const Answer answer = courant_command(arguments);
    BOOST_TEST(answer.status == 2);
    BOOST_TEST(answer.err.find("courant: ") == 0u);
    BOOST_TEST(std::count(answer.err.begin(), answer.err.end(), '\n') == 1, answer.err);
    BOOST_TEST(answer.out == "");
  }
}

// As from "$folder" in a shell where it has no value.
BOOST_AUTO_TEST_CASE(empty_words_are_no_defaults) {
  using Words = std::vector<std::string>;
  for (const auto& [arguments, place] :
       {std::pair(Words{"run", "-", "-o", ""}, "-o"), std::pair(Words{"run", ""}, "argument 2"),
        std::pair(Words{"run", "-", "--backend="}, "--backend")}) {
    const Answer answer = courant_command(arguments, oscillator);
    BOOST_TEST(answer.status == 2);
    BOOST_TEST(answer.err == "courant: " + std::string(place) +
                                 ": is empty; expected a value; see `courant --help`\n");
  }
}

BOOST_AUTO_TEST_CASE(help_and_version_are_status_0) {
  const Answer help = courant_command({"--help"});
  BOOST_TEST(help.status == 0);
  for (const char* word :
       {"run", "constraints", "study", "list", "schema", "report", "plot", "new"})
    BOOST_TEST(help.out.find(word) != std::string::npos);
  const Answer run = courant_command({"run", "--help"});
  BOOST_TEST(run.out.find("--force") != std::string::npos);
  BOOST_TEST(run.out.find("--resume") != std::string::npos);
  BOOST_TEST(courant_command({"--version"}).out.find("courant ") == 0u);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
