// What the command says about experiments that are wrong: tests/corpus/experiments, each of which
// some program of this kind has answered with an internal error.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <sstream>

#include "../core/files/temporary_folder.hpp"
#include "answer.hpp"
#include "courant/cli/command.hpp"
#include "courant/running/run_files.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a range is printed with all the digits of the greatest double (cli/constraints.cpp)
//  * the cause follows a full stop and a colon (running/run_failure.cpp)
BOOST_AUTO_TEST_SUITE(messages)

namespace {

using test::Answer;
using test::courant_command;

std::vector<std::filesystem::path> bad_experiments() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator("tests/corpus/experiments"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// What no message to a user contains: names of C++, noise, what a terminal obeys.
void check_words(const std::string& text, const std::string& context) {
  for (const char* wrong :
       {"::", "0.000000", "-nan", "std", "bad_alloc", "exception", "\x1b", "\x07"})
    BOOST_TEST(text.find(wrong) == std::string::npos, context << ": \"" << wrong << "\" is in\n"
                                                              << text);
}

// Lines `courant: FILE: …`.
void check_errors(const Answer& answer, const std::string& file, const std::string& context) {
  check_words(answer.err, context);
  BOOST_TEST(!answer.err.empty(), context);
  std::istringstream lines(answer.err);
  for (std::string line; std::getline(lines, line);)
    BOOST_TEST(line.starts_with("courant: " + file + ": "), context << ": " << line);
}

}  // namespace

BOOST_AUTO_TEST_CASE(numbers_beyond_the_range_of_an_option_are_refused_in_words) {
  const std::string file = "experiments/pendulum.json";
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"constraints", file, "--level", "-1"},
        {"constraints", file, "--level", "99999999999999999999"},
        {"run", file, "--sweep", "/initial/q=1,2", "--jobs", "0"},
        {"study", file, "--steps", "1"},
        {"tour", "11"}}) {
    const Answer answer = courant_command(arguments);
    BOOST_TEST(answer.status == 2, arguments.back());
    check_words(answer.err, arguments.front());
    BOOST_TEST(answer.err.size() < 120u, answer.err);
  }
}

// Formulas that have no derivative, no value or no real one where they begin, in systems of every kind.
BOOST_AUTO_TEST_CASE(starts_without_derivatives_are_answered) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator("tests/corpus/starts")) {
    const std::string file = entry.path().string();
    const Answer answer = courant_command({"constraints", file});
    BOOST_TEST((answer.status == 0 || answer.status == 2), file << " gives " << answer.status);
    check_words(answer.out, file);
    if (answer.status == 2) check_errors(answer, file, file);
    ++files;
  }
  BOOST_TEST(files == 108);
}

// Nothing is written where the experiment is wrong, and a summary where the numerics failed.
BOOST_AUTO_TEST_CASE(a_bad_experiment_is_refused_with_its_place_or_fails_with_a_summary) {
  const auto files = bad_experiments();
  BOOST_TEST(files.size() > 80u);
  for (const auto& file : files) {
    const TemporaryFolder folder;
    const std::string name = file.string(), runs = (folder / "run").string();
    const Answer answer =
        courant_command({"run", name, "-o", runs, "--quiet", "--backend", "interpreter"});
    BOOST_TEST((answer.status == 2 || answer.status == 3), name << " gives " << answer.status);
    check_errors(answer, name, name);
    BOOST_TEST(std::filesystem::exists(runs) == (answer.status == 3), name);
    if (answer.status == 3) {
      const Run run = read_run(runs);
      const bool failed = run.summary.status != RunStatus::completed;
      BOOST_TEST(!run.summary.message.empty() == failed, name);
      check_words(run.summary.message, name);
    }
  }
}

BOOST_AUTO_TEST_CASE(constraints_and_check_say_the_same_kind_of_thing) {
  for (const auto& file : bad_experiments())
    for (const char* command : {"constraints", "check"}) {
      const std::string name = file.string(), context = command + (" " + name);
      const Answer answer = courant_command({command, name});
      BOOST_TEST((answer.status == 0 || answer.status == 2 || answer.status == 3), context);
      check_words(answer.out, context);
      if (answer.status == 2) check_errors(answer, name, context);
    }
}

BOOST_AUTO_TEST_CASE(the_place_is_that_of_the_wrong_value) {
  for (const auto& [name, place] : {
           std::pair("definition_bad_character", "/system/definitions/V: column 2: "),
           std::pair("definition_unfinished", "/system/definitions/V: column 4: "),
           std::pair("strength_nan", "/system/strengths/0: is nan; expected a finite number"),
           std::pair("parameter_infinite",
                     "/system/parameters/m: is inf; expected a finite number"),
           std::pair("too_many_coordinates", "/system: takes more memory than there is"),
           std::pair("submanifold_without_start", "/initial: no point of "),
           std::pair("momentum_projector_no_summary",
                     "constrain-first: the step of 1 from t = 0 has no solution that is connected "
                     "to the state"),
           std::pair("implicit_of_nan",
                     "/initial: sqrt(x - 2) in the equation \"x'-sqrt(x-2)\" has no value at the "
                     "initial values: the argument of sqrt is -1, expected at least 0"),
           std::pair("hamiltonian_outside_its_domain",
                     "/initial: log(q - 2) in the energy H has no value at the initial point: the "
                     "argument of log is -1, expected more than 0"),
           std::pair("observable_outside_its_domain",
                     "/initial: sqrt(q - 2) in the observable \"n\" has no value at"),
           std::pair("lagrangian_leaves_its_domain",
                     "rk4: the step of 0.1 from t = 0 cannot be made: no velocity found at t = "
                     "0.05: "),
           std::pair("vacuous_expectation", "/expect/0/max_drift: tests nothing"),
           std::pair("max_violation_nan", "/expect/0/max_violation: tests nothing"),
           std::pair("expectation_that_fails",
                     "/expect/0: q = 2 at t = 1: is 0.541002, off by 1.46; allowed 1e-07"),
           std::pair("expectation_of_no_values", "/expect/0/state: is empty; expected values"),
           std::pair(
               "step_too_long_into_a_root",
               "discretize-first: the step of 0.1 from t = 0 has no solution that is connected "
               "to the state: the one that is ends at a step of 0.030854. A step of 0.027 "
               "would do. The cause: sqrt(q) in equation 2 has no value"),
           std::pair("number_too_large", "line 1, column 99: is not JSON: number overflow"),
       }) {
    const TemporaryFolder folder;
    const std::string file = "tests/corpus/experiments/" + std::string(name) + ".json";
    const Answer answer =
        courant_command({"run", file, "-o", (folder / "run").string(), "--quiet"});
    BOOST_TEST(answer.err.starts_with("courant: " + file + ": " + place), answer.err);
  }
}

// A title comes from a file, and a file from anywhere.
BOOST_AUTO_TEST_CASE(a_title_does_not_command_the_terminal) {
  const TemporaryFolder folder;
  write_text(folder / "title.json",
             R"json({"title": "\u001b[31mred\u001b]0;window title\u0007",
    "system": {"type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "p_q^2/2"},
    "initial": {"q": 1, "p_q": 0}})json");
  for (const char* command : {"constraints", "check"}) {
    const Answer answer = courant_command({command, (folder / "title.json").string()});
    BOOST_TEST(answer.out.find("\\u001b[31mred") != std::string::npos);
    BOOST_TEST(answer.out.find('\x1b') == std::string::npos);
  }
  const Answer run =
      courant_command({"run", (folder / "title.json").string(), "-o", (folder / "run").string()});
  BOOST_TEST(run.out.find("\\u001b[31mred") != std::string::npos);
  BOOST_TEST(run.out.find('\x1b') == std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
