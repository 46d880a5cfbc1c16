// What the keys of constraints and forces take, and what is said of what they do not.
#include "courant/reading/mechanics_keys.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include "courant/reading/experiment.hpp"
#include "courant/structures/dirac_system.hpp"
#include "experiment_problems.hpp"

// Mistakes that these cases have to notice:
//  * two-forms are taken for symmetric matrices (reading/read_euler_poincare.cpp)
BOOST_AUTO_TEST_SUITE(mechanics_keys_test)

using namespace courant;

namespace {

// A mechanical system with more keys.
Json with(const Json& keys, Json system = {{"type", "mechanical"}, {"coordinates", {"x", "y"}}}) {
  if (keys.is_object()) system.update(keys);
  return {{"system", system}, {"initial", Json::object()}};
}

// p' of a mechanical system with x = 0.3, y = -0.2, x' = 0.7, y' = 1.1 at t = 0.4 without reactions.
VectorXd rates(const Json& keys) {
  const Experiment experiment = read_experiment(with(keys).dump());
  const ImplicitSystem& system = *experiment.model.system;
  const VectorXd w{{0.7, 1.1}};
  VectorXd x(4), v(4), z = VectorXd::Zero(system.auxiliary_size());
  x << 0.3, -0.2, w;
  v << w, 0.0, 0.0;
  z.head(2) = w;
  return -system.residual(x, v, z, 0.4).segment(2, 2);
}

bool equal(const VectorXd& a, const VectorXd& b) { return (a - b).norm() < 1e-15; }

}  // namespace

BOOST_AUTO_TEST_CASE(forces_by_list_and_by_name) {
  BOOST_TEST(equal(rates({{"forces", {"t*x'", "y"}}}), VectorXd{{0.28, -0.2}}));
  BOOST_TEST(equal(rates({{"forces", {{"y", "p_x + x"}}}}), VectorXd{{0.0, 1.0}}));
  BOOST_TEST(equal(rates({{"forces", {{"y", "f"}}}, {"definitions", {{"f", "2*y'"}}}}),
                   VectorXd{{0.0, 2.2}}));
}

BOOST_AUTO_TEST_CASE(damping_by_matrix_diagonal_number_and_rayleigh_function) {
  const VectorXd both{{-2.0 * 0.7 - 1.1, -0.7 - 3.0 * 1.1}};
  BOOST_TEST(equal(rates({{"damping", {{2, 1}, {1, 3}}}}), both));
  BOOST_TEST(equal(rates({{"damping", "x'^2 + x'*y' + 1.5*y'^2"}}), both));
  BOOST_TEST(equal(rates({{"damping", {2, "10*x"}}}), VectorXd{{-1.4, -3.3}}));
  BOOST_TEST(equal(rates({{"damping", "x"}}), VectorXd{{-0.21, -0.33}}));
  BOOST_TEST(equal(rates({{"damping", 2}, {"forces", {1, 1}}}), VectorXd{{-0.4, -1.2}}));
  BOOST_TEST(equal(rates({{"damping", "abs(x')^3/3"}}), VectorXd{{-0.49, 0.0}}));
}

BOOST_AUTO_TEST_CASE(potential_depends_on_time) {
  BOOST_TEST(equal(rates({{"potential", "t*x + y^2"}}), VectorXd{{-0.4, 0.4}}));
}

// Components of velocities have names where the coordinates' velocities are others.
BOOST_AUTO_TEST_CASE(body_velocities) {
  const Json ball = with({{"manifold", {{"type", "product"}, {"factors", {"so3", "euclidean"}}}},
                          {"coordinates", {"R[3][3]", "x[2]"}},
                          {"metric", {1, 2, 3, 4, 5}},
                          {"nonholonomic", {"x[0]' - v_R[1]", "v_x[1] + R[2][1]'"}},
                          {"forces", {{"R", {"v_R[0]", 0, "p_R[2]"}}, {"x", {0, "v_x[0]"}}}}},
                         {{"type", "mechanical"}});
  const Experiment experiment = read_experiment(ball.dump());
  const ImplicitSystem& system = *experiment.model.system;
  const VectorXd w{{0.1, 0.2, 0.3, 0.4, 0.5}};
  VectorXd x(16), v = VectorXd::Zero(10), z = VectorXd::Zero(7);
  x << 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, w.cwiseProduct(VectorXd{{1, 2, 3, 4, 5}});
  v.head(5) = w;
  z.head(5) = w;
  const VectorXd p = x.tail(5);
  const VectorXd residual = system.residual(x, v, z, 0.0);
  // ṗ = p × Ω + F in the body; R[2][1]' = Ω₀ at R = 1.
  const Eigen::Vector3d torque =
      p.head<3>().cross(Eigen::Vector3d(w.head<3>())) + Eigen::Vector3d(w[0], 0.0, p[2]);
  BOOST_TEST((residual.segment(5, 3) + torque).norm() < 1e-14);
  BOOST_TEST(std::abs(residual[9] + w[3]) < 1e-15);
  BOOST_TEST(std::abs(residual[15] - (w[3] - w[1])) < 1e-15);
  BOOST_TEST(std::abs(residual[16] - (w[4] + w[0])) < 1e-15);
  BOOST_TEST(experiment.model.structures.size() == 1u);
  BOOST_TEST(experiment.model.system->names().auxiliary[0] == "v_R[0]");
}

// Multipliers are called lambda in other formulas, unless something else is.
BOOST_AUTO_TEST_CASE(multipliers_have_names) {
  Json experiment = with({{"holonomic", "x^2 + y^2 - 1"}});
  experiment["observe"] = {{"tension", "2*lambda"}};
  BOOST_TEST(problems(experiment) == "");
  experiment["system"]["nonholonomic"] = "x' - y'";
  experiment["observe"] = {{"tension", "lambda[0] + lambda[1]"}};
  BOOST_TEST(problems(experiment) == "");
  experiment["system"]["parameters"] = {{"lambda", 3}};
  experiment["observe"] = {{"tension", "lambda"}};
  BOOST_TEST(problems(experiment) == "");
  experiment["system"].erase("parameters");
  experiment["system"].erase("holonomic");
  experiment["system"].erase("nonholonomic");
  BOOST_TEST(problems(experiment).starts_with("/observe/tension: column 1: unknown name"),
             problems(experiment));
}

BOOST_AUTO_TEST_CASE(what_is_wrong_is_said_with_its_place) {
  const auto problem = [](const Json& keys) { return problems(with(keys)); };
  BOOST_TEST(problem({{"nonholonomic", {"x' - y", "x*y"}}})
                 .starts_with("/system/nonholonomic/1: contains no velocity such as x'"));
  BOOST_TEST(problem({{"nonholonomic", "x'^2 - y'"}})
                 .starts_with("/system/nonholonomic: is not linear in the velocities"));
  BOOST_TEST(problem({{"holonomic", {"x", "2*t"}}})
                 .starts_with("/system/holonomic/1: contains no coordinate"));
  BOOST_TEST(problem({{"holonomic", "x'"}}).starts_with("/system/holonomic: column 1: "));
  BOOST_TEST(
      problem({{"forces", {"1"}}}).starts_with("/system/forces: has 1 formulas; expected 2"));
  BOOST_TEST(problem({{"forces", {{"z", 1}}}})
                 .starts_with("/system/forces/z: key, column 1: unknown name \"z\""));
  BOOST_TEST(problem({{"forces", {{"x", {1, 2}}}}}).starts_with("/system/forces/x: key, "));
  BOOST_TEST(problem({{"forces", {"1", "qq"}}})
                 .starts_with("/system/forces/1: column 1: unknown name \"qq\""));
  BOOST_TEST(problem({{"damping", {{1, 2, 3}, {1, 2, 3}}}})
                 .starts_with("/system/damping: is a 2 × 3 matrix; expected 2 × 2"));
  BOOST_TEST(
      problem({{"damping", {1, 2, 3}}}).starts_with("/system/damping: has 3 entries; expected 2"));
  BOOST_TEST(problem({{"metric", {{1, 2}, {3, 4}}}})
                 .starts_with("/system/metric: is not symmetric at a random point"));
  BOOST_TEST(problem({{"metric", "1 + t"}}).starts_with("/system/metric: column 5: "));
  BOOST_TEST(problem({{"metric", {"1", "x'"}}}).starts_with("/system/metric/1: column 1: "));
  BOOST_TEST(problem({{"potential", "x*y'"}}).starts_with("/system/potential: column 3: "));
  BOOST_TEST(problem({{"hamiltonian", "x"}}).starts_with("/system/hamiltonian: unknown key"),
             problem({{"hamiltonian", "x"}}));
  // Where there are no configurations.
  const Json planar{{"type", "hamiltonian"},
                    {"coordinates", {"x", "y"}},
                    {"structure", {{"type", "bivector"}, {"matrix", {{0, 1}, {-1, 0}}}}},
                    {"hamiltonian", "x^2 + y^2"}};
  for (const char* key : {"nonholonomic", "forces", "damping"})
    BOOST_TEST(problems(with({{key, {"x", "y"}}}, planar))
                   .starts_with("/system/" + std::string(key) +
                                ": is about velocities of configurations, which Euclidean(2) does "
                                "not have"));
  BOOST_TEST(problems(with({{"holonomic", "x - y"}}, planar)) == "");
}

BOOST_AUTO_TEST_CASE(vakonomic_takes_either_kind_of_data) {
  const Json free{
      {"type", "vakonomic"}, {"coordinates", {"x", "y"}}, {"nonholonomic", "x' - x*y'"}};
  BOOST_TEST(problems(with({{"metric", 2}}, free)) == "");
  BOOST_TEST(problems(with({{"lagrangian", "x'^2 + y'^2"}}, free)) == "");
  BOOST_TEST(problems(with({{"lagrangian", "x'^2 + y'^2"}, {"potential", "x"}}, free)) ==
             "/system/potential: is there beside a \"lagrangian\"; expected one of the two");
}

// The structure of a Lagrangian system is one on T*Q.
BOOST_AUTO_TEST_CASE(structure_of_a_lagrangian) {
  const Json free{
      {"type", "lagrangian"}, {"coordinates", {"x", "y"}}, {"lagrangian", "x'^2 + y'^2"}};
  const Json magnetic{{"type", "gauge"},
                      {"structure", "canonical"},
                      {"matrix", {{0, 2, 0, 0}, {-2, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}}};
  BOOST_TEST(problems(with({{"structure", magnetic}}, free)) == "");
  const Experiment experiment = read_experiment(with({{"structure", magnetic}}, free).dump());
  // p = 2 w, and ṗ is ± 2 J w: across, in one direction.
  const VectorXd x{{0, 0, 2, 0}}, z{{1, 0}};
  const double right = experiment.model.system->residual(x, VectorXd{{1, 0, 0, 2}}, z, 0.0).norm();
  const double left = experiment.model.system->residual(x, VectorXd{{1, 0, 0, -2}}, z, 0.0).norm();
  BOOST_TEST(std::min(left, right) < 1e-15);
  BOOST_TEST(std::max(left, right) > 1.0);
  BOOST_TEST(
      problems(with({{"structure", {{"type", "bivector"}, {"matrix", {{0, 1}, {-1, 0}}}}}}, free))
          .starts_with("/system/structure/matrix"));
}

// "canonical" stands for a two-form, a bivector, J, on cotangent bundles and on (q, p).
BOOST_AUTO_TEST_CASE(canonical_matrices) {
  const auto residual = [](const Json& system, const VectorXd& x, const VectorXd& v,
                           const VectorXd& z) {
    return read_experiment(with({}, system).dump()).model.system->residual(x, v, z, 0.0);
  };
  const VectorXd x{{0.3, -0.2, 0.7, 1.1}}, v{{0.7, 1.1, -0.3, 0.2}};
  const Json on_plane{{"coordinates", {"x", "y", "a", "b"}},
                      {"hamiltonian", "(x^2 + y^2 + a^2 + b^2)/2"}};
  for (const char* type : {"two-form", "bivector"}) {
    Json system = on_plane;
    system["type"] = "hamiltonian";
    system["structure"] = {{"type", type}, {"matrix", "canonical"}};
    BOOST_TEST(residual(system, x, v, VectorXd(0)).norm() < 1e-15);
    BOOST_TEST(residual(system, x, -v, VectorXd(0)).norm() > 1.0);
  }
  Json port = on_plane;
  port.update({{"type", "port-hamiltonian"}, {"J", "canonical"}, {"B", {0, 0, 1, "x"}}});
  BOOST_TEST(
      residual(port, x, v + VectorXd{{0, 0, 2, 0.6}}, VectorXd::Constant(1, 2.0)).head(4).norm() <
      1e-15);
  port["coordinates"] = {"x", "y", "a"};
  port["hamiltonian"] = "x";
  port["B"] = {0, 0, 1};
  BOOST_TEST(problems(with({}, port))
                 .starts_with("/system/J: is on Euclidean(3); expected a "
                              "cotangent bundle"));
  // On T*SO(3): the Euler equations.
  Json top{{"type", "port-hamiltonian"},
           {"manifold", {{"type", "cotangent-bundle"}, {"base", "so3"}}},
           {"coordinates", {"R[3][3]"}},
           {"J", "canonical"},
           {"hamiltonian", "(p_R[0]^2 + 2*p_R[1]^2 + 3*p_R[2]^2)/2"}};
  VectorXd at(12), rate(6);
  const Eigen::Vector3d p(0.3, -0.4, 0.9), Omega(0.3, -0.8, 2.7);
  at << 1, 0, 0, 0, 1, 0, 0, 0, 1, p;
  rate << Omega, p.cross(Omega);
  BOOST_TEST(residual(top, at, rate, VectorXd(0)).norm() < 1e-14);
}

// S' = S ξ̂ - ξ̂ S for symmetric matrices and two-forms as the body sees them, π' = π × ξ for momenta.
BOOST_AUTO_TEST_CASE(tensors_that_are_carried_along) {
  const Eigen::Vector3d xi(0.3, -0.8, 0.2), mu(0.3, -1.6, 0.6), momentum(0.7, 0.1, -0.4);
  Eigen::Matrix3d hat, S, W;
  hat << 0.0, -0.2, -0.8, 0.2, 0.0, -0.3, 0.8, 0.3, 0.0;
  S << 1.0, 0.2, -0.5, 0.2, 2.0, 0.8, -0.5, 0.8, -0.6;
  W << 0.0, 0.4, 0.9, -0.4, 0.0, -0.3, -0.9, 0.3, 0.0;
  const auto entries = [](const Eigen::Matrix3d& A) {
    return VectorXd{{A(0, 0), A(0, 1), A(0, 2), A(1, 1), A(1, 2), A(2, 2)}};
  };
  const auto above = [](const Eigen::Matrix3d& A) { return VectorXd{{A(0, 1), A(0, 2), A(1, 2)}}; };
  const auto defect = [&](const char* word, const VectorXd& a, const VectorXd& rate) {
    const Json body{{"type", "euler-poincare"},
                    {"algebra", "so3"},
                    {"advected", {"a[" + std::to_string(a.size()) + "]"}},
                    {"representation", word},
                    {"lagrangian", "(xi[0]^2 + 2*xi[1]^2 + 3*xi[2]^2)/2"}};
    const Experiment experiment = read_experiment(with({}, body).dump());
    VectorXd x(3 + a.size()), v(3 + a.size());
    x << mu, a;
    v << mu.cross(xi), rate;
    return experiment.model.system->residual(x, v, xi, 0.0).norm();
  };
  BOOST_TEST(defect("symmetric-matrices", entries(S), entries(S * hat - hat * S)) < 1e-14);
  BOOST_TEST(defect("two-forms", above(W), above(W * hat - hat * W)) < 1e-14);
  BOOST_TEST(defect("adjoint", momentum, momentum.cross(xi)) < 1e-14);
  BOOST_TEST(defect("vectors", momentum, momentum.cross(xi)) < 1e-14);
  const auto problem = [](const Json& representation, const char* algebra) {
    return problems(with({}, {{"type", "euler-poincare"},
                              {"algebra", algebra},
                              {"advected", {"a[6]"}},
                              {"representation", representation},
                              {"hamiltonian", "mu[0]^2"}}));
  };
  BOOST_TEST(problem("adjoint", "se3") == "");
  BOOST_TEST(problem("tensors", "so3").starts_with("/system/representation: is \"tensors\""));
  BOOST_TEST(problem("two-forms", "se3").starts_with("/system/representation: need to know how"));
  BOOST_TEST(problem("two-forms", "so3").starts_with("/system/representation: acts on 3 numbers"));
  const Json wrong = {{{0, 1}, {0, 0}}, {{0, 0}, {1, 0}}, {{1, 0}, {0, 2}}};
  BOOST_TEST(problem(wrong, "so3").find("expected a representation of so(3)") != std::string::npos,
             problem(wrong, "so3"));
}

BOOST_AUTO_TEST_CASE(euler_poincare_keys) {
  const Json top{{"type", "euler-poincare"},
                 {"algebra", "so3"},
                 {"advected", {"Gamma[3]"}},
                 {"lagrangian", "(xi[0]^2 + 2*xi[1]^2 + 3*xi[2]^2)/2 - Gamma[2]"},
                 {"inputs", {"t", "-mu[1]", "xi[2]"}}};
  const auto changed = [&](const Json& keys) { return problems(with(keys, top)); };
  BOOST_TEST(changed({}) == "");
  const Experiment experiment = read_experiment(with({}, top).dump());
  const ImplicitSystem& system = *experiment.model.system;
  const Eigen::Vector3d Omega(0.3, -0.8, 0.2), mu(0.3, -1.6, 0.6), Gamma(0.1, 0.5, -0.7);
  VectorXd x(6), v(6);
  x << mu, Gamma;
  v << mu.cross(Omega) + Gamma.cross(Eigen::Vector3d::UnitZ()) +
           Eigen::Vector3d(0.4, 1.6, Omega[2]),
      Gamma.cross(Omega);
  BOOST_TEST(system.residual(x, v, Omega, 0.4).norm() < 1e-14);
  // Names of one's own, and the matrices of so(n).
  BOOST_TEST(problems(with({}, {{"type", "euler-poincare"},
                                {"algebra", "so"},
                                {"n", 4},
                                {"momentum", "M"},
                                {"velocity", "W"},
                                {"advected", {"a[4]", "b[4]"}},
                                {"nonholonomic", "W[0] - a[1]*W[5]"},
                                {"lagrangian", "dot(W, W)/2 + dot(a, b)"}})) == "");
  BOOST_TEST(changed({{"hamiltonian", "mu[0]"}}).starts_with("/system: has both"));
  BOOST_TEST(
      changed({{"inputs", {1, 2}}}).starts_with("/system/inputs: has 2 formulas; expected 3"));
  BOOST_TEST(changed({{"nonholonomic", "Gamma[0]"}})
                 .starts_with("/system/nonholonomic: contains no velocity such as xi[0]"));
  BOOST_TEST(changed({{"momentum", "mu[4]"}}).starts_with("/system/momentum: "));
  BOOST_TEST(changed({{"velocity", "mu"}}).starts_with("/system/velocity: "));
  BOOST_TEST(
      changed({{"advected", {"Gamma[2]"}}}).starts_with("/system/advected: acts on 3 numbers"),
      changed({{"advected", {"Gamma[2]"}}}));
  BOOST_TEST(changed({{"algebra", "se3"}, {"inputs", {1, 2, 3, 4, 5, 6}}})
                 .starts_with("/system/advected: need to know how se(3) acts"));
  BOOST_TEST(changed({{"algebra", "so4"}}).starts_with("/system/algebra: unknown \"so4\""));
}

BOOST_AUTO_TEST_CASE(optimal_control_and_morse_family_keys) {
  const Json control{{"type", "optimal-control"},
                     {"states", {"x", "v"}},
                     {"controls", {"u"}},
                     {"dynamics", {"v", "u"}},
                     {"cost", "u^2/2"}};
  const auto changed = [&](const Json& keys) { return problems(with(keys, control)); };
  BOOST_TEST(changed({}) == "");
  BOOST_TEST(
      changed({{"dynamics", {"v"}}}).starts_with("/system/dynamics: has 1 formulas; expected 2"));
  BOOST_TEST(changed({{"dynamics", {"v", "p_x"}}}).starts_with("/system/dynamics/1: column 1: "));
  BOOST_TEST(changed({{"extremals", "strange"}}).starts_with("/system/extremals: is \"strange\""));
  BOOST_TEST(changed({{"controls", {"x"}}}).starts_with("/system/controls/0: "));
  BOOST_TEST(changed({{"coordinates", {"x"}}}).starts_with("/system/coordinates: unknown key"),
             changed({{"coordinates", {"x"}}}));
  // On a group, by components or by R'.
  const Json attitude{{"type", "optimal-control"},
                      {"manifold", "so3"},
                      {"states", {"R[3][3]"}},
                      {"controls", {"u[3]"}},
                      {"dynamics", {"u[0]", "u[1]", "u[2]"}},
                      {"cost", "dot(u, u)/2"}};
  BOOST_TEST(problems(with({}, attitude)) == "");
  const Json family{{"type", "morse-family"},
                    {"coordinates", {"x"}},
                    {"multipliers", {"l"}},
                    {"family", "p_x^2/2 + l*(x - t)"}};
  BOOST_TEST(problems(with({}, family)) == "");
  BOOST_TEST(problems(with({{"family", "m*x"}}, family))
                 .starts_with("/system/family: column 1: unknown name \"m\""));
  BOOST_TEST(
      problems(with({{"multipliers", {"p_x"}}}, family)).starts_with("/system/multipliers/0"));
}

BOOST_AUTO_TEST_SUITE_END()
