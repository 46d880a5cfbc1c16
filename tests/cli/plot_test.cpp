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

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
