#include <boost/test/unit_test.hpp>

#include "../core/files/temporary_folder.hpp"
#include "answer.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(export_command)

using test::Answer;
using test::courant_command;

BOOST_AUTO_TEST_CASE(a_method_that_has_no_program_is_told_which_have) {
  const Answer refused =
      courant_command({"export", "experiments/heavy_top_reduced.json", "--language", "c"});
  BOOST_TEST(refused.status == 2);
  BOOST_TEST(refused.err.find("the steps of reduced are not known as formulas alone; expected "
                              "discretize-first, constrain-first, discrete-gradient, rk2, rk4, "
                              "dopri5 or rkf78") != std::string::npos,
             refused.err);
}

BOOST_AUTO_TEST_CASE(a_program_is_written_to_a_file_or_to_standard_output) {
  const TemporaryFolder folder;
  const std::string file = (folder / "pendulum.c").string();
  const Answer written =
      courant_command({"export", "experiments/pendulum.json", "--language", "c", "-o", file});
  BOOST_TEST(written.status == 0, written.err);
  BOOST_TEST(written.out == "");
  const Answer printed =
      courant_command({"export", "experiments/pendulum.json", "--language", "c"});
  BOOST_TEST(printed.status == 0);
  BOOST_TEST(read_text(file).starts_with(printed.out));
  BOOST_TEST(printed.out.find("int main(void)") != std::string::npos);
  const Answer changed = courant_command(
      {"export", "experiments/pendulum.json", "--language", "c", "--set", "/title=A swing"});
  BOOST_TEST(changed.out.find("/* A swing\n") == 0u);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_exported_is_one_line) {
  const Answer gauge =
      courant_command({"export", "experiments/christ_lee.json", "--language", "c"});
  BOOST_TEST(gauge.status == 2);
  BOOST_TEST(gauge.out == "");
  BOOST_TEST(
      gauge.err.find("courant: experiments/christ_lee.json: /method: cannot be exported: ") == 0u,
      gauge.err);
  BOOST_TEST(std::count(gauge.err.begin(), gauge.err.end(), '\n') == 1);
  BOOST_TEST(courant_command({"export", "experiments/pendulum.json"}).status == 2);
  const Answer fortran =
      courant_command({"export", "experiments/pendulum.json", "--language", "fortran"});
  BOOST_TEST(fortran.status == 2);
  BOOST_TEST(fortran.err.find("courant: --language: fortran") == 0u, fortran.err);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
