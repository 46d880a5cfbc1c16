#include "courant/running/run_failure.hpp"

#include <boost/test/unit_test.hpp>

#include "problems.hpp"

namespace courant::test {
// Mistakes that these cases have to notice:
//  * a guess stays beside the cause
//  * who meets a switch is not told of corners
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

// As where a switch opens: steps have to end there, and times tell where.
BOOST_AUTO_TEST_CASE(a_condition_on_time_asks_for_corners) {
  const auto disconnected = [](const std::string& energy, const Json& corners) {
    Json experiment = {
        {"system", {{"type", "hamiltonian"}, {"coordinates", {"q"}}, {"hamiltonian", energy}}},
        {"initial", {{"q", 1.0}, {"p_q", -2.0}}},
        {"method", {{"type", "discretize-first"}}},
        {"time", {{"step", 1.0}, {"end", 2.0}}}};
    if (!corners.is_null()) experiment["time"]["corners"] = corners;
    const Problem of = problem(experiment);
    const SolveError error(SolveError::Reason::disconnected, "discretize-first", 0.0, 1.0,
                           "has no solution.");
    return failure_in_words(error, of.experiment, of.ladder, of.ladder.point);
  };
  const std::string said = "discretize-first: the step of 1 from t = 0 has no solution.";
  const std::string switched = "p_q^2/2 + if(t < 0.5, 1, 3)*q",
                    by_state = "p_q^2/2 + if(q < 9, q, 9)";
  BOOST_TEST(disconnected(switched, nullptr).starts_with(said + " The solution jumps"));
  BOOST_TEST(disconnected(switched, nullptr).find("/time/corners") != std::string::npos);
  BOOST_TEST(disconnected(switched, {0.5}) == said);
  BOOST_TEST(disconnected(by_state, nullptr) == said);
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
