#include "courant/running/start_moves.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/running/consistent_start.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(start_moves_test)

// Mistakes that these cases have to notice:
//  * a start may be anywhere
//  * rounding is a warning
//  * a run begins where a search was lost

namespace {

Json pendulum(const Json& initial) {
  return {{"system",
           {{"type", "mechanical"},
            {"coordinates", {"x", "y"}},
            {"potential", "9.81*y"},
            {"holonomic", "x^2 + y^2 - 1"}}},
          {"initial", initial},
          {"method", {{"type", "constrain-first"}}},
          {"time", {{"step", 0.01}, {"end", 0.1}}}};
}

StartMoves moves(const Json& experiment) {
  const Experiment read = read_experiment(experiment.dump());
  return start_moves(read, consistent_start(read));
}

}  // namespace

BOOST_AUTO_TEST_CASE(rounding_is_no_warning) {
  const StartMoves found =
      moves(pendulum({{"x", 0.8415}, {"y", -0.5403}, {"x'", 0.7024}, {"y'", 1.0939}}));
  BOOST_TEST(found.warning == "");
  BOOST_TEST(found.refusal == "");
}

BOOST_AUTO_TEST_CASE(more_than_rounding_is_a_warning) {
  const StartMoves found =
      moves(pendulum({{"x", 0.8415}, {"y", -0.5403}, {"x'", 0.7524}, {"y'", 1.0939}}));
  BOOST_TEST(found.warning.find("The initial velocities had to move by 0.0421, of 1.33, to be "
                                "consistent (x' from 0.7524 to ") == 0u,
             found.warning);
  BOOST_TEST(found.warning.find("positions") == std::string::npos);
  BOOST_TEST(found.refusal == "");
}

// The end of a search that found nothing is no start where it is farther away than the given values are large.
BOOST_AUTO_TEST_CASE(where_a_search_was_lost_nothing_starts) {
  Json experiment = pendulum({{"x", 0.8415}, {"y", -0.5403}, {"x'", 0.0}, {"y'", 0.0}});
  const Experiment read = read_experiment(experiment.dump());
  ConsistentStart start = consistent_start(read);
  start.verdict = Verdict::not_reached;
  start.moves.clear();
  BOOST_TEST(start_moves(read, start).refusal == "");
  start.point.x[1] = 2875.0;
  const std::string refusal = start_moves(read, start).refusal;
  BOOST_TEST(refusal.find("no consistent start was found: the search for one left the initial "
                          "positions by 2.88e+03, of 1 (y from -0.5403 to 2875") == 0u,
             refusal);
  start.verdict = Verdict::inconsistent;
  BOOST_TEST(start_moves(read, start).refusal == "");
  start.verdict = Verdict::not_reached;
  experiment["start"] = "nearest";
  BOOST_TEST(start_moves(read_experiment(experiment.dump()), start).refusal == "");
}

// Of a value that moved by more than a tenth nobody knows what was meant, unless something says so.
BOOST_AUTO_TEST_CASE(more_than_a_tenth_is_a_refusal) {
  Json experiment = pendulum({{"x", 0.8}, {"y", -1.1}, {"x'", 0.0}, {"y'", 0.0}});
  BOOST_TEST(
      moves(experiment).refusal.find("the initial positions had to move by 0.36, of 1.36, ") == 0u,
      moves(experiment).refusal);
  BOOST_CHECK_THROW(start_of_run(read_experiment(experiment.dump())), ExperimentError);
  experiment["start"] = "nearest";
  BOOST_TEST(moves(experiment).refusal == "");
  BOOST_TEST(!moves(experiment).warning.empty());
  BOOST_CHECK_NO_THROW(start_of_run(read_experiment(experiment.dump())));
  experiment.erase("start");
  Json without = experiment;
  without.erase("method");
  without.erase("time");
  BOOST_CHECK_NO_THROW(start_of_run(read_experiment(without.dump())));
  experiment["hold"] = {"x"};
  BOOST_TEST(moves(experiment).refusal == "");
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
