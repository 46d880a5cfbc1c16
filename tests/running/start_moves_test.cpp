#include "courant/running/start_moves.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/running/consistent_start.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(start_moves_test)

// Mistakes that these cases have to notice:
//  * a start may be anywhere
//  * rounding is a warning
//  * a run begins where a search was lost
//  * what is round-off next to a move is told as a move
//  * few digits allow to move by any part without a word (running/start_moves.cpp)
//  * units made of round-off hide constraints, so that no start is shown to be the nearest
//    (integrators/certificate/least_deviation.cpp)

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

// x = 1 and y = 2 are kept, so that x + y is 3 and not 4.
BOOST_AUTO_TEST_CASE(a_quantity_that_contradicts_what_is_given_is_a_warning) {
  Json experiment = {{"system",
                      {{"type", "lagrangian"},
                       {"coordinates", {"x", "y"}},
                       {"definitions", {{"s", "x + y"}}},
                       {"lagrangian", "(x'^2 + y'^2)/2"}}},
                     {"initial", {{"x", 1}, {"y", 2}, {"s", 4}, {"rest", true}}}};
  const std::string warning = moves(experiment).warning;
  BOOST_TEST(warning ==
             "The initial value of s had to move by 1, of 4, to be consistent (s from 4 to 3), "
             "which is more than rounding.");
  experiment["initial"]["s"] = 3;
  BOOST_TEST(moves(experiment).warning == "");
  experiment["initial"] = {{"x", 1}, {"y", -1}, {"s", 0}, {"rest", true}};
  BOOST_TEST(moves(experiment).warning == "");
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

// A bead on a hoop that turns by 8 a second moves along, whatever is typed; round-off of its other velocities is no move.
BOOST_AUTO_TEST_CASE(round_off_beside_a_move_is_not_told) {
  const StartMoves found =
      moves({{"system",
              {{"type", "lagrangian"},
               {"coordinates", {"x", "y", "z"}},
               {"lagrangian", "(x'^2 + y'^2 + z'^2)/20 - z"},
               {"holonomic", {"x^2 + y^2 + z^2 - 0.0625", "x*sin(8*t) - y*cos(8*t)"}}}},
             {"initial", {{"x", 0.1768}, {"y", 0}, {"z", -0.1768}, {"rest", true}}},
             {"method", {{"type", "constrain-first"}}},
             {"time", {{"step", 0.01}, {"end", 0.1}}}});
  BOOST_TEST(found.refusal.find("(y' from 0 to 1.41421)") != std::string::npos, found.refusal);
}

// (0.6, -0.4) is 1 - √0.52 = 0.279 from the circle, of 0.721, in one digit as in four. One digit leaves that open.
BOOST_AUTO_TEST_CASE(few_digits_move_far_with_a_word) {
  const StartMoves in_four = moves(pendulum({{"x", 0.6001}, {"y", -0.4}, {"rest", true}})),
                   in_one = moves(pendulum({{"x", 0.6}, {"y", -0.4}, {"rest", true}}));
  BOOST_TEST(in_four.refusal.find("the initial positions had to move by 0.279, of 0.721, ") == 0u);
  BOOST_TEST(in_one.refusal == "");
  BOOST_TEST(in_one.warning.find("The initial positions had to move by 0.279, of 0.721, ") == 0u,
             in_one.warning);
  BOOST_TEST(in_one.warning.ends_with("more than a tenth, though within its digits."));
  // Here the digits leave open what moves, a twentieth: (0.6, -0.7) is 0.078 from the circle.
  const StartMoves found = moves(pendulum({{"x", 0.6}, {"y", -0.7}, {"rest", true}}));
  BOOST_TEST(found.warning == "");
  BOOST_TEST(found.refusal == "");
}

// The nearest point of x² + y² = 1 to (a, -a) is (1, -1) / √2.
BOOST_AUTO_TEST_CASE(a_rounded_start_at_rest_is_shown_to_be_the_nearest) {
  const Json experiment = {
      {"system",
       {{"type", "implicit"},
        {"coordinates", {"x", "y", "vx", "vy"}},
        {"unknowns", {"lam"}},
        {"equations",
         {"x' - vx", "y' - vy", "vx' + 2*lam*x", "vy' + 2*lam*y + 9.81", "x^2 + y^2 - 1"}}}},
      {"initial", {{"x", 0.7071}, {"y", -0.7071}, {"vx", 0}, {"vy", 0}}}};
  const Experiment read = read_experiment(experiment.dump());
  const ConsistentStart start = consistent_start(read);
  BOOST_TEST(start.is_nearest);
  BOOST_TEST((start.point.x - VectorXd{{std::sqrt(0.5), -std::sqrt(0.5), 0.0, 0.0}}).norm() <
             1e-15);
  BOOST_TEST(start_moves(read, start).warning == "");
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
