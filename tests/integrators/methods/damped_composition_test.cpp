#include "courant/integrators/methods/damped_composition.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <complex>

#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/tests/integrators/example_systems.hpp"

using namespace courant;
using examples::equations;
using examples::FormulaSystem;

namespace {

using Pointer = std::shared_ptr<const Integrator>;
using SystemPointer = std::shared_ptr<const ImplicitSystem>;
using V = const ExprVector&;
using T = const Expr&;

Pointer theta_method(const SystemPointer& system, double theta) {
  return std::make_shared<DiscretizeFirst>(system,
                                           std::make_shared<Theta>(system->manifold(), theta));
}

Pointer damped(const SystemPointer& system) {
  return std::make_shared<DampedComposition>(theta_method(system, DampedComposition::kThetas[0]),
                                             theta_method(system, DampedComposition::kThetas[1]));
}

Pointer damped_2(const SystemPointer& system, const ConstraintLadder& ladder) {
  const auto with = [&](double theta) {
    return std::make_shared<ConstrainFirst>(system, ladder,
                                            std::make_shared<Theta>(system->manifold(), theta),
                                            std::make_shared<OrthogonalProjector>());
  };
  return std::make_shared<DampedComposition>(with(DampedComposition::kThetas[0]),
                                             with(DampedComposition::kThetas[1]));
}

// Slope of the distance from `exact` at the time 2.
double order_to(const Integrator& method, const State& from, const VectorXd& exact) {
  std::vector<double> steps, errors;
  for (const long count : {40, 80, 160, 320, 640}) {
    const double h = 2.0 / static_cast<double>(count);
    steps.push_back(h);
    errors.push_back((method.advance(from, h, count).x - exact).norm());
  }
  return log_log_slope(steps, errors, 1e-12);
}

// x' = λ (x - cos t) with the solution cos t for λ → -∞.
SystemPointer cosine(double lambda) {
  return std::make_shared<FormulaSystem>(
      std::make_shared<Euclidean>(1), 0, 1, [lambda](V x, V v, V, T t) {
        return equations({v[0] / std::abs(lambda) + (x[0] - cos(t))});
      });
}

// x' = λ (x - φ) + φ', φ = sin t: the solution is φ (Prothero, Robinson).
SystemPointer prothero_robinson(double lambda) {
  return std::make_shared<FormulaSystem>(
      std::make_shared<Euclidean>(1), 0, 1, [lambda](V x, V v, V, T t) {
        return equations({(v[0] - cos(t)) / std::abs(lambda) + (x[0] - sin(t))});
      });
}

// The pendulum with a spring in Cartesian coordinates: index 2, with its constraint as index 3 hides it.
SystemPointer rod() {
  return std::make_shared<FormulaSystem>(
      std::make_shared<Euclidean>(4), 1, 5, [](V x, V v, V z, T t) {
        return equations({v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0] + square(x[0]) - cos(t),
                          v[3] + z[0] * x[1] + 1.0, square(x[0]) + square(x[1]) - 1.0});
      });
}

}  // namespace

// Mistakes that these cases have to notice:
//  * the two theta steps have another theta and order 1
//  * the parts of a damped step are halves
//  * the second part of a damped step begins at another time
BOOST_AUTO_TEST_SUITE(damped_composition)

BOOST_AUTO_TEST_CASE(conditions_of_order) {
  const auto& [first, second] = DampedComposition::kParts;
  const auto& theta = DampedComposition::kThetas;
  BOOST_TEST(std::abs(first + second - 1.0) < 1e-15);
  BOOST_TEST(std::abs((0.5 - theta[0]) * first * first + (0.5 - theta[1]) * second * second) <
             1e-15);
  // Both steps have one matrix 1 - γ h J.
  BOOST_TEST(std::abs(theta[0] * first - theta[1] * second) < 1e-15);
}

// On x' = A x with A a turn and a contraction, λ = a + ib, a step multiplies by R(hλ).
BOOST_AUTO_TEST_CASE(stability_function) {
  const double gamma = 1.0 - std::sqrt(0.5);
  for (const std::complex<double> z : {std::complex<double>(-1e-3, 0.0),
                                       {-0.3, 0.2},
                                       {-4.0, 0.0},
                                       {-1e3, 0.0},
                                       {-1e12, 0.0},
                                       {0.0, 0.1},
                                       {0.0, 1.5},
                                       {0.0, 10.0},
                                       {0.0, 1e6},
                                       {-1.0, 30.0}}) {
    const double a = z.real(), b = z.imag();
    const auto turn = std::make_shared<FormulaSystem>(
        std::make_shared<Euclidean>(2), 0, 2, [a, b](V x, V v, V, T) {
          return equations({v[0] - (a * x[0] - b * x[1]), v[1] - (b * x[0] + a * x[1])});
        });
    const State end = damped(turn)->advance({.x = Eigen::Vector2d(1.0, 0.0)}, 1.0);
    const std::complex<double> R =
        (1.0 + (1.0 - 2.0 * gamma) * z) / ((1.0 - gamma * z) * (1.0 - gamma * z));
    BOOST_TEST(std::abs(std::complex<double>(end.x[0], end.x[1]) - R) < 1e-12 + 1e-15 * std::abs(z),
               "z = " << z);
    BOOST_TEST(std::abs(R) <= 1.0 + 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(order_2_with_explicit_time) {
  const auto pendulum = std::make_shared<
      FormulaSystem>(std::make_shared<Euclidean>(2), 0, 2, [](V x, V v, V, T t) {
    return equations({v[0] - x[1], v[1] + sin(x[0]) + 0.2 * x[1] * square(x[0]) - cos(3.0 * t)});
  });
  const State start = {.t = 0.3, .x = Eigen::Vector2d(0.7, -0.4)};
  const Pointer method = damped(pendulum);
  const double measured = order_to(*method, start, method->advance(start, 2.0 / 20000, 20000).x);
  BOOST_TEST(std::abs(measured - 2.0) < 0.15, "measured " << measured);
  BOOST_TEST(method->order() == 2);
  // Negative control: one theta step alone.
  const Pointer alone = theta_method(pendulum, DampedComposition::kThetas[0]);
  const double single = order_to(*alone, start, method->advance(start, 2.0 / 20000, 20000).x);
  BOOST_TEST(std::abs(single - 1.0) < 0.15, "measured " << single);
}

// A capacitor behind a nonlinear resistor and an algebraic node, by both methods; a pendulum with its constraint by
// Method 2. Multipliers, too.
BOOST_AUTO_TEST_CASE(order_2_with_constraints) {
  const auto node =
      std::make_shared<FormulaSystem>(std::make_shared<Euclidean>(2), 0, 2, [](V x, V v, V, T t) {
        return equations({v[0] - x[1], x[1] + 0.3 * x[1] * square(x[1]) + x[0] - sin(2.0 * t)});
      });
  const ConstraintLadder of_node =
      ConstraintAlgorithm().run(node, {.t = 0.2, .x = Eigen::Vector2d(0.5, -0.1)});
  for (const Pointer& method : {damped(node), damped_2(node, of_node)}) {
    const VectorXd exact = damped_2(node, of_node)->advance(of_node.point, 1e-4, 20000).x;
    const double measured = order_to(*method, of_node.point, exact);
    BOOST_TEST(std::abs(measured - 2.0) < 0.15, method->name() << ": measured " << measured);
  }
  const SystemPointer pendulum = rod();
  const ConstraintLadder of_rod =
      ConstraintAlgorithm().run(pendulum, {.x = Eigen::Vector4d(0.6, -0.8, 0.24, 0.18)});
  const Pointer method = damped_2(pendulum, of_rod);
  const State exact = method->advance(of_rod.point, 1e-4, 20000);
  const double measured = order_to(*method, of_rod.point, exact.x);
  BOOST_TEST(std::abs(measured - 2.0) < 0.15, "measured " << measured);
  std::vector<double> steps, errors;
  for (const long count : {40, 80, 160, 320}) {
    steps.push_back(2.0 / static_cast<double>(count));
    const State end = method->advance(of_rod.point, steps.back(), count);
    errors.push_back((end.z - exact.z).norm());
    BOOST_TEST(std::abs(end.x.head(2).norm() - 1.0) < 1e-13);
  }
  BOOST_TEST(std::abs(log_log_slope(steps, errors, 1e-12) - 2.0) < 0.15);
}

// From a start off the slow motion: the midpoint rule carries the distance on for ever, with the other sign in
// each step.
BOOST_AUTO_TEST_CASE(what_is_stiff_dies_out) {
  const double h = 0.1;
  for (const double lambda : {-1e4, -1e8}) {
    const SystemPointer system = cosine(lambda);
    const auto stepper = damped(system)->stepper();
    const auto ringing = theta_method(system, 0.5)->stepper();
    State state = {.x = VectorXd::Constant(1, 2.0)}, rings = state;
    for (int k = 1; k <= 40; ++k) {
      stepper->step(state, h);
      ringing->step(rings, h);
      const double distance = rings.x[0] - std::cos(rings.t);
      BOOST_TEST(distance * (k % 2 == 0 ? 1.0 : -1.0) > 0.8);
      BOOST_TEST(std::abs(state.x[0] - std::cos(state.t)) < 20.0 / std::abs(h * lambda));
    }
  }
}

// Prothero and Robinson: errors at the end are those of a stiff problem, less than h²/|hλ|, for every λ.
BOOST_AUTO_TEST_CASE(no_loss_of_order_at_the_end_of_stiff_steps) {
  for (const double lambda : {-1e6, -1e8})
    for (const double h : {0.1, 0.05}) {
      const auto count = std::lround(2.0 / h);
      const State end =
          damped(prothero_robinson(lambda))->advance({.x = VectorXd::Zero(1)}, h, count);
      BOOST_TEST(std::abs(end.x[0] - std::sin(2.0)) < h * h / std::abs(h * lambda) + 1e-15);
    }
}

BOOST_AUTO_TEST_CASE(claims_and_refusals) {
  const SystemPointer system = cosine(-1.0), other = cosine(-2.0);
  const Pointer method = damped(system);
  BOOST_TEST(!method->is_symmetric());
  BOOST_TEST((method->is_symplectic() == std::optional(false)));
  BOOST_TEST(method->name() == "discretize-first, damped");
  const Pointer first = theta_method(system, DampedComposition::kThetas[0]);
  BOOST_CHECK_THROW(DampedComposition(first, nullptr), std::invalid_argument);
  BOOST_CHECK_THROW(DampedComposition(nullptr, first), std::invalid_argument);
  BOOST_CHECK_THROW(DampedComposition(first, theta_method(other, 1.0)), std::invalid_argument);
  BOOST_CHECK_THROW(DampedComposition(first, theta_method(system, 0.5)), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
