#include <boost/test/unit_test.hpp>

#include "../core/files/temporary_folder.hpp"
#include "answer.hpp"
#include "courant/cli/command.hpp"
#include "courant/tests/core/says.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(plot)

namespace {

using test::Answer;
using test::courant_command;

}  // namespace

BOOST_AUTO_TEST_CASE(one_figure_of_a_run_with_its_numbers) {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string(), file = (folder / "energy.svg").string();
  const std::string oscillator = R"json({
    "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2" },
    "initial": { "q": 1, "p_q": 0 }, "method": "rk2", "time": { "step": 0.1, "end": 10 },
    "output": { "units": { "t": "s", "H": "J" } } })json";
  courant_command({"run", "-", "-o", run, "--quiet", "--backend", "interpreter"}, oscillator);
  const Answer answer = courant_command({"plot", run, "--figure", "energy", "-o", file});
  BOOST_TEST(answer.status == 0, answer.err);
  BOOST_TEST(says(answer.out, "energy.svg, its numbers in"), answer.out);
  BOOST_TEST(says(answer.out, "growing"), answer.out);
  BOOST_TEST(read_text(file).find("<svg") == 0u);
  const std::string numbers = read_text(folder / "energy.csv");
  BOOST_TEST(numbers.find("t [s],H \xE2\x88\x92 H(0) [J]\n0,0\n0.1,") == 0u, numbers.substr(0, 60));
  BOOST_TEST(std::count(numbers.begin(), numbers.end(), '\n') == 102);

  const Answer unknown = courant_command({"plot", run, "--figure", "enrgy", "-o", file});
  BOOST_TEST(unknown.status == 2);
  BOOST_TEST(says(unknown.err,
                  "(did you mean \"energy\"?); expected one of: phase, coordinates, "
                  "energy"),
             unknown.err);
  BOOST_TEST(courant_command({"plot", run, "--figure", "energy", "-o", "a.jpg"}).status == 2);
  BOOST_TEST(courant_command({"plot", (folder / "none").string(), "--figure", "energy", "-o", file})
                 .status == 2);

  // What cannot be written has the name that was asked for.
  for (const char* name : {"/none/f.svg", "/none/f.pdf"}) {
    const Answer refused = courant_command({"plot", run, "--figure", "energy", "-o", name});
    BOOST_TEST(refused.status == 3);
    BOOST_TEST(refused.err.starts_with(std::string("courant: ") + name + ": cannot be written"),
               refused.err);
  }

  // The figures of sweeps and studies too.
  const std::string sweep = (folder / "sweep").string(), study = (folder / "study").string();
  courant_command({"run", "-", "-o", sweep, "--quiet", "--backend", "interpreter", "--sweep",
                   "/time/step=0.1,0.05"},
                  oscillator);
  courant_command({"study", "-", "-o", study, "--backend", "interpreter"}, oscillator);
  for (const auto& [name, place] : {std::pair("sweep", sweep), std::pair("study", study)}) {
    const Answer drawn = courant_command({"plot", place, "--figure", name, "-o", file});
    BOOST_TEST(drawn.status == 0, drawn.err);
  }
}

// A width and letters are those of the file; limits are the ends of the axis, and what is outside of them is cut off.
BOOST_AUTO_TEST_CASE(figures_look_as_a_paper_wants) {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string(), file = (folder / "f.svg").string(),
                    pgf = (folder / "f.pgf").string();
  courant_command({"run", "-", "-o", run, "--quiet", "--backend", "interpreter"}, R"json({
    "system": { "type": "hamiltonian", "coordinates": ["q"], "hamiltonian": "(p_q^2 + q^2)/2" },
    "initial": { "q": 1, "p_q": 0 }, "method": "discretize-first", "time": { "step": 0.1, "end": 10 },
    "observe": { "double": "2*q", "square": "q^2" } })json");
  const auto drawn = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"plot", run, "-o", file, "--force"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Answer answer = courant_command(arguments);
    BOOST_TEST(answer.status == 0, answer.err);
    return read_text(file);
  };
  const auto number_after = [](const std::string& text, const std::string& before) {
    return std::stod(text.substr(text.find(before) + before.size()));
  };
  const std::string plain = drawn({"--figure", "energy"});
  const std::string narrow =
      drawn({"--figure", "energy", "--width", "8", "--font-size", "6", "--title", "A title"});
  BOOST_TEST(number_after(narrow, "width=\"") == 8 * 96 / 2.54, boost::test_tools::tolerance(1e-4));
  // Letters of 12 units are 6 points, 8 pixels.
  const double unit = number_after(narrow, "width=\"") / number_after(narrow, "viewBox=\"0 0 ");
  BOOST_TEST(12 * unit == 8.0, boost::test_tools::tolerance(1e-3));
  BOOST_TEST(says(narrow, ">A title</text>"));
  BOOST_TEST(!says(plain, "A title"));

  // Of q over [0, 10] the axis has the limits, and no curve is drawn beyond.
  const std::string part = drawn({"--columns", "q", "--x", "2:4", "--y", "-0.5:0.5"});
  BOOST_TEST(says(part, "overflow=\"hidden\""));
  BOOST_TEST(says(part, ">0.4</text>"));
  BOOST_TEST(!says(part, ">1.0</text>"));
  BOOST_TEST(!says(part, ">6</text>"));

  // Columns in a panel each, and in one.
  const std::string apart = drawn({"--columns", "q,double,square"}),
                    together = drawn({"--columns", "q,double,square", "--overlay"});
  const auto panels = [](const std::string& svg) {
    std::size_t count = 0;
    for (std::size_t at = svg.find(" over time</title>"); at != std::string::npos;
         at = svg.find(" over time</title>", at + 1))
      ++count;
    return count;
  };
  BOOST_TEST(panels(apart) == panels(together) + 2);
  BOOST_TEST(says(together, ">square</text>"));
  const std::string numbers = read_text(folder / "f.csv");
  BOOST_TEST(numbers.starts_with("t,q: ,double: ,square: \n0,1,2,1\n"), numbers.substr(0, 40));

  // For LaTeX: the same rows as coordinates.
  const Answer latex = courant_command({"plot", run, "--columns", "q", "-o", pgf});
  BOOST_TEST(latex.status == 0, latex.err);
  const std::string picture = read_text(pgf);
  BOOST_TEST(says(picture, "\\begin{tikzpicture}"));
  BOOST_TEST(says(picture, "xlabel={t}, ylabel={q}"));
  BOOST_TEST(says(picture, "(0,1)"));
  BOOST_TEST(says(picture, "% Written by courant plot"));

  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--figure", "energy", "--width", "1"},
        {"--figure", "energy", "--width", "3", "--font-size", "30"},
        {"--figure", "energy", "--x", "2"},
        {"--figure", "energy", "--x", "4:2"},
        {"--figure", "energy", "--x", "a:b"},
        {"--columns", "sqare"},
        {"--columns", "q", "--figure", "energy"},
        {"--figure", "energy", "--overlay"},
        {}}) {
    std::vector<std::string> arguments = {"plot", run, "-o", file, "--force"};
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    const Answer answer = courant_command(arguments);
    BOOST_TEST(answer.status == 2);
    // Of options that do not go together the parser of the command line speaks.
    const bool is_of_options = says(answer.err, "excludes") || says(answer.err, "requires");
    BOOST_TEST(1 == says(answer.err, "expected") + says(answer.err, "did you mean") + is_of_options,
               answer.err);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
