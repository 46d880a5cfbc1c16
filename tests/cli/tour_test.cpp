#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "../core/files/temporary_folder.hpp"
#include "courant/cli/command.hpp"
#include "courant/reading/experiment.hpp"
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

// `-o` writes the experiment, the page, the picture; the pictures are those of the documents.
BOOST_AUTO_TEST_CASE(chapters_are_written_as_files) {
  const TemporaryFolder folder;
  const auto text_of = [](const std::filesystem::path& path) {
    std::ifstream file(path);
    BOOST_TEST_REQUIRE(file.good(), path << " is missing");
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  for (std::size_t i = 0; i < tour_chapters().size(); ++i) {
    const std::string name = tour_chapters()[i].file;
    tour({std::to_string(i + 1), "-o", (folder / "files").string()});
    const std::filesystem::path files = folder / "files";
    BOOST_TEST(text_of(files / (name + ".svg")) == text_of("docs/tour/" + name + ".svg"), name);
    BOOST_TEST(text_of(files / (name + ".md")).starts_with(text_of("docs/tour/" + name + ".md")));
    BOOST_TEST(text_of(files / (name + ".html")).find("<math") != std::string::npos, name);
    read_experiment(text_of(files / (name + ".json")));
  }
  // What somebody has written there stays.
  std::ofstream(folder / "files" / (tour_chapters()[0].file + ".json")) << "mine";
  std::istringstream in;
  std::ostringstream out, err;
  BOOST_TEST(cli::command({"tour", "1", "-o", (folder / "files").string()},
                          {.in = in, .out = out, .err = err}) != 0);
  BOOST_TEST(text_of(folder / "files" / (tour_chapters()[0].file + ".json")) == "mine");
}

// On a terminal Enter leads through question, answer, solution, and to the next chapter; the end of input ends it.
BOOST_AUTO_TEST_CASE(enter_goes_on) {
  std::istringstream in("\n\n\n\n\n");
  std::ostringstream out, err;
  cli::command({"tour", "9"}, {.in = in, .out = out, .err = err, .is_terminal = true});
  BOOST_TEST(out.str().find("(Enter for chapter 10)") != std::string::npos);
  BOOST_TEST(out.str().find("10. Constrain first") != std::string::npos, out.str());
  std::istringstream ends("\n\n");
  std::ostringstream short_out;
  cli::command({"tour", "9"}, {.in = ends, .out = short_out, .err = err, .is_terminal = true});
  BOOST_TEST(short_out.str().find("10. Constrain first") == std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
