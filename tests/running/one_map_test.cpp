// A method is one map of the state: the same step wherever a run began, and whatever round-off stands for zero.
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "problems.hpp"

BOOST_AUTO_TEST_SUITE(one_map)

using namespace courant;

namespace {

Json held_pendulum(const Json& x, const Json& y, const Json& p_x, const Json& p_y) {
  return {{"system",
           {{"type", "mechanical"},
            {"coordinates", {"x", "y"}},
            {"potential", "9.81*y"},
            {"holonomic", "x^2+y^2-1"}}},
          {"initial", {{"x", x}, {"y", y}, {"p_x", p_x}, {"p_y", p_y}}}};
}

// At t = 2, by the angle and SciPy's DOP853 with a relative tolerance of 10⁻¹².
const Eigen::Vector2d kFromTheHorizontal(0.7935661953, -0.6084839304);

}  // namespace

// Zeros replaced by numbers of 10⁻¹⁷ to 10⁻⁵: the run is that from zero, up to some times these.
BOOST_AUTO_TEST_CASE(noise_for_zeros) {
  const auto end = [](const Json& experiment) {
    return test::problem(experiment).end("constrain-first", 2.0, 160);
  };
  const VectorXd expected = end(held_pendulum(1, 0, 0, 0));
  BOOST_TEST((expected.head(2) - kFromTheHorizontal).norm() < 3e-3);
  const VectorXd finer = test::problem(held_pendulum(1, 0, 0, 0)).end("constrain-first", 2.0, 640);
  BOOST_TEST((finer.head(2) - kFromTheHorizontal).norm() < 2e-4);
  std::mt19937 generator(8);
  std::uniform_real_distribution<double> power(-17.0, -5.0);
  for (int i = 0; i < 40; ++i) {
    double noise[2];
    for (double& number : noise)
      number = (generator() % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, power(generator));
    BOOST_TEST_CONTEXT("y = " << noise[0] << ", p_y = " << noise[1]) {
      const double difference = (end(held_pendulum(1, noise[0], 0, noise[1])) - expected).norm();
      const double most = 100.0 * std::max(std::abs(noise[0]), std::abs(noise[1])) + 1e-10;
      BOOST_TEST(difference < most, difference);
    }
  }
  BOOST_TEST((end(held_pendulum("sin(pi/2)", "-cos(pi/2)", 0, 0)) - expected).norm() < 1e-10);
}

// A momentum of 10⁻²⁰ to 10⁻⁶⁰ is that of zero.
BOOST_AUTO_TEST_CASE(a_small_momentum) {
  const auto end = [](double p) {
    const test::Problem motion = test::problem(
        {{"system",
          {{"type", "mechanical"},
           {"coordinates", {"x", "y", "z"}},
           {"metric", 1.0},
           {"potential", "9.81*z"},
           {"holonomic", {"x-cos(z)", "y-sin(z)"}}}},
         {"initial", {{"x", 1}, {"y", 0}, {"z", 0}, {"p_x", p}, {"p_y", -1}, {"p_z", -1}}}});
    return motion.end("constrain-first", 1.0, 50);
  };
  const VectorXd expected = end(0.0);
  BOOST_TEST(expected[2] == -3.4488, boost::test_tools::tolerance(1e-3));
  for (const double p : {1e-18, 1e-20, 1e-24, 1e-30, 1e-40, 1e-60})
    BOOST_TEST((end(p) - expected).norm() < 1e-10, p);
}

// A step depends on its state alone, across runs: a run from each of ten states of another one goes where that goes.
BOOST_AUTO_TEST_CASE(runs_go_on_from_their_states) {
  const std::vector<std::string> names = {"pendulum_cartesian",
                                          "pendulum_holonomic",
                                          "nonholonomic_particle",
                                          "knife_edge",
                                          "rolling_disk",
                                          "suslov_so3",
                                          "chaplygin_sleigh",
                                          "heavy_top_constrained",
                                          "slider_crank",
                                          "double_pendulum_holonomic",
                                          "spherical_pendulum_constrained"};
  for (const std::string& name : names) {
    const Json file = test::experiment_file(name);
    const test::Problem motion =
        test::problem({{"system", file.at("system")}, {"initial", file.at("initial")}});
    const double h = name == "slider_crank" ? 5e-4 : 0.01;
    const PreparedMethod whole = motion.prepare("constrain-first", h);
    const State end = whole.integrator->advance(whole.initial, h, 33);
    for (int k = 3; k <= 30; k += 3) BOOST_TEST_CONTEXT(name << " from step " << k) {
        test::Problem again = motion;
        const State state = whole.integrator->advance(whole.initial, h, k);
        again.ladder =
            ConstraintAlgorithm().run(motion.experiment.model.system,
                                      {.t = state.t, .x = state.x, .v = state.v, .z = state.z});
        const PreparedMethod part = again.prepare("constrain-first", h);
        State from = state;
        from.v = again.ladder.point.v;
        from.z = again.ladder.point.z;
        const double difference =
            (part.integrator->advance(from, h, 33 - k).x - end.x).norm() / (1.0 + end.x.norm());
        BOOST_TEST(difference < 1e-10, difference);
      }
  }
}

// The run of a file, and one that begins at its state at t = 1, as it is written with all digits.
BOOST_AUTO_TEST_CASE(a_run_from_a_written_state) {
  const Json system = {{"type", "mechanical"},
                       {"coordinates", {"x", "y", "z"}},
                       {"potential", "x^2/2+cos(z)+y^4"},
                       {"metric", {1, "1+x^2", 2}},
                       {"nonholonomic", "z'-y*x'"}};
  const test::Problem whole =
      test::problem({{"system", system},
                     {"initial", {{"x", 0.6}, {"y", 0.8}, {"z", 0.1}, {"x'", 0.4}, {"y'", -0.3}}}});
  const VectorXd at_one = whole.end("constrain-first", 1.0, 10);
  const test::Problem rest = test::problem({{"system", system},
                                            {"initial",
                                             {{"x", at_one[0]},
                                              {"y", at_one[1]},
                                              {"z", at_one[2]},
                                              {"p_x", at_one[3]},
                                              {"p_y", at_one[4]},
                                              {"p_z", at_one[5]}}}});
  const VectorXd end = whole.end("constrain-first", 2.0, 20);
  BOOST_TEST((rest.end("constrain-first", 1.0, 10) - end).norm() < 1e-12);
}

// By H(q, p) and by a metric and a potential: one system, one run.
BOOST_AUTO_TEST_CASE(two_formulations) {
  const Json constraints[] = {{{"holonomic", "x^2+2*y^2+z^2-1"}}, {{"nonholonomic", "z'-y*x'"}}};
  const Json initial = {
      {"x", 0.6}, {"y", 0.4}, {"z", std::sqrt(0.32)}, {"p_x", 0.3}, {"p_y", -0.2}};
  for (const Json& with : constraints) {
    Json hamiltonian = {{"type", "hamiltonian"},
                        {"coordinates", {"x", "y", "z"}},
                        {"hamiltonian", "p_x^2/(2*1.5)+p_y^2/(2*(1+x^2))+p_z^2/(2*0.3)+9.81*z"}};
    Json mechanical = {{"type", "mechanical"},
                       {"coordinates", {"x", "y", "z"}},
                       {"metric", {1.5, "1+x^2", 0.3}},
                       {"potential", "9.81*z"}};
    hamiltonian.update(with);
    mechanical.update(with);
    for (const char* projector : {"orthogonal", "momentum"}) {
      if (std::string(projector) == "momentum" && with.contains("holonomic")) continue;
      const auto end = [&](const Json& system) {
        return test::problem({{"system", system}, {"initial", initial}})
            .end({{"type", "constrain-first"}, {"projector", projector}}, 1.0, 20);
      };
      const double difference = (end(hamiltonian) - end(mechanical)).norm();
      BOOST_TEST(difference < 1e-11, with << " by " << projector << ": " << difference);
    }
  }
}

// On T*S² the metric of the kinetic energy is that of the numbers.
BOOST_AUTO_TEST_CASE(on_a_sphere) {
  const test::Problem motion = test::problem(
      {{"system",
        {{"type", "mechanical"},
         {"manifold", "sphere"},
         {"coordinates", {"x[3]"}},
         {"potential", "2.3*x[2]"},
         {"nonholonomic", "x[2]*x[0]' + x[1]*x[2]'"}}},
       {"initial", {{"x", {0.48, 0.6, 0.64}}, {"x'", {0.4, 0.13, -0.42187499999999994}}}}});
  const auto end = [&](const Json& projector) {
    return motion.end({{"type", "constrain-first"}, {"projector", projector}}, 0.5, 25);
  };
  const VectorXd expected = end({{"type", "momentum"}, {"metric", "euclidean"}});
  BOOST_TEST((end("momentum") - expected).norm() < 1e-12);
  BOOST_TEST((end("orthogonal") - expected).norm() < 1e-12);
}

// Kinds of constraints × spaces × projectors: all are of order 2, and come back to the constraints.
BOOST_AUTO_TEST_CASE(kinds_and_spaces_and_projectors) {
  const Json sphere_holonomic = {{"type", "mechanical"},
                                 {"manifold", "sphere"},
                                 {"coordinates", {"x[3]"}},
                                 {"potential", "2.3*x[2]"},
                                 {"holonomic", "x[0]-0.4*x[1]-0.24"}};
  const Json sphere_nonholonomic = {{"type", "mechanical"},
                                    {"manifold", "sphere"},
                                    {"coordinates", {"x[3]"}},
                                    {"potential", "2.3*x[2]"},
                                    {"nonholonomic", "x[2]*x[0]' + x[1]*x[2]'"}};
  const Json body_holonomic = {{"type", "mechanical"},       {"manifold", "so3"},
                               {"coordinates", {"R[3][3]"}}, {"metric", {1.4, 2.1, 1.7}},
                               {"potential", "0.7*R[2][2]"}, {"holonomic", "R[0][1]-0.2*R[2][0]"}};
  const Json body_nonholonomic = {
      {"type", "mechanical"},       {"manifold", "so3"},
      {"coordinates", {"R[3][3]"}}, {"metric", {1.4, 2.1, 1.7}},
      {"potential", "0.7*R[2][2]"}, {"nonholonomic", "v_R[2]-0.3*v_R[0]"}};
  const Json flat_holonomic = {{"type", "mechanical"},
                               {"coordinates", {"x", "y", "z"}},
                               {"metric", {1.5, "1+x^2", 0.3}},
                               {"potential", "9.81*z"},
                               {"holonomic", "x^2+2*y^2+z^2-1"}};
  const Json flat_nonholonomic = {{"type", "mechanical"},
                                  {"coordinates", {"x", "y", "z"}},
                                  {"metric", {1.5, "1+x^2", 0.3}},
                                  {"potential", "9.81*z"},
                                  {"nonholonomic", "z'-y*x'"}};
  const Json on_sphere = {{"x", {0.48, 0.6, 0.64}}, {"x'", {0.4, 0.13, -0.42187499999999994}}};
  const Json on_circle = {{"x", {0.48, 0.6, 0.64}}, {"p_x", {0.0, 0.0, 0.0}}};
  const Json turned = {{"R", {{1, 0, 0}, {0, 0.8, -0.6}, {0, 0.6, 0.8}}},
                       {"v_R", {0.6, -0.5, 0.18}}};
  const Json still = {{"R", {{1, 0, 0}, {0, 0.8, -0.6}, {0, 0.6, 0.8}}}, {"p_R", {0, 0, 0}}};
  const Json flat = {{"x", 0.6}, {"y", 0.4}, {"z", std::sqrt(0.32)}, {"p_x", 0.3}, {"p_y", -0.2}};
  const std::vector<std::pair<Json, Json>> systems = {
      {sphere_holonomic, on_circle}, {sphere_nonholonomic, on_sphere}, {body_holonomic, still},
      {body_nonholonomic, turned},   {flat_holonomic, flat},           {flat_nonholonomic, flat}};
  for (const auto& [system, initial] : systems) {
    const test::Problem motion = test::problem({{"system", system}, {"initial", initial}});
    const VectorXd exact = motion.end({{"type", "dopri5"}}, 0.5, 400);
    for (const Json& projector :
         {Json("orthogonal"), Json{{"type", "orthogonal"}, {"metric", "euclidean"}},
          Json{{"type", "momentum"}}, Json{{"type", "momentum"}, {"metric", "euclidean"}}}) {
      const bool is_momentum = projector.is_object() && projector.at("type") == "momentum";
      if (is_momentum && system.contains("holonomic")) continue;
      const double order = motion.order({{"type", "constrain-first"}, {"projector", projector}},
                                        0.5, exact, 0, {10, 20, 40, 80});
      BOOST_TEST(std::abs(order - 2.0) < 0.15, system << " by " << projector << ": " << order);
    }
  }
}

// Heat conducted through 250 slices behind one store: x = exp(-0.4 n/(2 n + 2)) at t = 0.4, for n = 250 as for n = 150.
BOOST_AUTO_TEST_CASE(unknowns_of_a_long_chain) {
  for (const int n : {150, 250}) {
    Json equations = {"x' + 31250.0*f[0]", "(f[1] - 2*f[0])*62500 + x"};
    for (int k = 1; k + 1 < n; ++k)
      equations.push_back("(f[" + std::to_string(k - 1) + "] - 2*f[" + std::to_string(k) +
                          "] + f[" + std::to_string(k + 1) + "])*62500");
    equations.push_back("(f[" + std::to_string(n - 2) + "] - 2*f[" + std::to_string(n - 1) +
                        "])*62500");
    const test::Problem rod = test::problem({{"system",
                                              {{"type", "implicit"},
                                               {"coordinates", {"x"}},
                                               {"unknowns", {"f[" + std::to_string(n) + "]"}},
                                               {"equations", equations}}},
                                             {"initial", {{"x", 1}}}});
    const double expected = std::exp(-0.4 * n / (2.0 * n + 2.0));
    for (const char* method : {"discretize-first", "constrain-first"})
      BOOST_TEST(rod.end(method, 0.4, 40)[0] == expected, boost::test_tools::tolerance(1e-5));
  }
}

// A rod of length 1.1, released sideways: Method 1 takes steps that have a solution. While the bob is nearly level with its
// pivot it falls as if it were free: y = 0.3 t - g t²/2.
BOOST_AUTO_TEST_CASE(steps_that_have_a_solution) {
  const test::Problem rod = test::problem(
      {{"system",
        {{"type", "implicit"},
         {"coordinates", {"x", "y", "v", "w"}},
         {"unknowns", {"l"}},
         {"equations", {"x' - v", "y' - w", "v' + l*x", "w' + l*y + 9.81", "x^2 + y^2 - 1.21"}}}},
       {"initial", {{"x", 1.1}, {"y", 0}, {"v", 0}, {"w", 0.3}}}});
  for (const long steps : {10, 100, 1000}) {
    const VectorXd end = rod.end("discretize-first", 0.1, steps);
    BOOST_TEST(std::abs(end[1] - (0.03 - 9.81 * 0.005)) < 1e-4, steps << ": " << end.transpose());
    BOOST_TEST(std::hypot(end[0], end[1]) == 1.1, boost::test_tools::tolerance(1e-4));
  }
}

BOOST_AUTO_TEST_SUITE_END()
