#include "courant/running/step_watch.hpp"

#include <boost/test/unit_test.hpp>

#include "run_in.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(step_watch_test)

// Mistakes that these cases have to notice:
//  * steps that turn are not looked at
//  * a step whose parts end apart goes on
//  * a step whose parts cannot be made goes on
//  * steps that turn are no steps of a solution

namespace {

Json equations(const Json& coordinates, const Json& equations, const Json& initial,
               const char* method, double step, double end) {
  return {
      {"system", {{"type", "implicit"}, {"coordinates", coordinates}, {"equations", equations}}},
      {"initial", initial},
      {"method", method},
      {"time", {{"step", step}, {"end", end}}}};
}

Json kepler(const Json& initial, const char* method, double step, double end) {
  return {{"system",
           {{"type", "hamiltonian"},
            {"coordinates", {"x", "y"}},
            {"hamiltonian", "(p_x^2+p_y^2)/2-1/sqrt(x^2+y^2)"}}},
          {"initial", initial},
          {"method", method},
          {"time", {{"step", step}, {"end", end}}}};
}

RunOutcome outcome(const Json& experiment) {
  const TemporaryFolder folder;
  return run_in(folder, experiment);
}

}  // namespace

// x = (1 - t)⁻¹ ends at t = 1, y = (1 - 2t)^½ at t = ½, and a planet at rest arrives at the sun at t = π/√8 = 1.1107.
BOOST_AUTO_TEST_CASE(explicit_steps_end_where_the_solution_does) {
  for (const char* method : {"rk2", "rk4", "dopri5"}) {
    const auto check = [&](const Json& experiment, double end, double late) {
      const RunOutcome run = outcome(experiment);
      BOOST_TEST_CONTEXT(method << ", " << experiment << ": " << run.message) {
        BOOST_TEST((run.status == RunStatus::failed));
        BOOST_TEST(run.summary.steps > 0);
        const double step = experiment["time"]["step"];
        const double reached = static_cast<double>(run.summary.steps) * step;
        BOOST_TEST(reached >= end - step);
        BOOST_TEST(reached <= end + late);
      }
    };
    check(equations({"x"}, {"x'-x^2"}, {{"x", 1}}, method, 0.013, 1.3), 1.0, 0.02);
    check(equations({"y"}, {"y*y'+1"}, {{"y", 1}}, method, 0.01, 1), 0.5, 0.05);
    check(kepler({{"x", 1}, {"y", 0}, {"p_x", 0}, {"p_y", 0}}, method, 0.01, 2), 1.1107, 0.02);
  }
}

// x'² = x from x' = -1 comes to x = 0 at t = 2, where x' = ±√x branch: a step that leads to the other branch is none, though
// x = (1 - t/2)² goes on there. x'² = 1 - x² has such points at x = ±1.
BOOST_AUTO_TEST_CASE(explicit_steps_end_where_solutions_branch) {
  for (const char* method : {"rk2", "rk4", "dopri5", "rkf78"})
    for (const double step : {0.1, 0.05, 0.01, 0.001}) {
      const RunOutcome run =
          outcome(equations({"x"}, {"x'^2-x"}, {{"x", 1}, {"x'", -1}}, method, step, 3));
      BOOST_TEST_CONTEXT(method << ", " << step << ": " << run.message) {
        BOOST_TEST((run.status == RunStatus::failed));
        const double reached = static_cast<double>(run.summary.steps) * step;
        BOOST_TEST(reached >= 2.0 - 1.5 * step);
        BOOST_TEST(reached <= 2.0 + 1.5 * step);
      }
    }
}

// Close encounters that are resolved, oscillations, relaxation and a relay turn as well.
BOOST_AUTO_TEST_CASE(steps_that_turn_go_on) {
  for (const char* method : {"rk2", "rk4", "dopri5"})
    for (const Json& experiment :
         {kepler({{"x", 1.9}, {"y", 0}, {"p_x", 0}, {"p_y", 0.2294}}, method, 0.001, 7),
          equations({"x", "v"}, {"x'-v", "v'+x"}, {{"x", 1}, {"v", 0}}, method, 0.5, 20),
          equations({"x", "v"}, {"x'-v", "v'-20*(1-x^2)*v+x"}, {{"x", 2}, {"v", 0}}, method, 0.01,
                    40),
          equations({"x", "v"}, {"x'-v", "v'+sign(x)"}, {{"x", 1}, {"v", 0}}, method, 0.05, 10)}) {
      const RunOutcome run = outcome(experiment);
      BOOST_TEST((run.status == RunStatus::completed), method << ": " << run.message);
    }
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
