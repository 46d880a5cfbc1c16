// Steps whose equations have several solutions.
#include <Eigen/Core>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <optional>

#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/tests/integrators/example_systems.hpp"

// Mistakes that these cases have to notice:
//  * what was found first is taken, connected or not (integrators/step/step_solver.cpp)
//  * every solution is near enough to the prediction (integrators/step/step_solver.cpp)
//  * a step advances by its confirmation, which is right to some seven digits
//    (integrators/step/step_solver.cpp)
//  * turning points are stepped over (integrators/step/step_continuation.cpp)
//  * any contraction will do (integrators/step/step_continuation.cpp)
//  * curves measure a coordinate that turns by its displacement of the moment
//    (integrators/step/step_continuation.cpp)
//  * a curve begins where the matrix has lost its rank to round-off
//    (integrators/step/step_continuation.cpp)
BOOST_AUTO_TEST_SUITE(connected_steps)

using namespace courant;
using examples::FormulaSystem;

namespace {

// ẋ = f(x), and step sizes from harmless ones to where the connected solution ends.
struct Case {
  std::string name;
  std::function<ExprVector(const ExprVector&)> formula;
  std::function<VectorXd(const VectorXd&)> value;
  VectorXd start;
  std::vector<double> steps;
};

template <class F>
Case make(const std::string& name, F f, const std::vector<double>& start,
          const std::vector<double>& steps) {
  return {name, [f](const ExprVector& x) { return ExprVector(f(x)); },
          [f](const VectorXd& x) { return VectorXd(f(x)); },
          Eigen::Map<const VectorXd>(start.data(), static_cast<Index>(start.size())), steps};
}

template <class V>
V vector(const std::initializer_list<typename V::Scalar>& entries) {
  V result(static_cast<Index>(entries.size()));
  Index i = 0;
  for (const auto& entry : entries) result[i++] = entry;
  return result;
}

std::vector<Case> cases() {
  using std::cos, std::exp, std::log, std::sin, std::sqrt;
  std::vector<Case> all;
  const std::vector<double> usual = {0.01, 0.1, 0.5, 1.0, 3.0};
#define ROOTS_1(name, start, formula)        \
  all.push_back(make(                        \
      name,                                  \
      [](const auto& y) {                    \
        using V = std::decay_t<decltype(y)>; \
        const typename V::Scalar x = y[0];   \
        return vector<V>({formula});         \
      },                                     \
      {start}, usual))
  ROOTS_1("parabola down", 0.0, 1.0 - 100.0 * x * x);
  ROOTS_1("parabola down, from below", -0.05, 1.0 - 100.0 * x * x);
  ROOTS_1("parabola up", 0.5, x * x);
  ROOTS_1("blow-up", 0.0, 1.0 + x * x);
  ROOTS_1("cubic decay", 1.5, -x * x * x);
  ROOTS_1("cubic growth", 0.4, x * x * x);
  ROOTS_1("double well", 0.1, x - x * x * x);
  ROOTS_1("steep double well", 0.3, 30.0 * (x - x * x * x));
  ROOTS_1("waves", 0.2, sin(20.0 * x));
  ROOTS_1("waves on a slope", 0.2, 1.0 + 2.0 * cos(15.0 * x));
  ROOTS_1("exponential decay", 1.0, -exp(5.0 * x));
  ROOTS_1("exponential growth", -1.0, exp(2.0 * x));
  ROOTS_1("logistic", 0.1, 20.0 * x * (1.0 - x));
  ROOTS_1("quartic", 0.3, x * x - 4.0 * x * x * x * x);
  ROOTS_1("bump", 0.0, 1.0 / (0.01 + x * x));
  ROOTS_1("stiff and wavy", 0.7, -40.0 * x + 30.0 * sin(3.0 * x));
#undef ROOTS_1
  all.push_back(make("pendulum",
                     [](const auto& x) {
                       return vector<std::decay_t<decltype(x)>>({x[1], -9.81 * sin(x[0])});
                     },
                     {2.0, 0.5}, {0.05, 0.2, 0.6, 1.0, 2.0}));
  all.push_back(make(
      "van der Pol",
      [](const auto& x) {
        return vector<std::decay_t<decltype(x)>>({x[1], 50.0 * (1.0 - x[0] * x[0]) * x[1] - x[0]});
      },
      {2.0, 0.0}, {0.01, 0.05, 0.2, 0.5, 1.0}));
  all.push_back(make(
      "predators",
      [](const auto& x) {
        return vector<std::decay_t<decltype(x)>>({x[0] * (1.0 - x[1]), 3.0 * x[1] * (x[0] - 1.0)});
      },
      {0.5, 2.0}, {0.05, 0.2, 0.5, 1.0, 2.0}));
  all.push_back(make("Robertson",
                     [](const auto& x) {
                       return vector<std::decay_t<decltype(x)>>(
                           {-0.04 * x[0] + 1e4 * x[1] * x[2],
                            0.04 * x[0] - 1e4 * x[1] * x[2] - 3e7 * x[1] * x[1],
                            3e7 * x[1] * x[1]});
                     },
                     {1.0, 0.0, 0.0}, {0.001, 0.01, 0.04, 0.1, 0.4}));
  return all;
}

// The end of the curve of ξ = σ h f(x + ξ/2) from σ = 0, in many small steps; nothing where it turns
// back. Differences for derivatives.
std::optional<VectorXd> reference(const Case& at, const VectorXd& x, double h) {
  const Index n = x.size();
  VectorXd xi = VectorXd::Zero(n), previous = xi;
  const auto residual = [&](const VectorXd& y, double sigma) {
    return VectorXd(y - sigma * h * at.value(x + 0.5 * y));
  };
  double sigma = 0.0, length = 1e-8;
  while (sigma < 1.0) {
    const double next = std::min(1.0, sigma + length);
    VectorXd y = sigma > 0.0 ? VectorXd(xi * (next / sigma)) : VectorXd(next * h * at.value(x));
    bool found = false;
    double first = 0.0;
    for (int iteration = 0; iteration < 8 && !found; ++iteration) {
      MatrixXd J(n, n);
      for (Index j = 0; j < n; ++j) {
        VectorXd up = y, down = y;
        const double d = 1e-6 * (std::fabs(x[j]) + 1e-3);
        up[j] += d;
        down[j] -= d;
        J.col(j) = (residual(up, next) - residual(down, next)) / (2.0 * d);
      }
      const LuDecomposition lu(J);
      if (!(lu.determinant() > 0.0)) break;
      const VectorXd change = lu.solve(residual(y, next));
      y -= change;
      double moved = 0.0;
      for (Index i = 0; i < n; ++i)
        moved =
            std::max(moved, std::fabs(change[i]) / (std::fabs(y[i]) + 0.01 * std::fabs(x[i]) +
                                                    1e-3 * y.lpNorm<Eigen::Infinity>() + 1e-14));
      if (iteration == 0) first = moved;
      if (!(first < 0.02)) break;
      found = moved < 1e-9;
    }
    if (found) {
      xi = y;
      sigma = next;
      length = 1.3 * (next - sigma) + 1.3 * length;
    } else {
      length *= 0.5;
      if (length < 1e-9 * sigma || length < 1e-16) return std::nullopt;
    }
  }
  return VectorXd(x + xi);
}

std::shared_ptr<const ImplicitSystem> system_of(const Case& at) {
  const Index n = at.start.size();
  return std::make_shared<FormulaSystem>(
      std::make_shared<Euclidean>(n), 0, n,
      [formula = at.formula](const ExprVector& x, const ExprVector& v, const ExprVector&,
                             const Expr&) { return ExprVector(v - formula(x)); });
}

}  // namespace

// Every step that is made is the connected one, and where there is one it is found.
BOOST_AUTO_TEST_CASE(steps_with_several_solutions) {
  int made = 0, refused = 0, wrong = 0, missed = 0;
  for (const Case& at : cases()) {
    const auto system = system_of(at);
    const auto map = std::make_shared<Theta>(system->manifold());
    const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = at.start});
    BOOST_TEST_REQUIRE(to_string(ladder.verdict) == "regular", at.name);
    const std::shared_ptr<const Integrator> methods[] = {
        std::make_shared<DiscretizeFirst>(system, map),
        std::make_shared<ConstrainFirst>(system, ladder, map,
                                         std::make_shared<OrthogonalProjector>())};
    for (const auto& method : methods)
      for (const double h : at.steps) {
        const auto stepper = method->stepper();
        State state = ladder.point;
        for (int k = 0; k < 25 && state.x.lpNorm<Eigen::Infinity>() < 1e3; ++k) {
          const VectorXd before = state.x;
          const auto right = reference(at, before, h);
          const auto said = [&](const std::string& what) {
            BOOST_TEST_MESSAGE(at.name << ", " << method->name() << ", h = " << h << ", step " << k
                                       << " from " << before.transpose() << ": " << what);
          };
          try {
            stepper->step(state, h);
            ++made;
            const double scale = 1.0 + state.x.cwiseAbs().maxCoeff();
            if (right && (*right - state.x).cwiseAbs().maxCoeff() < 1e-6 * scale) continue;
            ++wrong;
            said("wrong");
          } catch (const SolveError& error) {
            ++refused;
            if (right) {
              ++missed;
              said(error.what());
            }
            break;
          }
        }
      }
  }
  BOOST_TEST(wrong == 0);
  BOOST_TEST(missed == 0);
  BOOST_TEST(made > 3000);
  BOOST_TEST(refused > 10);
}

// ẋ = 1 - 100 x², h = 1.
BOOST_AUTO_TEST_CASE(the_right_root_of_two) {
  const Case at = cases().front();
  const auto system = system_of(at);
  const DiscretizeFirst method(system, std::make_shared<Theta>(system->manifold()));
  BOOST_TEST(method.advance({.x = at.start}, 1.0, 3).x[0] == 0.15424542,
             boost::test_tools::tolerance(1e-7));
}

// What is confirmed is solved to round-off all the same: for ẋ = 1 - 100 x² from 0, 25 h ξ² + ξ = h.
BOOST_AUTO_TEST_CASE(confirmed_steps_are_as_accurate_as_others) {
  const Case at = cases().front();
  const auto system = system_of(at);
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = at.start});
  const auto map = std::make_shared<Theta>(system->manifold());
  const std::shared_ptr<const Integrator> methods[] = {
      std::make_shared<DiscretizeFirst>(system, map),
      std::make_shared<ConstrainFirst>(system, ladder, map,
                                       std::make_shared<OrthogonalProjector>())};
  for (const auto& method : methods)
    for (const double h : {0.03, 0.1, 1.0}) {
      const auto stepper = method->stepper();
      State state = ladder.point;
      stepper->step(state, h);
      BOOST_TEST(stepper->statistics().confirmations == 1);
      BOOST_TEST(state.x[0] == 2.0 * h / (1.0 + std::sqrt(1.0 + 100.0 * h * h)),
                 boost::test_tools::tolerance(1e-14));
    }
}

// ẋ = 1 + x² from 0 by the midpoint: ξ = h (1 + ξ²/4) has solutions up to h = 1.
BOOST_AUTO_TEST_CASE(a_step_that_is_too_long_is_refused_and_one_that_would_do_is_named) {
  const Case at = cases()[3];
  const auto system = system_of(at);
  const DiscretizeFirst method(system, std::make_shared<Theta>(system->manifold()));
  State state{.x = at.start};
  try {
    method.advance(state, 1.5);
    BOOST_TEST(false, "1.5 was accepted");
  } catch (const SolveError& error) {
    BOOST_TEST((error.reason() == SolveError::Reason::disconnected));
    const std::string text = error.what();
    const auto found = text.find("A step of ");
    BOOST_TEST_REQUIRE(found != std::string::npos, text);
    const double shorter = std::stod(text.substr(found + 10));
    BOOST_TEST(shorter > 0.8);
    BOOST_TEST(shorter < 1.0);
    const double xi = method.advance(state, shorter).x[0];
    // Near the turning point the iteration ends at 1e-10.
    BOOST_TEST(xi == 2.0 * (1.0 - std::sqrt(1.0 - shorter * shorter)) / shorter,
               boost::test_tools::tolerance(1e-9));
  }
}

// ẋ = 1 - 100 x² from 0 by the midpoint rule: 25 h x² + x - h = 0.
BOOST_AUTO_TEST_CASE(a_step_that_was_confirmed_is_right_to_round_off) {
  const auto system = std::make_shared<FormulaSystem>(
      std::make_shared<Euclidean>(1), 0, 1,
      [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return ExprVector::Constant(1, v[0] - 1.0 + 100.0 * square(x[0]));
      });
  const DiscretizeFirst method(system, std::make_shared<Theta>(system->manifold()));
  for (int k = 1; k <= 100; ++k) {
    const double h = 0.01 * k;
    const auto stepper = method.stepper();
    State state{.x = VectorXd::Zero(1)};
    stepper->step(state, h);
    BOOST_TEST(stepper->statistics().confirmations == 1);
    BOOST_TEST(state.x[0] == 2.0 * h / (1.0 + std::sqrt(1.0 + 100.0 * h * h)),
               boost::test_tools::tolerance(1e-14));
  }
}

// ẋ = -300 x: back by h = 0.1 the matrix 1 + 150 h has been singular on the way, but there is no other
// solution to land on.
BOOST_AUTO_TEST_CASE(affine_steps_are_not_confirmed) {
  const auto system = std::make_shared<FormulaSystem>(
      std::make_shared<Euclidean>(1), 0, 1,
      [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return ExprVector(v + 300.0 * x);
      });
  const DiscretizeFirst method(system, std::make_shared<Theta>(system->manifold()));
  const auto stepper = method.stepper();
  State state{.x = VectorXd::Ones(1)};
  stepper->step(state, -0.1);
  BOOST_TEST(state.x[0] == (1.0 + 15.0) / (1.0 - 15.0), boost::test_tools::tolerance(1e-14));
  BOOST_TEST(stepper->statistics().confirmations == 0);
}

// A double pendulum in Cartesian coordinates by Method 1, unit masses and lengths, g = 9.81, from rest with the
// second rod folded onto the first. Its steps leave the circles by h², and momenta go to and fro: no solution is
// near such a state for h → 0, and yet each step has one that belongs to it. The end is that of RK4 in angles.
BOOST_AUTO_TEST_CASE(steps_from_beside_the_constraints_are_taken) {
  const auto system = std::make_shared<FormulaSystem>(
      std::make_shared<Euclidean>(8), 6, 14,
      [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        const ExprVector a = x.head(2), b = x.segment(2, 2), d = b - a, w = z.head(4);
        ExprVector r(14);
        r << v.head(4) - w, v.segment(4, 2) + z[4] * a - z[5] * d, v.tail(2) + z[5] * d,
            x.tail(4) - w, a.dot(a) - 1.0, d.dot(d) - 1.0;
        r[5] += 9.81;
        r[7] += 9.81;
        return r;
      });
  const DiscretizeFirst method(system, std::make_shared<Theta>(system->manifold()));
  const auto stepper = method.stepper();
  State state{.x = (VectorXd(8) << 1, 0, 0, 0, 0, 0, 0, 0).finished()};
  for (int k = 1; k <= 500; ++k) stepper->step(state, 1e-3, 1e-3 * k);
  BOOST_TEST(std::fabs(state.x[0] - 0.5077476783) < 1e-5);
  BOOST_TEST(std::fabs(state.x[3] + 1.237385864) < 1e-5);
  // Predictions know that momenta go to and fro.
  BOOST_TEST(stepper->statistics().confirmations <= 20);
}

// Where the prediction is good nothing is confirmed.
BOOST_AUTO_TEST_CASE(costs_nothing_where_the_prediction_is_good) {
  const Case at = cases()[16];
  const auto system = system_of(at);
  const DiscretizeFirst method(system, std::make_shared<Theta>(system->manifold()));
  const auto stepper = method.stepper();
  State state{.x = at.start};
  for (int k = 0; k < 2000; ++k) stepper->step(state, 0.01);
  BOOST_TEST(stepper->statistics().confirmations <= 4);
  BOOST_TEST(stepper->statistics().second_attempts == 0);
}

// Masses on a ring of springs x²/2 + x⁴/4, from places that differ from mass to mass. Of a thousand masses some turn in
// every step, with displacements that are small next to those of their neighbours.
BOOST_AUTO_TEST_CASE(many_coordinates_are_confirmed_as_seldom_as_few) {
  constexpr Index n = 1000;
  const auto system = std::make_shared<FormulaSystem>(
      std::make_shared<Euclidean>(2 * n), 0, 2 * n,
      [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        ExprVector r = v;
        for (Index i = 0; i < n; ++i) {
          const Expr d = x[(i + 1) % n] - x[i], force = d + d * square(d);
          r[i] -= x[n + i];
          r[n + i] -= force;
          r[n + (i + 1) % n] += force;
        }
        return r;
      });
  const DiscretizeFirst method(system, std::make_shared<Theta>(system->manifold()));
  const auto stepper = method.stepper();
  State state{.x = VectorXd::Zero(2 * n)};
  for (Index i = 0; i < n; ++i) state.x[i] = 0.5 * std::sin(1.7 * static_cast<double>(i * i));
  for (int k = 0; k < 200; ++k) stepper->step(state, 0.1);
  BOOST_TEST(stepper->statistics().confirmations <= 20);
}

BOOST_AUTO_TEST_SUITE_END()
