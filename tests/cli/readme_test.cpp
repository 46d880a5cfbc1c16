#include <boost/test/unit_test.hpp>
#include <fstream>
#include <iterator>
#include <sstream>

#include "../core/files/temporary_folder.hpp"
#include "courant/cli/command.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(readme_test)

namespace {

// The first block of README.md in this language.
std::string block(const std::string& language) {
  std::ifstream file("README.md");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const std::string fence = "```" + language + "\n";
  const auto begin = text.find(fence);
  BOOST_TEST_REQUIRE(begin != std::string::npos, language);
  const auto from = begin + fence.size();
  return text.substr(from, text.find("```", from) - from);
}

}  // namespace

// The experiment on the front page runs, keeps what it expects, and has the ladder that is shown.
BOOST_AUTO_TEST_CASE(the_front_page_is_true) {
  const TemporaryFolder folder;
  const auto status = [&](std::vector<std::string> arguments, std::string& output) {
    std::istringstream in(block("json"));
    std::ostringstream out, err;
    const int result = cli::command(arguments, {.in = in, .out = out, .err = err});
    output = out.str() + err.str();
    return result;
  };
  std::string output;
  BOOST_TEST(status({"run", "-", "-o", (folder / "run").string(), "--backend", "interpreter"},
                    output) == 0,
             output);
  BOOST_TEST(status({"constraints", "-"}, output) == 0, output);
  std::istringstream lines(block("text"));
  for (std::string line; std::getline(lines, line);)
    BOOST_TEST(output.find(line) != std::string::npos, line << " is not in\n" << output);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
