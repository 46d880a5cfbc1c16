#include <boost/test/unit_test.hpp>

#include "../core/files/temporary_folder.hpp"
#include "answer.hpp"
#include "courant/cli/command.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(new_command)

using test::Answer;
using test::courant_command;

// Of every kind: it passes its checks, runs, and is as it expects.
BOOST_AUTO_TEST_CASE(what_is_written_passes_and_runs) {
  for (const KindDescription& kind : system_kinds().descriptions()) {
    const TemporaryFolder folder;
    const std::string text = courant_command({"new", kind.type}).out;
    const Answer check = courant_command({"check", "-", "--brief"}, text);
    BOOST_TEST(check.status == 0, kind.type << ": " << check.out << check.err);
    const Answer run = courant_command(
        {"run", "-", "-o", (folder / "run").string(), "--quiet", "--backend", "interpreter"}, text);
    BOOST_TEST(run.status == 0, kind.type << ": " << run.err);
  }
}

BOOST_AUTO_TEST_CASE(a_file_is_written_once) {
  const TemporaryFolder folder;
  const std::string file = (folder / "mine.json").string();
  BOOST_TEST(courant_command({"new", "hamiltonian", "-o", file}).status == 0);
  BOOST_TEST(read_text(file) == courant_command({"new", "hamiltonian"}).out);
  const Answer again = courant_command({"new", "lagrangian", "-o", file});
  BOOST_TEST(again.status == 2);
  BOOST_TEST(again.err == "courant: " + file + ": is there already; expected another file (-o)\n");
  const Answer unknown = courant_command({"new", "hamiltonain"});
  BOOST_TEST(unknown.status == 2);
  BOOST_TEST(unknown.err.find("courant: hamiltonain: there is no such kind of system (did you mean "
                              "\"hamiltonian\"?)") == 0u,
             unknown.err);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
