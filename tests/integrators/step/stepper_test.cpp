#include "courant/integrators/step/stepper.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/methods/explicit_runge_kutta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/tests/integrators/example_systems.hpp"

// Mistakes that these cases have to notice:
//  * the first step after forgetting is confirmed though the motion is known
//    (integrators/step/step_solver.cpp)
//  * much is expected of a motion that was not predictable (integrators/step/step_solver.cpp)
//  * a step goes on from a state that was forgotten
//  * a step that goes on begins before the last one
//  * all steps of a method end at the time of the first (integrators/step/integrator.hpp)
BOOST_AUTO_TEST_SUITE(stepper)

using namespace courant;
using examples::FormulaSystem;

namespace {

// A system, a state that fits it, and methods for it.
struct Case {
  std::string name;
  std::shared_ptr<const Integrator> method;
  State start;
  double h;
  double round_off = 2e-14;     // of a step
  bool keeps_its_order = true;  // in a single step
};

// A pendulum of length 1 in the plane, pushed by cos t: x² + y² = 1, multiplier z.
std::shared_ptr<const ImplicitSystem> pendulum() {
  return std::make_shared<FormulaSystem>(
      std::make_shared<Euclidean>(4), 1, 5,
      [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr& t) {
        return examples::equations({v[0] - x[2], v[1] - x[3], v[2] - z[0] * x[0] - 0.3 * cos(t),
                                    v[3] - z[0] * x[1] + 9.81, square(x[0]) + square(x[1]) - 1.0});
      });
}

// On S²: v = a(x) × x for the field a = (x_2, t, x_0), and where `level` is set x_2 = level
// besides, kept by a force z along the gradient.
class OnSphere final : public ImplicitSystem {
 public:
  explicit OnSphere(std::optional<double> level = {})
      : ImplicitSystem(std::make_shared<Sphere>(2), level ? 1 : 0, level ? 4 : 3, {}),
        level_(level) {}
  Index tangent_blocks() const override { return 1; }

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr& t) const override {
    const ExprVector turning = examples::equations(
        {0.3 * t * x[2] - x[0] * x[1], x[0] * x[0] - x[2] * x[2], x[2] * x[1] - 0.3 * t * x[0]});
    if (!level_) return v - turning;
    const ExprVector up = examples::equations({0.0, 0.0, 1.0});
    ExprVector F(4);
    F << v - turning - z[0] * (manifold()->tangent_projector(x) * up).eval(), x[2] - *level_;
    return F;
  }
  std::optional<double> level_;
};

std::vector<Case> cases() {
  std::vector<Case> result;
  const auto add = [&](const std::string& name, const std::shared_ptr<const ImplicitSystem>& system,
                       const VectorXd& x, double h, bool explicit_too) {
    const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = x});
    BOOST_TEST_REQUIRE(to_string(ladder.verdict) == "regular", name);
    const auto map = std::make_shared<Theta>(system->manifold());
    // Method 1 divides round-off by h once for each differentiation, and one of its steps loses as
    // many orders.
    const bool constrained = ladder.degrees_of_freedom < system->manifold()->dimension();
    result.push_back({name + ", method 1", std::make_shared<DiscretizeFirst>(system, map),
                      ladder.point, h, constrained ? 1e-12 : 2e-14, !constrained});
    result.push_back({name + ", method 2",
                      std::make_shared<ConstrainFirst>(system, ladder, map,
                                                       std::make_shared<OrthogonalProjector>()),
                      ladder.point, h, 5e-14});
    if (!explicit_too) return;
    const auto field = std::make_shared<VectorField>(system, ladder, Backend::interpreter);
    for (const auto kind :
         {ExplicitRungeKutta::Kind::midpoint, ExplicitRungeKutta::Kind::classical,
          ExplicitRungeKutta::Kind::dormand_prince, ExplicitRungeKutta::Kind::fehlberg})
      result.push_back({name + ", explicit", std::make_shared<ExplicitRungeKutta>(field, kind),
                        ladder.point, h});
  };
  add("pendulum", pendulum(), (VectorXd(4) << 0.6, -0.8, 0.4, 0.3).finished(), 0.01, true);
  add("sphere", std::make_shared<OnSphere>(), Eigen::Vector3d(0.6, 0.48, 0.64), 0.05, true);
  add("circle on a sphere", std::make_shared<OnSphere>(0.6), Eigen::Vector3d(0.8, 0.0, 0.6), 0.05,
      false);
  return result;
}

double distance(const State& a, const State& b) {
  BOOST_TEST_REQUIRE(a.x.size() == b.x.size());
  return (a.x - b.x).lpNorm<Eigen::Infinity>();
}

}  // namespace

BOOST_AUTO_TEST_CASE(w1_a_step_depends_on_state_and_size_alone) {
  for (const Case& at : cases()) {
    BOOST_TEST_CONTEXT(at.name) {
      const auto stepper = at.method->stepper();
      State state = at.start;
      const double sizes[] = {1.0, 1.0, 1.0, 1.0, 0.5, 0.5, -0.25, 0.3, 1.0, -1.0};
      for (int k = 0; k < 60; ++k) {
        const double h = at.h * sizes[k % 10];
        const State fresh = at.method->advance(state, h);
        stepper->step(state, h);
        const Step& step = stepper->last();
        BOOST_TEST(distance(fresh, state) < at.round_off);
        BOOST_TEST(state.t == fresh.t);
        BOOST_TEST(step.h == h);
        BOOST_TEST((step.after == state));
      }
    }
  }
}

// The stages of a composition: sequences of equal steps from states in between.
BOOST_AUTO_TEST_CASE(w1_steps_of_several_curves) {
  for (const Case& at : cases()) {
    BOOST_TEST_CONTEXT(at.name) {
      const double gamma = 1.0 / (2.0 - std::cbrt(2.0));
      const double sizes[] = {gamma * at.h, (1.0 - 2.0 * gamma) * at.h, gamma * at.h};
      const std::unique_ptr<Stepper> stages[] = {at.method->stepper(), at.method->stepper(),
                                                 at.method->stepper()};
      State state = at.start;
      for (int k = 0; k < 30; ++k)
        for (int i = 0; i < 3; ++i) {
          const State fresh = at.method->advance(state, sizes[i]);
          stages[i]->step(state, sizes[i]);
          BOOST_TEST(distance(fresh, state) < at.round_off);
        }
      State elsewhere = at.start;
      const State fresh = at.method->advance(elsewhere, at.h);
      stages[0]->step(elsewhere, at.h);
      BOOST_TEST((fresh == elsewhere));
    }
  }
}

BOOST_AUTO_TEST_CASE(w2_after_forgetting_the_same_to_the_last_bit) {
  for (const Case& at : cases()) {
    BOOST_TEST_CONTEXT(at.name) {
      const auto stepper = at.method->stepper();
      State state = at.start;
      for (int k = 0; k < 25; ++k) stepper->step(state, at.h);
      stepper->forget();
      const auto fresh = at.method->stepper();
      State other = state;
      for (int k = 0; k < 25; ++k) {
        stepper->step(state, at.h);
        fresh->step(other, at.h);
        BOOST_TEST_REQUIRE((state == other));
      }
    }
  }
}

// A stepper that is told of the motion makes the steps of one that is not, and confirms fewer.
BOOST_AUTO_TEST_CASE(steps_that_go_on_with_a_known_motion_are_less_confirmed) {
  long by_told = 0, by_untold = 0;
  for (const Case& at : cases()) {
    BOOST_TEST_CONTEXT(at.name) {
      const auto stepper = at.method->stepper(), told = at.method->stepper(),
                 untold = at.method->stepper();
      State state = at.start;
      for (int k = 0; k < 25; ++k) stepper->step(state, at.h);
      const Motion motion = stepper->motion();
      State other = state, third = state;
      told->expect(motion);
      stepper->forget();
      stepper->expect(motion);
      const long before = stepper->statistics().confirmations;
      for (int k = 0; k < 25; ++k) {
        stepper->step(state, at.h);
        told->step(other, at.h);
        untold->step(third, at.h);
        BOOST_TEST_REQUIRE((state == other));
        BOOST_TEST_REQUIRE((state == third));
      }
      BOOST_TEST(stepper->statistics().confirmations - before == told->statistics().confirmations);
      BOOST_TEST(told->statistics().confirmations <= untold->statistics().confirmations);
      by_told += told->statistics().confirmations;
      by_untold += untold->statistics().confirmations;
    }
  }
  BOOST_TEST(by_told < by_untold);
}

// Of a motion that was not predictable nothing is expected.
BOOST_AUTO_TEST_CASE(a_motion_that_was_not_predictable_is_confirmed_as_ever) {
  for (const Case& at : cases()) {
    BOOST_TEST_CONTEXT(at.name) {
      const auto stepper = at.method->stepper();
      State state = at.start;
      for (int k = 0; k < 25; ++k) stepper->step(state, at.h);
      Motion motion = stepper->motion();
      motion.is_predictable = false;
      const auto told = at.method->stepper(), untold = at.method->stepper();
      State other = state;
      told->expect(motion);
      told->step(state, at.h);
      untold->step(other, at.h);
      BOOST_TEST(told->statistics().confirmations == untold->statistics().confirmations);
    }
  }
}

BOOST_AUTO_TEST_CASE(w3_a_failed_step_leaves_no_trace) {
  for (const Case& at : cases()) {
    BOOST_TEST_CONTEXT(at.name) {
      const auto stepper = at.method->stepper(), undisturbed = at.method->stepper();
      State state = at.start, other = at.start;
      int failed = 0;
      for (int k = 0; k < 20; ++k) {
        stepper->step(state, at.h);
        undisturbed->step(other, at.h);
        const State before = state;
        try {
          stepper->step(state, 1e200);
        } catch (const SolveError& error) {
          ++failed;
          BOOST_TEST(error.time() == before.t);
          BOOST_TEST(error.step_size() == 1e200);
          BOOST_TEST((state == before));
          BOOST_TEST((stepper->last().after == before));
        }
        state = before;
        BOOST_TEST(distance(state, other) < 20 * at.round_off);
      }
      BOOST_TEST(failed == 20);
      BOOST_TEST(stepper->statistics().steps == 20);
    }
  }
}

// The state is that of the stepper: the same steps, also after one that could not be made.
BOOST_AUTO_TEST_CASE(steps_that_go_on_need_not_be_told_where) {
  for (const Case& at : cases()) {
    BOOST_TEST_CONTEXT(at.name) {
      const auto stepper = at.method->stepper(), told = at.method->stepper();
      BOOST_CHECK_THROW(stepper->go_on(at.h, at.h), std::logic_error);
      State state = at.start, prepared = at.start;
      stepper->prepare(prepared, at.h);
      const auto both = [&](double h, double end) {
        told->step(state, h, end);
        stepper->go_on(h, end);
        BOOST_TEST_REQUIRE((stepper->ended().after == state));
      };
      for (int k = 1; k <= 12; ++k) both(at.h, at.start.t + k * at.h);
      BOOST_TEST((at.method->advance(at.start, at.h, 12) == state));
      BOOST_TEST((at.method->advance(at.start, at.h, 0) == at.start));
      for (int k = 0; k < 5; ++k) both(0.5 * at.h, state.t + 0.5 * at.h);
      BOOST_CHECK_THROW(told->step(state, 1e200), SolveError);
      BOOST_CHECK_THROW(stepper->go_on(1e200, 1e200), SolveError);
      BOOST_CHECK_THROW(stepper->go_on(0.0, 1.0), std::invalid_argument);
      BOOST_TEST((stepper->ended().after == state));
      for (int k = 0; k < 3; ++k) both(at.h, state.t + at.h);
      BOOST_TEST(stepper->statistics().steps == 20);
      stepper->forget();
      BOOST_CHECK_THROW(stepper->go_on(at.h, at.h), std::logic_error);
    }
  }
}

// Between its ends the curve is as good as the ends are, and where they are.
BOOST_AUTO_TEST_CASE(the_curve_of_the_last_step) {
  for (const Case& at : cases()) {
    BOOST_TEST_CONTEXT(at.name << ", order " << at.method->order()) {
      const auto stepper = at.method->stepper();
      State state = at.start;
      BOOST_CHECK_THROW(stepper->between(0.5), std::logic_error);
      for (int k = 0; k < 3; ++k) stepper->step(state, at.h);
      BOOST_TEST((stepper->between(0.0) == stepper->last().before));
      BOOST_TEST((stepper->between(1.0) == state));
      BOOST_CHECK_THROW(stepper->between(1.5), std::invalid_argument);
      // It does not disturb the steps.
      State other = state;
      const State middle = stepper->between(0.4);
      BOOST_TEST(middle.t == stepper->last().before.t + 0.4 * at.h);
      BOOST_TEST(distance(at.method->advance(stepper->last().before, 0.4 * at.h), middle) <
                 at.round_off);
      stepper->step(state, at.h);
      BOOST_TEST(distance(at.method->advance(other, at.h), state) < at.round_off);
      if (!at.keeps_its_order) continue;
      // Errors of one step against many small ones: order + 1.
      std::vector<double> sizes, errors;
      for (const double factor : {8.0, 4.0, 2.0, 1.0}) {
        const double h = factor * at.h;
        const auto one = at.method->stepper();
        State end = at.start;
        one->step(end, h);
        const State exact = at.method->advance(at.start, 0.4 * h / 64, 64);
        sizes.push_back(h);
        errors.push_back(distance(one->between(0.4), exact));
      }
      const double slope = log_log_slope(sizes, errors, 1e-14);
      BOOST_TEST(slope > at.method->order() + 0.7, slope);
    }
  }
}

BOOST_AUTO_TEST_CASE(what_a_step_knows) {
  // ẋ = cos t on R: with θ = ¼ the stage is a quarter of the way.
  const auto system = std::make_shared<FormulaSystem>(
      std::make_shared<Euclidean>(1), 0, 1,
      [](const ExprVector&, const ExprVector& v, const ExprVector&, const Expr& t) {
        return ExprVector(ExprVector::Constant(1, v[0] - cos(t)));
      });
  const auto map = std::make_shared<Theta>(system->manifold(), 0.25);
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = VectorXd::Zero(1)});
  const std::shared_ptr<const Integrator> methods[] = {
      std::make_shared<DiscretizeFirst>(system, map),
      std::make_shared<ConstrainFirst>(system, ladder, map,
                                       std::make_shared<OrthogonalProjector>())};
  for (const auto& method : methods) {
    const auto stepper = method->stepper();
    State state{.t = 2.0, .x = VectorXd::Constant(1, 5.0)};
    stepper->step(state, 0.4, 2.4);
    const Step& step = stepper->last();
    const double v = std::cos(2.1);
    BOOST_TEST(step.before.t == 2.0);
    BOOST_TEST(step.before.x[0] == 5.0);
    BOOST_TEST(step.stage.t == 2.1, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(step.stage.x[0] == 5.0 + 0.1 * v, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(step.stage.v[0] == v, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(step.after.x[0] == 5.0 + 0.4 * v, boost::test_tools::tolerance(1e-15));
    BOOST_TEST(state.t == 2.4);
  }
}

BOOST_AUTO_TEST_CASE(the_clock_is_the_callers) {
  const Case at = cases().front();
  const auto stepper = at.method->stepper();
  State state = at.start;
  for (int k = 1; k <= 1000; ++k) stepper->step(state, 0.001, 0.001 * k);
  BOOST_TEST(state.t == 1.0);
}

// A system on a point: nothing moves but time.
BOOST_AUTO_TEST_CASE(no_dimension_at_all) {
  const auto system =
      std::make_shared<FormulaSystem>(std::make_shared<Euclidean>(0), 0, 0,
                                      [](const ExprVector&, const ExprVector&, const ExprVector&,
                                         const Expr&) { return ExprVector(0); });
  const DiscretizeFirst method(system, std::make_shared<Theta>(system->manifold()));
  const State end = method.advance({}, -0.5, 3);
  BOOST_TEST(end.t == -1.5);
  BOOST_TEST(end.x.size() == 0);
}

BOOST_AUTO_TEST_CASE(wrong_arguments_are_refused_and_nothing_moves) {
  const Case at = cases().front();
  const auto stepper = at.method->stepper();
  const auto refused = [&](State state, double h) {
    const State before = state;
    BOOST_CHECK_THROW(stepper->step(state, h), std::invalid_argument);
    BOOST_TEST((state == before));
  };
  refused(at.start, 0.0);
  refused(at.start, std::numeric_limits<double>::infinity());
  refused(at.start, std::numeric_limits<double>::quiet_NaN());
  refused({.x = VectorXd::Zero(3)}, 0.1);
  refused({.x = at.start.x, .v = VectorXd::Zero(3)}, 0.1);
  refused({.x = at.start.x, .z = VectorXd::Zero(2)}, 0.1);
}

BOOST_AUTO_TEST_SUITE_END()
