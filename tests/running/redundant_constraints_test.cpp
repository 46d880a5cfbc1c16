// Constraints that follow from others, with Method 2: steps do without them, and look whether they hold.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/solve/unknown_selection.hpp"
#include "courant/integrators/step/solve_error.hpp"
#include "courant/integrators/step/step_formulas.hpp"
#include "problems.hpp"

// Mistakes that these cases have to notice:
//  * steps solve what follows from the rest (integrators/methods/constrain_first_trace.cpp)
//  * what has ceased to follow, or is said too weakly, is forgotten (integrators/methods/constrain_first.cpp)
//  * multipliers that are held have other values in the state (integrators/methods/constrain_first.cpp)
//  * a field that leaves unknowns open has another velocity (integrators/step/vector_field.cpp)
BOOST_AUTO_TEST_SUITE(redundant_constraints)

using namespace courant;
using test::Problem;

namespace {

const Json kMethod2 = "constrain-first";

Json mechanical(const Json& coordinates, const char* potential, const Json& holonomic,
                const Json& initial) {
  return {{"system",
           {{"type", "mechanical"},
            {"coordinates", coordinates},
            {"potential", potential},
            {"holonomic", holonomic}}},
          {"initial", initial}};
}

// A plate that hangs on rods of length 1 from (0, 0), (1, 0) and (2, 0), as a pendulum that does not turn.
Problem plate(std::size_t rods) {
  const std::vector<const char*> all = {"x^2 + y^2 - 1", "(x + cos(a) - 1)^2 + (y + sin(a))^2 - 1",
                                        "(x + 2*cos(a) - 2)^2 + (y + 2*sin(a))^2 - 1"};
  Json holonomic = Json::array();
  for (std::size_t i = 0; i < rods; ++i) holonomic.push_back(all[i]);
  return test::problem(mechanical(
      {"x", "y", "a"}, "9.81*y", holonomic,
      {{"x", std::sin(0.7)}, {"y", -std::cos(0.7)}, {"a", 0}, {"p_x", 0}, {"p_y", 0}, {"p_a", 0}}));
}

// A particle of unit mass along y = 0, which two constraints say; from x = 0 with velocity 1.
Problem along_a_line(const char* first, const char* second, const char* potential = "0*x") {
  return test::problem(mechanical({"x", "y"}, potential, {first, second},
                                  {{"x", 0}, {"y", 0}, {"p_x", 1}, {"p_y", 0}}));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_third_rod_changes_nothing) {
  const Problem two = plate(2), three = plate(3);
  BOOST_TEST((three.ladder.verdict == Verdict::regular));
  BOOST_TEST(!three.ladder.redundancies.empty());
  const PreparedMethod method = three.prepare(kMethod2, 0.01);
  for (const StepFormulas& formulas : method.integrator->formulas()) {
    BOOST_TEST(!formulas.redundant.empty());
    BOOST_TEST(explanation(formulas).find("left out, since it follows from the others: ") !=
               std::string::npos);
    const Function whole = formulas.whole();
    BOOST_TEST(std::ssize(ContainedUnknowns(whole).places) == whole.output_size());
  }
  const VectorXd with = three.end(kMethod2, 2.0, 200), without = two.end(kMethod2, 2.0, 200);
  BOOST_TEST((with - without).norm() < 1e-11);
  // The field has the pendulum's velocity: x = sin θ, θ'' = -g sin θ, by an explicit method.
  const VectorXd fine = three.end("dopri5", 2.0, 2000);
  const Problem angle = test::problem({{"system",
                                        {{"type", "hamiltonian"},
                                         {"coordinates", {"q"}},
                                         {"hamiltonian", "p_q^2/2 - 9.81*cos(q)"}}},
                                       {"initial", {{"q", 0.7}, {"p_q", 0}}}});
  const VectorXd exact = angle.end("dopri5", 2.0, 2000);
  BOOST_TEST(std::abs(fine[0] - std::sin(exact[0])) < 1e-9);
  BOOST_TEST(std::abs(fine[1] + std::cos(exact[0])) < 1e-9);
  BOOST_TEST(std::abs(with[0] - std::sin(exact[0])) < 1e-2);
}

// y = 0 twice: the multipliers share the force, and what one of them is held at the other one adds to.
BOOST_AUTO_TEST_CASE(multipliers_that_are_held_carry_their_share) {
  const Problem line = along_a_line("y", "2*y", "9.81*y + x*y");
  const PreparedMethod method = line.prepare(kMethod2, 0.1);
  const auto stepper = method.integrator->stepper();
  State state = method.initial;
  state.z.tail(2).setConstant(5.0);  // of another run
  for (int k = 0; k < 10; ++k) {
    stepper->step(state, 0.1);
    BOOST_TEST_REQUIRE(state.z.size() == 4);  // velocities, then multipliers
    BOOST_TEST(std::abs(state.z[2] + 2.0 * state.z[3] + 9.81 + state.x[0]) < 1e-10);
    const State& stage = stepper->last().stage;
    BOOST_TEST(std::abs(stage.z[2] + 2.0 * stage.z[3] + 9.81 + stage.x[0]) < 1e-10);
  }
}

// Cranks that go round: of each, x = ℓ cos c and y = ℓ sin c say nothing of c in turn, and one of them is left out of three.
BOOST_AUTO_TEST_CASE(what_is_left_may_say_little_for_a_while) {
  const Problem cranks = test::problem(mechanical(
      {"x", "y", "a", "b", "c"}, "2*y",
      {"x - cos(a)", "y - sin(a)", "x - cos(b)", "y - sin(b)", "x - cos(c)", "y - sin(c)"},
      {{"x", "cos(0.4)"},
       {"y", "sin(0.4)"},
       {"a", 0.4},
       {"b", 0.4},
       {"c", 0.4},
       {"a'", 3.0},
       {"b'", 3.0},
       {"c'", 3.0}}));
  const PreparedMethod method = cranks.prepare(kMethod2, 0.01);
  const auto stepper = method.integrator->stepper();
  State state = method.initial;
  double off = 0.0, momenta = 0.0;
  for (int k = 0; k < 500; ++k) {
    stepper->step(state, 0.01);
    const VectorXd& x = state.x;
    for (const Index crank : {2, 3, 4}) {
      off =
          std::max({off, std::abs(x[0] - std::cos(x[crank])), std::abs(x[1] - std::sin(x[crank]))});
      momenta = std::max(momenta, std::abs(x[5] + std::sin(x[crank]) * x[5 + crank]));
    }
  }
  BOOST_TEST(off < 1e-13);
  // What is left of y = sin c determines c' by y'/cos c: to fewer digits where a crank stands.
  BOOST_TEST(momenta < 1e-10);
  BOOST_TEST(std::abs(state.x[2] - 0.4) > 6.0);  // they went round
}

// From x = 1 on the second constraint contradicts the first, from which it followed before.
BOOST_AUTO_TEST_CASE(what_ceases_to_follow_is_seen) {
  for (const bool exchanged : {false, true}) {
    const char *line = "y", *bent = "y + max(x - 1, 0)^4";
    const Problem problem = exchanged ? along_a_line(bent, line) : along_a_line(line, bent);
    const PreparedMethod method = problem.prepare(kMethod2, 0.05);
    const auto stepper = method.integrator->stepper();
    State state = method.initial;
    bool goes_on = true;
    for (int k = 0; goes_on && k < 40; ++k) {
      try {
        stepper->step(state, 0.05);
      } catch (const SolveError&) {
        goes_on = false;
      }
    }
    BOOST_TEST(!goes_on);
    BOOST_TEST(state.x[0] > 0.9);
    BOOST_TEST(state.x[0] < 1.1);
  }
}

// The one of the two that says nothing at x = 1 must not be missed by the other: y = 0 all the way.
BOOST_AUTO_TEST_CASE(a_constraint_that_says_nothing_at_a_point_is_passed) {
  for (const bool exchanged : {false, true}) {
    const char *line = "y", *weak = "(x - 1)*y";
    const Problem problem =
        exchanged ? along_a_line(weak, line, "y") : along_a_line(line, weak, "y");
    for (const double h : {0.1, 0.03}) {
      const PreparedMethod method = problem.prepare(kMethod2, h);
      const auto stepper = method.integrator->stepper();
      State state = method.initial;
      const long steps = std::lround(2.0 / h);
      for (long k = 0; k < steps; ++k) stepper->step(state, h);
      BOOST_TEST(std::abs(state.x[0] - h * static_cast<double>(steps)) < 1e-9);
      BOOST_TEST(std::abs(state.x[1]) < 1e-12);
      BOOST_TEST(std::abs(state.x[3]) < 1e-9);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
