#include <boost/test/unit_test.hpp>
#include <fstream>
#include <iterator>
#include <sstream>

#include "courant/cli/command.hpp"
#include "courant/reporting/tour_chapters.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(tour_test)

namespace {

std::string tour(std::vector<std::string> arguments) {
  std::istringstream in;
  std::ostringstream out, err;
  arguments.insert(arguments.begin(), "tour");
  const int status = cli::command(arguments, {.in = in, .out = out, .err = err});
  BOOST_TEST(status == 0, err.str());
  return out.str();
}

}  // namespace

// The pages are what `courant tour N --markdown` prints, outputs included.
BOOST_AUTO_TEST_CASE(pages_are_those_of_the_documents) {
  BOOST_TEST(tour_chapters().size() == 10u);
  for (std::size_t i = 0; i < tour_chapters().size(); ++i) {
    const std::string path = "docs/tour/" + tour_chapters()[i].file + ".md";
    std::ifstream file(path);
    BOOST_TEST_REQUIRE(file.good(), path << " is missing");
    const std::string page(std::istreambuf_iterator<char>(file), {});
    BOOST_TEST(page == tour({std::to_string(i + 1), "--markdown"}), path);
  }
}

// Each chapter runs: no error in its output, and an answer after it.
BOOST_AUTO_TEST_CASE(chapters_run) {
  for (std::size_t i = 1; i <= tour_chapters().size(); ++i) {
    const std::string text = tour({std::to_string(i)});
    BOOST_TEST(text.find("courant: ") == std::string::npos, text);
    const auto question = text.find("Question: "), output = text.find("$ courant"),
               answer = text.find("Answer: "), solution = text.find("Solution: ");
    const bool in_order = question < output && output < answer && answer < solution;
    BOOST_TEST(in_order, text);
    BOOST_TEST(answer - output > 100u, text);
    BOOST_TEST(text.find("FAILED") == std::string::npos, text);
  }
  BOOST_TEST(tour({}).find("10  Constrain first") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
