// One motion in three formulations: canonical on a cotangent bundle, with holonomic constraints and
// their multipliers, and port-Hamiltonian. By order 8 they end in one place. Each route knows nothing
// of the others.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "problems.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(formulations)

namespace {

// The end by order 8, Method 2 where there are constraints.
VectorXd end_of(const Json& system, const Json& initial, const char* method, double time,
                long steps) {
  return test::problem({{"system", system}, {"initial", initial}})
      .end({{"type", method}, {"order", 8}}, time, steps);
}
VectorXd end_of(const std::string& name, const char* method, double time, long steps) {
  const Json file = test::experiment_file(name);
  return end_of(file.at("system"), file.at("initial"), method, time, steps);
}

}  // namespace

// m = 2, l = 1.5, released at rest at the horizontal.
BOOST_AUTO_TEST_CASE(of_a_pendulum) {
  const double theta = end_of("pendulum_angle", "discretize-first", 2.0, 200)[0];
  const Eigen::Vector2d expected = 1.5 * Eigen::Vector2d(std::sin(theta), -std::cos(theta));
  BOOST_TEST(expected[1] < -0.1);
  for (const char* name : {"pendulum_holonomic", "pendulum_port_hamiltonian"}) {
    const VectorXd end = end_of(name, "constrain-first", 2.0, 200);
    BOOST_TEST((end.head(2) - expected).norm() < 1e-9,
               name << " is off by " << (end.head(2) - expected).norm());
  }
}

// Of unequal masses and rods, at rest at large angles.
BOOST_AUTO_TEST_CASE(of_a_double_pendulum) {
  const VectorXd angles = end_of("double_pendulum", "discretize-first", 1.0, 100);
  const auto rod = [](double length, double angle) -> Eigen::Vector2d {
    return length * Eigen::Vector2d(std::sin(angle), -std::cos(angle));
  };
  const Eigen::Vector2d first = rod(0.9, angles[0]), second = first + rod(0.7, angles[1]);
  for (const char* name : {"double_pendulum_holonomic", "double_pendulum_port_hamiltonian"}) {
    const VectorXd end = end_of(name, "constrain-first", 1.0, 100);
    const double off = (end.head(2) - first).norm() + (end.segment(2, 2) - second).norm();
    BOOST_TEST(off < 1e-9, name << " is off by " << off);
  }
}

// I = (1, 1.2, 0.6), its centre of mass beside the axes: on T*SO(3), as a matrix with six equations, and
// with the Lie–Poisson matrix J of e(3)*.
BOOST_AUTO_TEST_CASE(of_a_heavy_top) {
  const Json file = test::experiment_file("heavy_top_so3");
  const VectorXd on_group =
      end_of(file.at("system"), file.at("initial"), "discretize-first", 1.0, 20);
  const VectorXd expected = on_group.segment(6, 3);

  Json parameters = file.at("system").at("parameters");
  parameters["J"] = {"(I[1] + I[2] - I[0])/2", "(I[2] + I[0] - I[1])/2", "(I[0] + I[1] - I[2])/2"};
  parameters["o"] = {"0.3/I[0]", "-0.2/I[1]", "2/I[2]"};
  Json metric = Json::array(), constraints = Json::array(), velocities = Json::array();
  for (int i = 0; i < 9; ++i) metric.push_back("J[" + std::to_string(i % 3) + "]");
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const std::string a = std::to_string(i), b = std::to_string(j);
      constraints.push_back("sum(k, 0, 2, R[k][" + a + "]*R[k][" + b + "]) - " +
                            (i == j ? "1" : "0"));
    }
  const Json matrix = {
      {"type", "mechanical"},       {"parameters", parameters},
      {"coordinates", {"R[3][3]"}}, {"metric", metric},
      {"potential", "dot(w, G)"},   {"definitions", {{"G", {"R[2][0]", "R[2][1]", "R[2][2]"}}}},
      {"holonomic", constraints}};
  Json initial = {{"R", file.at("initial").at("R")}};
  for (int i = 0; i < 3; ++i) {  // R' = R × o
    const std::string row = "Q[" + std::to_string(i) + "]", place = "R[" + std::to_string(i) + "]";
    initial[place + "[0]'"] = row + "[1]*o[2] - " + row + "[2]*o[1]";
    initial[place + "[1]'"] = row + "[2]*o[0] - " + row + "[0]*o[2]";
    initial[place + "[2]'"] = row + "[0]*o[1] - " + row + "[1]*o[0]";
  }
  const VectorXd held = end_of(matrix, initial, "constrain-first", 1.0, 20);
  BOOST_TEST((held.head(9) - on_group.head(9)).norm() < 1e-9,
             "held by multipliers it is off by " << (held.head(9) - on_group.head(9)).norm());

  const Json lie_poisson = test::experiment_file("heavy_top_lie_poisson");
  const Json& structure = lie_poisson.at("system").at("structure");
  const Json ports = {{"type", "port-hamiltonian"},
                      {"parameters", lie_poisson.at("system").at("parameters")},
                      {"coordinates", {"P[3]", "G[3]"}},
                      {"J", structure.at("matrix")},
                      {"hamiltonian", lie_poisson.at("system").at("hamiltonian")}};
  const VectorXd reduced = end_of(ports, lie_poisson.at("initial"), "discretize-first", 1.0, 20);
  BOOST_TEST((reduced.tail(3) - expected).norm() < 1e-9,
             "port-Hamiltonian it is off by " << (reduced.tail(3) - expected).norm());
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
