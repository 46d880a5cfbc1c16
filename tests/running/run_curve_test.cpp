#include "courant/running/run_curve.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/running/run_in_memory.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(run_curve)

namespace {

Json oscillator(double end) {
  return {{"system",
           {{"type", "hamiltonian"}, {"coordinates", {"q"}}, {"hamiltonian", "(p_q^2 + q^2)/2"}}},
          {"initial", {{"q", 1}, {"p_q", 0}}},
          {"method", "discretize-first"},
          {"time", {{"step", 0.1}, {"end", end}}}};
}

std::shared_ptr<RunCurve> curve_of(const Json& experiment) {
  RunInMemoryOptions options;
  options.run.backend = Backend::interpreter;
  options.has_curve = true;
  return run_in_memory(read_experiment_document(experiment), options).curve;
}

}  // namespace

// A part of a step by the midpoint rule turns by the angle of a step of its size.
BOOST_AUTO_TEST_CASE(rows_between_steps_are_those_of_shorter_steps) {
  const auto curve = curve_of(oscillator(2));
  BOOST_REQUIRE(curve != nullptr);
  BOOST_TEST(curve->first() == 0.0);
  BOOST_TEST(curve->last() == 2.0);
  BOOST_TEST(curve->names()[1] == "p_q");
  for (const double t : {0.0, 0.03, 0.1, 1.999, 2.0}) {
    const double steps = std::floor(t / 0.1 + 1e-9);
    const double angle = steps * 2 * std::atan(0.05) + 2 * std::atan((t - steps * 0.1) / 2);
    BOOST_TEST(std::abs((*curve)(t)[0] - std::cos(angle)) < 1e-13);
    BOOST_TEST(std::abs((*curve)(t)[1] + std::sin(angle)) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(there_is_nothing_beyond_the_ends) {
  const auto curve = curve_of(oscillator(1));
  BOOST_CHECK_THROW((*curve)(1.01), std::invalid_argument);
  BOOST_CHECK_THROW((*curve)(-0.01), std::invalid_argument);
}

// In a time with dt/dτ = 2 steps of 0.1 in τ are steps of 0.2 in t.
BOOST_AUTO_TEST_CASE(steps_may_be_those_of_another_time) {
  Json experiment = oscillator(2);
  experiment["time"]["transformation"] = "2";
  const auto curve = curve_of(experiment);
  for (const double t : {0.05, 0.5, 1.9}) {
    const double steps = std::floor(t / 0.2 + 1e-9);
    const double angle = steps * 2 * std::atan(0.1) + 2 * std::atan((t - steps * 0.2) / 2);
    BOOST_TEST(std::abs((*curve)(t)[0] - std::cos(angle)) < 1e-12);
  }
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
