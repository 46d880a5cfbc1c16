#include "courant/integrators/methods/composition.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numeric>

#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/tests/integrators/example_systems.hpp"
#include "courant/tests/integrators/held_on_sphere.hpp"

using namespace courant;
using examples::equations;
using examples::FormulaSystem;
using examples::HeldOnSphere;

namespace {

using Pointer = std::shared_ptr<const Integrator>;

Pointer method_2(const HeldOnSphere& held) {
  return std::make_shared<ConstrainFirst>(
      held.system, held.ladder,
      std::make_shared<CotangentLift>(held.M, std::make_shared<Chordal>(held.sphere)),
      std::make_shared<OrthogonalProjector>());
}

// A pendulum with a spring, pushed by cos 3t: Method 1 on T*R, explicit in time.
struct DrivenPendulum {
  std::shared_ptr<const Euclidean> line = std::make_shared<Euclidean>(1);
  std::shared_ptr<const CotangentBundle> M = std::make_shared<CotangentBundle>(line);
  std::shared_ptr<const ImplicitSystem> system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<Hamiltonian>(M, [](const ExprVector& x, const Expr& t) {
        return 0.5 * square(x[1]) - cos(x[0]) + x[0] * square(x[0]) / 6.0 - x[0] * cos(3.0 * t);
      }));
  State initial = {0.3, Eigen::Vector2d(0.7, -0.4), {}, {}};

  Pointer method_1(double theta = 0.5) const {
    return std::make_shared<DiscretizeFirst>(
        system, std::make_shared<CotangentLift>(M, std::make_shared<Theta>(line, theta)));
  }
};

Pointer composed(const Pointer& method, int order) {
  return order == 2 ? method : std::make_shared<Composition>(method, order);
}

// Slope of the distance from `exact` at the end over so many steps.
double order_to(const Integrator& method, const State& from, double time, const VectorXd& exact,
                const std::vector<long>& counts) {
  std::vector<double> steps, errors;
  for (const long count : counts) {
    const double h = time / static_cast<double>(count);
    steps.push_back(h);
    errors.push_back((method.advance(from, h, count).x - exact).norm());
  }
  return log_log_slope(steps, errors, 1e-13);
}

// How many steps show the order: few enough for errors above round-off.
std::vector<long> counts(int order) {
  switch (order) {
    case 2:
      return {32, 64, 128, 256};
    case 4:
      return {8, 16, 32, 64};
    case 6:
      return {6, 9, 12, 18, 24};
    default:
      return {5, 6, 7, 8, 10};
  }
}

}  // namespace

// Mistakes that these cases have to notice:
//  * each stage finds directions and derivatives anew
//  * stages learn from those after them in the same step, as if they were over
//  * work of stages does not count (integrators/step/step_parts.hpp)
BOOST_AUTO_TEST_SUITE(composition)

// Σ γ = 1 and Σ γ^k = 0 for odd k below the order: necessary in every method.
BOOST_AUTO_TEST_CASE(coefficients_meet_the_conditions_on_powers) {
  for (const int order : {4, 6, 8}) {
    const auto gamma = Composition::coefficients(order);
    BOOST_TEST(gamma.size() == (order == 4 ? 5u : order == 6 ? 9u : 17u));
    for (std::size_t i = 0; i < gamma.size(); ++i)
      BOOST_TEST(gamma[i] == gamma[gamma.size() - 1 - i]);
    for (int power = 1; power < order; power += 2) {
      double sum = power == 1 ? -1.0 : 0.0;
      for (const double g : gamma) sum += std::pow(g, power);
      BOOST_TEST(std::abs(sum) < 1e-15, "order " << order << ", power " << power << ": " << sum);
    }
  }
}

// The times of the stages are those of the substeps.
BOOST_AUTO_TEST_CASE(orders_with_explicit_time) {
  const DrivenPendulum pendulum;
  const VectorXd exact =
      composed(pendulum.method_1(), 8)->advance(pendulum.initial, 2.0 / 80, 80).x;
  for (const int order : {4, 6}) {
    const Pointer method = composed(pendulum.method_1(), order);
    const double measured = order_to(*method, pendulum.initial, 2.0, exact, {16, 24, 32, 48, 64});
    BOOST_TEST(std::abs(measured - order) < 0.15, "order " << order << " shows " << measured);
  }
}

BOOST_AUTO_TEST_CASE(claims_are_those_of_the_method) {
  const HeldOnSphere held;
  const DrivenPendulum pendulum;
  const auto first = pendulum.method_1(), second = method_2(held);
  for (const int order : {4, 6, 8}) {
    const Composition on_constraints(second, order), free(first, order);
    BOOST_TEST(free.is_symmetric());
    BOOST_TEST((free.is_symplectic() == first->is_symplectic()));
    BOOST_TEST((on_constraints.is_symplectic() == second->is_symplectic()));
    BOOST_TEST(free.name() == "discretize-first of order " + std::to_string(order));
    const State there = free.advance(pendulum.initial, 0.2);
    BOOST_TEST((free.advance(there, -0.2).x - pendulum.initial.x).norm() < 1e-14);
    const State on_set = on_constraints.advance(held.ladder.point, 0.2);
    BOOST_TEST((on_constraints.advance(on_set, -0.2).x - held.ladder.point.x).norm() < 1e-13);
  }
}

// Each stage keeps its factorisation, and starts from where its last steps lead to.
BOOST_AUTO_TEST_CASE(stages_keep_what_they_know) {
  const DrivenPendulum pendulum;
  const auto plain = pendulum.method_1()->stepper();
  State state = pendulum.initial;
  for (int k = 0; k < 60; ++k) plain->step(state, 0.02);
  for (const int order : {4, 6, 8}) {
    const auto stepper = composed(pendulum.method_1(), order)->stepper();
    const auto stages = static_cast<long>(Composition::coefficients(order).size());
    state = pendulum.initial;
    for (int k = 0; k < 60; ++k) stepper->step(state, 0.02);
    const SolverStatistics& counted = stepper->statistics();
    BOOST_TEST(counted.steps == 60);
    BOOST_TEST(counted.failures == 0);
    BOOST_TEST(counted.iterations >= 60 * stages);
    BOOST_TEST(counted.iterations <= 2 * stages * plain->statistics().iterations);
    BOOST_TEST(counted.factorizations <= 2 * stages * plain->statistics().factorizations);
  }
}

// Straight lines through the times of two others, of which none is later than the stage itself, give
// the time of the stage, and are not extended far.
BOOST_AUTO_TEST_CASE(stages_nearby) {
  for (const int order : {4, 6, 8})
    for (const double part : {0.5, 1.0}) {
      const auto steps = Composition::coefficients(order);
      const auto time = [&](std::size_t i) {
        return std::accumulate(steps.begin(), steps.begin() + static_cast<long>(i), 0.0) +
               part * steps[i];
      };
      const auto nearby = Composition::nearby_stages(steps, part);
      BOOST_TEST_REQUIRE(nearby.size() == steps.size());
      for (std::size_t i = 0; i < steps.size(); ++i) {
        double sum = 0.0, end = 0.0;
        for (const auto& [stage, times] : nearby[i]) {
          sum += times;
          end += times * (time(stage) - (stage < i ? 0.0 : 1.0));
          BOOST_TEST(std::fabs(times) < 3.0 + 1e-12);
        }
        BOOST_TEST(std::fabs(sum - 1.0) < 1e-13);
        BOOST_TEST(std::fabs(end - time(i)) < 1e-13);
      }
    }
}

// Stages of Method 2 go on with the directions and derivatives of the stage before and learn from two
// others: where steps are long they need fewer iterations than steppers that know nothing of each
// other, and fewer are followed from their state.
BOOST_AUTO_TEST_CASE(stages_take_over_and_learn) {
  const auto M = std::make_shared<Euclidean>(4);
  const auto pendulum = std::make_shared<FormulaSystem>(
      M, 1, 5, [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        return equations({v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0], v[3] + z[0] * x[1] + 1.0,
                          square(x[0]) + square(x[1]) - 1.0});
      });
  const VectorXd start = Eigen::Vector4d(std::sin(2.0), -std::cos(2.0), 0.0, 0.0);
  const auto method = std::make_shared<ConstrainFirst>(
      pendulum, ConstraintAlgorithm().run(pendulum, {.x = start}), std::make_shared<Theta>(M),
      std::make_shared<OrthogonalProjector>());
  const double h = 8.35 / 32;
  for (const int order : {6, 8}) {
    const auto together = composed(method, order)->stepper();
    const auto gamma = Composition::coefficients(order);
    std::vector<std::unique_ptr<Stepper>> apart;
    for (std::size_t i = 0; i < gamma.size(); ++i) apart.push_back(method->stepper());
    State state{.x = start}, other = state;
    for (int k = 0; k < 64; ++k) {
      together->step(state, h);
      for (std::size_t i = 0; i < gamma.size(); ++i) apart[i]->step(other, gamma[i] * h);
    }
    long iterations = 0, confirmations = 0;
    for (const auto& stage : apart) {
      iterations += stage->statistics().iterations;
      confirmations += stage->statistics().confirmations;
    }
    BOOST_TEST((state.x - other.x).norm() < 1e-11);
    BOOST_TEST(4 * together->statistics().iterations < 3 * iterations);
    BOOST_TEST(2 * together->statistics().confirmations < confirmations);
  }
}

// The greatest distance of substeps, made by a stepper a stage, from those of fresh steppers.
double substeps_from_fresh(const Integrator& method, const State& initial, int order, double h) {
  const auto gamma = Composition::coefficients(order);
  std::vector<std::unique_ptr<Stepper>> stages;
  for (std::size_t i = 0; i < gamma.size(); ++i) stages.push_back(method.stepper());
  State state = initial;
  double greatest = 0.0;
  for (int k = 0; k < 12; ++k)
    for (std::size_t i = 0; i < gamma.size(); ++i) {
      const State alone = method.advance(state, gamma[i] * h);
      stages[i]->step_from(*stages[i == 0 ? gamma.size() - 1 : i - 1], state, gamma[i] * h,
                           state.t + gamma[i] * h);
      greatest = std::max(greatest, (state.x - alone.x).norm());
    }
  return greatest;
}

// Steps so large that they are confirmed by continuation are those of fresh steppers too.
BOOST_AUTO_TEST_CASE(stages_make_the_steps_of_fresh_steppers) {
  const HeldOnSphere held;
  const auto method = method_2(held);
  for (const double h : {0.1, 0.03})
    BOOST_TEST(substeps_from_fresh(*method, held.ladder.point, 8, h) < 1e-14);
}

// The conormals of the third constraint, x[2] = (x[3]² x[4] + x[4]²/2)'', contain x'': what a stage
// remembers of it is as old as its last step.
BOOST_AUTO_TEST_CASE(stages_project_along_the_conormals_of_their_start) {
  const auto M = std::make_shared<Euclidean>(5);
  const auto chain = std::make_shared<FormulaSystem>(
      M, 1, 6, [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        return equations({v[0] - x[1], v[1] - x[2], v[2] - z[0], v[3] - x[4], v[4] + sin(x[3]),
                          x[0] - square(x[3]) * x[4] - 0.5 * square(x[4])});
      });
  const VectorXd start = (VectorXd(5) << 0.0, 0.0, 0.0, 1.2, 0.7).finished();
  const ConstraintLadder ladder = ConstraintAlgorithm().run(chain, {.x = start});
  BOOST_TEST(ladder.degrees_of_freedom == 2);
  const ConstrainFirst method(chain, ladder, std::make_shared<Theta>(M),
                              std::make_shared<OrthogonalProjector>());
  for (const double h : {0.2, 0.05})
    BOOST_TEST(substeps_from_fresh(method, ladder.point, 4, h) < 1e-14);
}

BOOST_AUTO_TEST_CASE(formulas_are_those_of_a_stage) {
  const DrivenPendulum pendulum;
  const auto method = pendulum.method_1();
  const Composition composition(method, 6);
  BOOST_TEST_REQUIRE(composition.formulas().size() == 1u);
  BOOST_TEST(composition.formulas()[0].equation_names == method->formulas()[0].equation_names,
             boost::test_tools::per_element());
}

// A step that fails in its last stages leaves the state, and what follows is what would have been.
BOOST_AUTO_TEST_CASE(a_failure_changes_nothing) {
  // x' = -exp √(x - 1) ends at x = 1: substeps that go beyond fail.
  const auto line = std::make_shared<Euclidean>(1);
  const auto system = std::make_shared<FormulaSystem>(
      line, 0, 1, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return equations({v[0] + exp(sqrt(x[0] - 1.0))});
      });
  const Composition method(std::make_shared<DiscretizeFirst>(system, std::make_shared<Theta>(line)),
                           4);
  const auto stepper = method.stepper();
  State state = {0.0, VectorXd::Constant(1, 2.0), {}, {}};
  stepper->step(state, 0.05);
  const State before = state;
  const long iterations = stepper->statistics().iterations;
  BOOST_CHECK_THROW(stepper->step(state, 1.0), SolveError);
  BOOST_TEST(stepper->statistics().iterations > iterations);
  BOOST_TEST((state == before));
  stepper->step(state, 0.05);
  BOOST_TEST((state.x - method.advance(before, 0.05).x).norm() < 1e-14);
  BOOST_TEST(stepper->statistics().steps == 2);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_composed_is_refused) {
  const DrivenPendulum pendulum;
  const auto message = [](const auto& make) -> std::string {
    try {
      make();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  BOOST_TEST(message([&] { Composition(pendulum.method_1(0.0), 4); }) ==
             "Composition::Composition: order 4 needs a symmetric method of order 2, but "
             "discretize-first as it is chosen here is not symmetric and of order 1.");
  BOOST_TEST(message([&] { Composition(pendulum.method_1(), 5); }) ==
             "Composition::coefficients: order is 5; expected 4, 6 or 8.");
  BOOST_CHECK_THROW(Composition(nullptr, 4), std::invalid_argument);
  BOOST_CHECK_THROW(Composition(composed(pendulum.method_1(), 4), 6), std::invalid_argument);
}

// Method 1 takes the defect of velocity constraints to its opposite: no step is near the identity,
// and compositions stay at order 2.
BOOST_AUTO_TEST_CASE(method_1_on_constraints_stays_at_order_2) {
  const auto M = std::make_shared<Euclidean>(6);
  const auto particle = std::make_shared<FormulaSystem>(
      M, 1, 7, [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        return equations({v[0] - x[3], v[1] - x[4], v[2] - x[5], v[3] + x[0] + z[0] * x[1],
                          v[4] + x[1] + square(x[0]), v[5] - z[0], x[5] - x[1] * x[3]});
      });
  const State initial = {0.0, (VectorXd(6) << 0.3, 0.7, 0.2, 1.0, 0.4, 0.7).finished(), {}, {}};
  const ConstraintLadder ladder = ConstraintAlgorithm().run(particle, {.x = initial.x});
  const Pointer second = std::make_shared<ConstrainFirst>(
      particle, ladder, std::make_shared<Theta>(M), std::make_shared<OrthogonalProjector>());
  const VectorXd exact = composed(second, 8)->advance(initial, 1.0 / 40, 40).x;
  const Pointer first = std::make_shared<DiscretizeFirst>(particle, std::make_shared<Theta>(M));
  const double measured = order_to(*composed(first, 4), initial, 1.0, exact, {16, 32, 64, 128});
  BOOST_TEST(std::abs(measured - 2.0) < 0.3, "shows " << measured);
  const double right = order_to(*composed(second, 4), initial, 1.0, exact, {8, 16, 32, 64});
  BOOST_TEST(std::abs(right - 4.0) < 0.15, "shows " << right);
}

BOOST_AUTO_TEST_SUITE_END()

// Steps of a fifth, where each is followed from its state.
BOOST_AUTO_TEST_SUITE(composition_long)

BOOST_AUTO_TEST_CASE(orders_on_a_constrained_curved_problem) {
  const HeldOnSphere held;
  BOOST_TEST_REQUIRE(to_string(held.ladder.verdict) == "regular", held.ladder.reason);
  BOOST_TEST(held.ladder.degrees_of_freedom == 4);
  const State& initial = held.ladder.point;
  const double time = 1.0;
  const VectorXd exact = composed(method_2(held), 8)->advance(initial, time / 40, 40).x;
  // Another method altogether: the equations of S_f, by Dormand and Prince.
  const ExplicitRungeKutta dopri5(
      std::make_shared<VectorField>(held.system, held.ladder, Backend::interpreter),
      ExplicitRungeKutta::Kind::dormand_prince);
  BOOST_TEST((dopri5.advance(initial, time / 400, 400).x - exact).norm() < 1e-11);
  for (const int order : {2, 4, 6, 8}) {
    const Pointer method = composed(method_2(held), order);
    BOOST_TEST(method->order() == order);
    const double measured = order_to(*method, initial, time, exact, counts(order));
    BOOST_TEST(std::abs(measured - order) < 0.15, "order " << order << " shows " << measured);
  }
}

BOOST_AUTO_TEST_CASE(constraints_hold_at_every_node) {
  const HeldOnSphere held;
  for (const int order : {4, 6, 8}) {
    const auto stepper = composed(method_2(held), order)->stepper();
    State state = held.ladder.point;
    double worst = 0.0;
    for (int k = 0; k < 100; ++k) {
      stepper->step(state, 0.2);
      worst = std::max(worst, HeldOnSphere::violation(state.x));
    }
    BOOST_TEST(worst < 1e-13, "order " << order << " leaves M_f by " << worst);
  }
}

BOOST_AUTO_TEST_SUITE_END()
