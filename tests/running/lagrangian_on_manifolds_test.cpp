// Lagrangian systems on curved configuration spaces next to the Hamiltonian ones with the same
// motions: their momenta are those of the given velocities, and the trajectories agree.
#include <boost/test/unit_test.hpp>

#include "problems.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(lagrangian_on_manifolds)

namespace {

using test::method_1, test::method_2;

const Json kEllipsoid = {{"type", "implicit-submanifold"},
                         {"equations", {"x[0]^2 + x[1]^2/2 + x[2]^2/4 - 1"}}};
const Json kTurned = {{0.6, -0.8, 0}, {0.8, 0.6, 0}, {0, 0, 1}};

struct Pair {
  std::string space;
  Json lagrangian, hamiltonian;
};

Pair pair(const std::string& name, const Json& space, const Json& coordinates, const char* L,
          const char* H, const Json& from_velocities, const Json& from_momenta) {
  return {name,
          {{"system",
            {{"type", "lagrangian"},
             {"manifold", space},
             {"coordinates", coordinates},
             {"lagrangian", L}}},
           {"initial", from_velocities}},
          {{"system",
            {{"type", "hamiltonian"},
             {"manifold", {{"type", "cotangent-bundle"}, {"base", space}}},
             {"coordinates", coordinates},
             {"hamiltonian", H}}},
           {"initial", from_momenta}}};
}

// Momenta longer than the injectivity radius of the space among them: the search for them has to
// go as far along the fibre.
std::vector<Pair> pairs() {
  const char* kinetic = "dot(x', x')/2 - x[2] + x[0]*x[1]";
  const char* energy = "dot(p_x, p_x)/2 + x[2] - x[0]*x[1]";
  const Json on_sphere = {{"x", {0.6, 0, 0.8}}, {"x'", {4, 1.5, -3}}};
  const Json sphere_momenta = {{"x", {0.6, 0, 0.8}}, {"p_x", {4, 1.5, -3}}};
  return {
      pair("S²", "sphere", {"x[3]"}, kinetic, energy, on_sphere, sphere_momenta),
      pair("an ellipsoid", kEllipsoid, {"x[3]"}, kinetic, energy,
           {{"x", {0.6, 0, 1.6}}, {"x'", {0.8, 2, -1.2}}},
           {{"x", {0.6, 0, 1.6}}, {"p_x", {0.8, 2, -1.2}}}),
      // R' = R v̂ with v = (0.3, -4, 1); the kinetic energy v_0² + v_1² + v_2² is that of inertia 2.
      pair("SO(3)", "so3", {"R[3][3]"}, "sum(i, 0, 2, dot(R[i]', R[i]'))/2 - R[2][2]",
           "dot(p_R, p_R)/4 + R[2][2]",
           {{"R", kTurned}, {"R'", {{-0.8, -0.6, -2.16}, {0.6, -0.8, -3.38}, {4, 0.3, 0}}}},
           {{"R", kTurned}, {"p_R", {0.6, -8, 2}}}),
  };
}

}  // namespace

BOOST_AUTO_TEST_CASE(agree_with_hamiltonians) {
  for (const Pair& both : pairs()) {
    const auto first = test::problem(both.lagrangian), second = test::problem(both.hamiltonian);
    BOOST_TEST((first.ladder.verdict == Verdict::regular), both.space);
    BOOST_TEST(first.ladder.degrees_of_freedom == second.ladder.degrees_of_freedom, both.space);
    BOOST_TEST((first.ladder.point.x - second.ladder.point.x).norm() < 1e-10, both.space);
    for (const Json& method : {method_1("midpoint"), method_2("midpoint"), Json("dopri5")}) {
      const VectorXd a = first.end(method, 1.0, 100), b = second.end(method, 1.0, 100);
      BOOST_TEST((a - b).norm() < 1e-9, both.space << ", " << method.dump());
      BOOST_TEST((b - second.ladder.point.x).norm() > 0.1);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
