// Lagrangian systems on curved configuration spaces next to the Hamiltonian ones with the same
// motions: their momenta are those of the given velocities, and the trajectories agree.
#include <boost/test/unit_test.hpp>

#include "courant/running/run_in_memory.hpp"
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
      // z' = v_z + x v_y.
      pair("Heisenberg's group", "heisenberg", {"x", "y", "z"}, "(x'^2 + y'^2)/2 + v_z^2 - z",
           "(p_x^2 + p_y^2)/2 + p_z^2/4 + z",
           {{"x", 1.5}, {"y", 0}, {"z", 0.2}, {"x'", 1}, {"y'", 0.4}, {"z'", 0.7}},
           {{"x", 1.5}, {"y", 0}, {"z", 0.2}, {"p_x", 1}, {"p_y", 0.4}, {"p_z", 0.2}}),
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

// Of velocities that are not the components of tangent vectors one alone says little, and is not taken for a component.
BOOST_AUTO_TEST_CASE(velocities_are_not_components_where_both_are_as_many) {
  Json document{
      {"system",
       {{"type", "mechanical"}, {"manifold", "heisenberg"}, {"coordinates", {"x", "y", "z"}}}},
      {"initial", {{"x", 1}, {"y", 0}, {"z", 0}, {"v_x", 1}, {"v_y", 0.5}, {"v_z", 0.7}}},
      {"observe", {{"rate", "z'"}}},
      {"method", "discretize-first"},
      {"time", {{"step", 0.1}, {"end", 0.1}}}};
  const auto rate = [&] {
    const Experiment experiment = read_experiment(document.dump());
    return run_in_memory(experiment).rows.column("rate").front();
  };
  BOOST_TEST(std::abs(rate() - 1.2) < 1e-14);
  document["initial"] = {{"x", 1}, {"y", 0}, {"z", 0}, {"p_x", 1}, {"p_y", 0.5}, {"z'", 0.7}};
  BOOST_CHECK_EXCEPTION(rate(), ExperimentError, [](const ExperimentError& error) {
    return std::string(error.what()).find("(z' from 0.7") != std::string::npos;
  });
  document["initial"] = {{"x", 1}, {"y", 0}, {"z", 0}, {"v_z", 0.7}, {"rest", true}};
  BOOST_TEST(std::abs(rate() - 0.7) < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
