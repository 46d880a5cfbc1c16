// What the command prints, at terminals of 80 and 120 columns.
#include <boost/test/unit_test.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "../core/files/temporary_folder.hpp"
#include "answer.hpp"
#include "courant/core/words/text_layout.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a line, or a row of a table, is wider than the terminal
//  * text wraps at one width whatever the terminal is
BOOST_AUTO_TEST_SUITE(screen_width)

namespace {

// The lines that the command prints at a terminal of so many columns.
std::vector<std::string> lines_at(std::size_t columns, const std::vector<std::string>& arguments) {
  std::istringstream in;
  std::ostringstream out, err;
  cli::command(arguments, {.in = in, .out = out, .err = err, .columns = columns});
  std::istringstream printed(out.str());
  std::vector<std::string> lines;
  for (std::string line; std::getline(printed, line);) lines.push_back(line);
  return lines;
}

}  // namespace

BOOST_AUTO_TEST_CASE(no_line_is_wider_than_the_terminal) {
  const TemporaryFolder folder;
  const std::string run = (folder.path() / "run").string();
  const std::vector<std::vector<std::string>> commands = {
      {"run", "experiments/furuta_pendulum_damped.json", "-o", run, "--force"},
      {"constraints", "experiments/furuta_pendulum_damped.json"},
      {"check", "experiments/pendulum.json"},
      {"check", "experiments/port_hamiltonian_open.json"},
      {"list"}};
  for (const auto& command : commands) {
    std::size_t widest = 0;
    for (const std::size_t columns : {80, 120})
      for (const std::string& line : lines_at(columns, command)) {
        BOOST_TEST(text_width(line) <= columns, command[0] << " at " << columns << ": " << line);
        if (columns == 120) widest = std::max(widest, text_width(line));
      }
    if (command[0] == "check" || command[0] == "constraints")
      BOOST_TEST(widest > 80u, command[0] << " does not use 120 columns");
  }
}

// A row goes on below in its first column, and no word of it is lost.
BOOST_AUTO_TEST_CASE(a_row_that_is_too_wide_goes_on_below) {
  const auto words = [](const std::vector<std::string>& lines) {
    std::multiset<std::string> all;
    for (const std::string& line : lines) {
      std::istringstream in(line);
      for (std::string word; in >> word;) all.insert(word);
    }
    return all;
  };
  const auto narrow = lines_at(80, {"check", "experiments/pendulum.json"}),
             wide = lines_at(120, {"check", "experiments/pendulum.json"});
  BOOST_TEST(narrow.size() > wide.size());
  BOOST_TEST((words(narrow) == words(wide)));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
