#include "courant/running/energy_watch.hpp"

#include <boost/test/unit_test.hpp>

#include "run_in.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(energy_watch_test)

namespace {

Json mechanical(const Json& coordinates, const char* potential, const Json& holonomic,
                const Json& initial, double step) {
  return {{"system",
           {{"type", "mechanical"},
            {"coordinates", coordinates},
            {"potential", potential},
            {"holonomic", holonomic}}},
          {"initial", initial},
          {"method", {{"type", "discretize-first"}}},
          {"time", {{"step", step}, {"end", 1}}}};
}

}  // namespace

// Method 1 leaves its states beside the constraints by its order, and shorter steps from such a state go
// from one side to the other. From the start H converges: to what it is where it is conserved, and
// where a wire that turns does work.
BOOST_AUTO_TEST_CASE(what_steps_beside_the_constraints_do_to_the_energy_is_no_finding) {
  const std::vector<Json> problems = {
      mechanical({"x", "y"}, "y", {"x^2 + y^2 - 1", "2*x^2 + 2*y^2 - 2"},
                 {{"x", 1}, {"y", 0}, {"x'", 0}, {"y'", 0}}, 0.01),
      mechanical({"x1", "y1", "x2", "y2"}, "9.81*(y1+y2)",
                 {"x1^2 + y1^2 - 1", "(x2-x1)^2 + (y2-y1)^2 - 1"},
                 {{"x1", 1},
                  {"y1", 0},
                  {"x2", 2},
                  {"y2", 0},
                  {"x1'", 0},
                  {"y1'", 0},
                  {"x2'", 0},
                  {"y2'", 0}},
                 0.002),
      mechanical({"x", "y"}, "0", {"x*sin(1.3*t) - y*cos(1.3*t)"}, {{"x", 1}, {"y", 0}, {"x'", 0}},
                 0.01)};
  for (const Json& problem : problems) {
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, problem);
    BOOST_TEST((outcome.status == RunStatus::completed));
    for (const std::string& warning : outcome.summary.warnings) BOOST_TEST(warning == "");
  }
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
