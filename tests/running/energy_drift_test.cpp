#include <boost/test/unit_test.hpp>

#include "run_in.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * displacements are solved for next to coordinates that no equation contains
//    (integrators/step/displacement_stepper.cpp)
BOOST_AUTO_TEST_SUITE(energy_drift)

// A free body in space, far from the origin: its equations do not contain its place, so that its energy is kept as
// near the origin. Displacements that are solved for next to the distance leave errors with a direction, 1e-11 in
// so many steps, and 2e-9 in a million from the origin.
BOOST_AUTO_TEST_CASE(a_place_that_no_equation_contains_has_no_effect) {
  for (const double distance : {0.0, 1e4, 1e6}) {
    Json experiment = Json::parse(R"json({
      "system": {"type": "hamiltonian", "manifold": {"type": "cotangent-bundle", "base": "se3"},
                 "coordinates": ["R[3][3]", "r[3]"],
                 "hamiltonian": "(dot(p_R, p_R) + dot(p_r, p_r))/2"},
      "initial": {"R": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "p_R": [0, 0, 1],
                  "p_r": [1, 0, 0.5]},
      "method": {"type": "discretize-first", "discretization": "exponential"},
      "time": {"step": 0.02, "end": 200}, "output": {"every": 1000}})json");
    experiment["initial"]["r"] = {distance, 1, 0};
    const TemporaryFolder folder;
    const RunOutcome outcome = run_in(folder, experiment);
    BOOST_REQUIRE((outcome.status == RunStatus::completed));
    BOOST_TEST(outcome.summary.observable("H")->max_drift < 1e-12, distance);
  }
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
