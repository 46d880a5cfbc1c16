#include "courant/running/run_failure.hpp"

#include <boost/test/unit_test.hpp>

#include "problems.hpp"

namespace courant::test {
// Mistakes that these cases have to notice:
//  * a guess stays beside the cause
BOOST_AUTO_TEST_SUITE(run_failure)

namespace {

// A fall towards q = 0 with the energy of a square root.
Problem fall(const std::string& energy) {
  return problem(
      {{"system", {{"type", "hamiltonian"}, {"coordinates", {"q"}}, {"hamiltonian", energy}}},
       {"initial", {{"q", 1.0}, {"p_q", -2.0}}},
       {"method", {{"type", "rk4"}}},
       {"time", {{"step", 1.0}, {"end", 2.0}}},
       {"observe", {{"root", "sqrt(q)"}}}});
}

std::string words(const Problem& of, const std::string& what) {
  const SolveError error(SolveError::Reason::diverged, "rk4", 0.0, 1.0, what);
  return failure_in_words(error, of.experiment, of.ladder, of.ladder.point);
}

}  // namespace

// Where a formula has no value that is the cause, in the place of a guess.
BOOST_AUTO_TEST_CASE(the_formula_without_a_value_is_the_cause) {
  const std::string text =
      words(fall("p_q^2/2 + sqrt(q)"), "did not converge; the step is too large.");
  BOOST_TEST(text.starts_with("rk4: the step of 1 from t = 0 did not converge: "), text);
  BOOST_TEST(text.find("sqrt(q)") != std::string::npos, text);
  BOOST_TEST(text.find("too large") == std::string::npos, text);
}

BOOST_AUTO_TEST_CASE(a_failure_of_another_kind_stays_as_it_is) {
  const std::string said = "did not converge; the step is too large.";
  BOOST_TEST(words(fall("p_q^2/2 + q"), said) == "rk4: the step of 1 from t = 0 " + said);
}

BOOST_AUTO_TEST_CASE(what_is_written_of_the_start_is_finite) {
  const Problem of = fall("p_q^2/2 + q");
  Observer observer(of.experiment, of.ladder, Backend::interpreter);
  State start = of.ladder.point;
  require_finite(observer, of.experiment, start);
  start.x[0] = -1.0;
  BOOST_CHECK_EXCEPTION(require_finite(observer, of.experiment, start), ExperimentError,
                        [](const ExperimentError& error) {
                          return error.problems()[0].where == "/initial" &&
                                 error.problems()[0].what.find("root") != std::string::npos;
                        });
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::test
