// Order 2 of every symmetric map in both methods on every nonlinear space, measured on motions in a
// potential against Dormand and Prince on the vector field in the space around.
#include <boost/test/unit_test.hpp>

#include "courant/integrators/constrain_first.hpp"
#include "courant/integrators/constraint_algorithm.hpp"
#include "courant/integrators/cotangent_lift.hpp"
#include "courant/integrators/discretize_first.hpp"
#include "courant/integrators/explicit_runge_kutta.hpp"
#include "courant/integrators/theta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/implicit_submanifold.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"
#include "problems.hpp"

namespace courant {
namespace {

using test::method_1, test::method_2;

Json motion(const Json& base, const Json& coordinates, const char* hamiltonian,
            const Json& initial) {
  return {{"system",
           {{"type", "hamiltonian"},
            {"manifold", {{"type", "cotangent-bundle"}, {"base", base}}},
            {"coordinates", coordinates},
            {"hamiltonian", hamiltonian}}},
          {"initial", initial}};
}

void check_orders(const Json& experiment, const std::vector<const char*>& maps) {
  const auto system = test::problem(experiment);
  const double time = 1.0;
  const VectorXd exact = system.end("dopri5", time, 200);
  for (const char* map : maps)
    for (const Json& method : {method_1(map), method_2(map)}) {
      const double order = system.order(method, time, exact);
      BOOST_TEST(std::abs(order - 2.0) < 0.15,
                 system.experiment.model.description << ", " << method.dump() << ": " << order);
    }
}

const Json kOne = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

}  // namespace

BOOST_AUTO_TEST_SUITE(manifold_orders)

BOOST_AUTO_TEST_CASE(sphere) {
  const char* H = "(p_x[0]^2 + 2*p_x[1]^2 + p_x[2]^2)/2 + x[2] + x[0]*x[1]";
  const Json initial = {{"x", {0.6, 0, 0.8}}, {"p_x", {0.4, 0.7, -0.3}}};
  check_orders(motion("sphere", {"x[3]"}, H, initial),
               {"midpoint", "chordal", "spherical-midpoint"});
  check_orders(motion({{"type", "sphere"}, {"retraction", "projective"}}, {"x[3]"}, H, initial),
               {"midpoint"});
}

BOOST_AUTO_TEST_CASE(hyperbolic_plane) {
  check_orders(motion("hyperbolic", {"x[3]"}, "(p_x[1]^2 + p_x[2]^2 - p_x[0]^2)/2 + x[0] + x[1]/2",
                      {{"x", {1, 0, 0}}, {"p_x", {0, 0.4, 0.7}}}),
               {"exponential"});
}

BOOST_AUTO_TEST_CASE(torus) {
  check_orders(motion("torus", {"a[2]"}, "(p_a[0]^2 + p_a[1]^2)/2 - cos(a[0] - 2*a[1]) - cos(a[1])",
                      {{"a", {1, 0.4}}, {"p_a", {0.3, -0.5}}}),
               {"midpoint"});
}

BOOST_AUTO_TEST_CASE(rotations) {
  const char* H = "(p_R[0]^2 + p_R[1]^2/2 + p_R[2]^2/3)/2 + R[2][2] + R[0][1]/2";
  const Json initial = {{"R", kOne}, {"p_R", {0.7, -0.4, 1}}};
  check_orders(motion("so3", {"R[3][3]"}, H, initial), {"exponential", "cayley"});
  check_orders(motion({{"type", "so3"}, {"retraction", "cayley"}}, {"R[3][3]"}, H, initial),
               {"midpoint"});
}

BOOST_AUTO_TEST_CASE(rigid_motions) {
  check_orders(
      motion("se3", {"R[3][3]", "r[3]"},
             "(p_R[0]^2 + p_R[1]^2/2 + p_R[2]^2/3 + dot(p_r, p_r))/2 + R[2][2] + "
             "R[0][0]*r[1] + dot(r, r)/2",
             {{"R", kOne}, {"r", {1, 0, 0.5}}, {"p_R", {0.7, -0.4, 1}}, {"p_r", {0.2, 0.3, -0.5}}}),
      {"exponential", "cayley"});
}

BOOST_AUTO_TEST_CASE(frames) {
  check_orders(
      motion("stiefel", {"X[3][2]"},
             "sum(i, 0, 2, p_X[i][0]^2 + p_X[i][1]^2)/2 + X[0][0] + X[1][0]*X[2][1]",
             {{"X", {{1, 0}, {0, 1}, {0, 0}}}, {"p_X", {{0, 0.3}, {-0.3, 0}, {0.5, 0.7}}}}),
      {"midpoint"});
}

BOOST_AUTO_TEST_CASE(positive_definite_matrices) {
  check_orders(
      motion("symmetric-positive-definite", {"X[3]"},
             "(p_X[0]^2 + p_X[1]^2 + 2*p_X[2]^2)/2 + X[0] + X[2] - log(X[0]*X[2] - X[1]^2)",
             {{"X", {2, 0.3, 1.5}}, {"p_X", {0.2, 0.4, -0.3}}}),
      {"exponential"});
}

BOOST_AUTO_TEST_CASE(products) {
  check_orders(motion({{"type", "product"}, {"factors", {"sphere", "so3", "euclidean"}}},
                      {"x[3]", "R[3][3]", "s"},
                      "(dot(p_x, p_x) + dot(p_R, p_R) + p_s^2)/2 + "
                      "x[0]*R[0][0] + x[1]*R[1][0] + s*x[2] + s^2",
                      {{"x", {0.48, 0.36, 0.8}},
                       {"R", kOne},
                       {"s", 0.3},
                       {"p_x", {-0.3, 0.4, 0}},
                       {"p_R", {0.7, -0.4, 1}},
                       {"p_s", 0.1}}),
               {"exponential"});
}

// The spherical pendulum as an equation for the velocity, where there is no symplectic form.
BOOST_AUTO_TEST_CASE(tangent_bundle) {
  Json equations;
  for (const std::string i : {"[0]", "[1]", "[2]"}) {
    equations.push_back("x" + i + "' - v_x" + i);
    equations.push_back("v_x" + i + "' + (dot(v_x, v_x) - x[2] - x[0]*x[1]*2)*x" + i +
                        " + gradient" + i);
  }
  const Json experiment = {{"system",
                            {{"type", "implicit"},
                             {"manifold", {{"type", "tangent-bundle"}, {"base", "sphere"}}},
                             {"coordinates", {"x[3]"}},
                             {"definitions", {{"gradient", {"x[1]", "x[0]", "1"}}}},
                             {"equations", equations}}},
                           {"initial", {{"x", {0.6, 0, 0.8}}, {"v_x", {0.4, 0.7, -0.3}}}}};
  check_orders(experiment, {"midpoint"});
}

// An ellipsoid, in formulas.
BOOST_AUTO_TEST_CASE(submanifold_of_an_experiment) {
  check_orders(motion({{"type", "implicit-submanifold"},
                       {"equations", {"x[0]^2 + x[1]^2/2 + x[2]^2/4 - 1"}}},
                      {"x[3]"}, "dot(p_x, p_x)/2 + x[2] + 0.3*x[0]",
                      {{"x", {0.6, 0, 1.6}}, {"p_x", {0.3, 0.5, -0.45}}}),
               {"midpoint", "projected"});
}

BOOST_AUTO_TEST_CASE(submanifold_given_by_equations) {
  const auto ellipsoid = std::make_shared<ImplicitSubmanifold>(
      "Ellipsoid", std::make_shared<Euclidean>(3),
      [](const ExprVector& x) {
        return ExprVector(
            ExprVector::Constant(1, square(x[0]) + square(x[1]) / 2.0 + square(x[2]) / 4.0 - 1.0));
      },
      1);
  const auto M = std::make_shared<CotangentBundle>(ellipsoid);
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<Hamiltonian>(M, [](const ExprVector& x, const Expr&) {
        return 0.5 * x.tail(3).squaredNorm() + x[2] + 0.3 * x[0];
      }));
  VectorXd x0(6);
  x0 << 0.6, 0.0, 1.6, 0.2, 0.5, 0.0;
  x0 = M->project(x0);
  const auto ladder = ConstraintAlgorithm().run(system, {.x = x0});
  BOOST_REQUIRE((ladder.verdict == Verdict::regular));
  const auto map = std::make_shared<CotangentLift>(M, std::make_shared<Theta>(ellipsoid));
  const DiscretizeFirst first(system, map, {.backend = Backend::interpreter});
  const ConstrainFirst second(system, ladder, map, std::make_shared<OrthogonalProjector>(),
                              {.backend = Backend::interpreter});
  const ExplicitRungeKutta reference(
      std::make_shared<VectorField>(system, ladder, Backend::interpreter),
      ExplicitRungeKutta::Kind::dormand_prince);
  const auto end = [&](const Integrator& method, long steps) {
    const auto stepper = method.start(ladder.point, 1.0 / static_cast<double>(steps));
    for (long k = 0; k < steps; ++k) stepper->step();
    return stepper->state().x;
  };
  const VectorXd exact = end(reference, 300);
  for (const Integrator* method :
       {static_cast<const Integrator*>(&first), static_cast<const Integrator*>(&second)}) {
    std::vector<double> steps, errors;
    for (const long count : {8, 16, 32, 64}) {
      steps.push_back(1.0 / static_cast<double>(count));
      errors.push_back((end(*method, count) - exact).norm());
    }
    BOOST_TEST(std::abs(log_log_slope(steps, errors, 1e-12) - 2.0) < 0.15, method->name());
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
