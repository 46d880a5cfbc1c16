#include "courant/integrators/methods/substepping_integrator.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/measurement.hpp"
#include "courant/tests/integrators/example_systems.hpp"

using namespace courant;
using examples::equations;
using examples::FormulaSystem;

namespace {

using Pointer = std::shared_ptr<const Integrator>;
using V = const ExprVector&;
using T = const Expr&;
using Times = std::vector<double>;

Pointer midpoint(const FormulaSystem::Formula& formula) {
  const auto line = std::make_shared<Euclidean>(1);
  return std::make_shared<DiscretizeFirst>(std::make_shared<FormulaSystem>(line, 0, 1, formula),
                                           std::make_shared<Theta>(line));
}

// x' = -x³ + |t - 1/3|, bent at t = 1/3.
Pointer bent() {
  return midpoint([](V x, V v, V, T t) {
    return equations({v[0] + x[0] * square(x[0]) - abs(t - 1.0 / 3.0)});
  });
}

// x' = x²: with x > 0 a step of the midpoint rule exists for h x ≤ 1/2.
Pointer square_growth() {
  return midpoint([](V x, V v, V, T) { return equations({v[0] - square(x[0])}); });
}
// That step: m = (1 - √(1 - 2 h x))/h in the middle.
double square_step(double x, double h) {
  const double m = (1.0 - std::sqrt(1.0 - 2.0 * h * x)) / h;
  return x + h * m * m;
}

State at(double x, double t = 0.0) { return {.t = t, .x = VectorXd::Constant(1, x)}; }

}  // namespace

// Mistakes that these cases have to notice:
//  * a step that is refused is never made in halves
//  * halves are never halved again
//  * a corner in each period is the first alone
//  * a step back meets its corners in the wrong order
//  * corners next to the end of a step make pieces of round-off
BOOST_AUTO_TEST_SUITE(substepping_integrator)

BOOST_AUTO_TEST_CASE(corners_of_a_step) {
  const auto within = [](const std::vector<Corner>& corners, double t, double h) {
    return SubsteppingIntegrator::corners_within(corners, t, h);
  };
  const std::vector<Corner> corners = {{0.3, 0.0}, {0.1, 1.0}, {1.15, 0.0}};
  BOOST_TEST((within(corners, 0.0, 0.5) == Times{0.1, 0.3}));
  BOOST_TEST((within(corners, 0.5, -0.5) == Times{0.3, 0.1}));
  BOOST_TEST((within(corners, 0.3, 0.5) == Times{}));
  BOOST_TEST((within(corners, -0.2, 0.5) == Times{0.1}));
  BOOST_TEST((within(corners, -5.0, 4.0) == Times{}));
  BOOST_TEST((within(corners, 1.0, 0.5) == Times{1.1, 1.15}));
  const Times many = within(corners, 10.0, 3.0);
  BOOST_TEST_REQUIRE(many.size() == 3u);
  BOOST_TEST(std::abs(many[2] - 12.1) < 1e-14);
  // Round-off makes no pieces.
  BOOST_TEST((within(corners, 0.1 - 1e-16, 0.1) == Times{}));
  BOOST_TEST((within({{0.3, 0.0}, {0.3 + 1e-12, 0.0}}, 0.0, 1.0) == Times{0.3}));
  BOOST_CHECK_THROW(within({{0.0, 1e-9}}, 0.0, 1.0), SolveError);
}

// Steps over the bend are those of their pieces; the error is of order 2 again, where the bend costs an
// error that depends on where in the step it lies.
BOOST_AUTO_TEST_CASE(steps_end_at_corners) {
  const Pointer plain = bent();
  const SubsteppingIntegrator divided(plain, {.corners = {{1.0 / 3.0, 0.0}}});
  const State pieces = plain->advance(plain->advance(at(0.7), 1.0 / 3.0), 0.1);
  BOOST_TEST(std::abs(divided.advance(at(0.7), 1.0 / 3.0 + 0.1).x[0] - pieces.x[0]) < 1e-14);

  const double exact = divided.advance(at(0.7), 1e-4, 10000).x[0];
  std::vector<double> steps, errors, errors_without;
  for (const long count : {10, 20, 40, 80, 160}) {
    steps.push_back(1.0 / static_cast<double>(count));
    errors.push_back(std::abs(divided.advance(at(0.7), steps.back(), count).x[0] - exact));
    errors_without.push_back(std::abs(plain->advance(at(0.7), steps.back(), count).x[0] - exact));
  }
  BOOST_TEST(std::abs(log_log_slope(steps, errors, 1e-13) - 2.0) < 0.15);
}

BOOST_AUTO_TEST_CASE(refused_steps_are_made_in_halves) {
  const Pointer plain = square_growth();
  const double h = 0.7;
  BOOST_CHECK_THROW(plain->advance(at(1.0), h), SolveError);
  const SubsteppingIntegrator divided(plain, {.halvings = 4});
  // 0.35 is possible, the second half is not, its halves are.
  double x = square_step(1.0, 0.35);
  BOOST_TEST_REQUIRE(0.35 * x > 0.5);
  x = square_step(x, 0.175);
  BOOST_TEST_REQUIRE(0.175 * x < 0.5);
  x = square_step(x, 0.175);
  const auto stepper = divided.stepper();
  stepper->tell_parts();
  State state = at(1.0);
  stepper->step(state, h);
  BOOST_TEST(std::abs(state.x[0] - x) < 1e-13 * x);
  BOOST_TEST(state.t == h);
  BOOST_TEST(stepper->statistics().steps == 1);
  BOOST_TEST(stepper->statistics().divisions == 1);
  const Step& step = stepper->last();
  BOOST_TEST_REQUIRE(step.parts.size() == 3u);
  BOOST_TEST(step.parts[0].h == 0.35);
  BOOST_TEST(step.parts[2].h == 0.175);
  BOOST_TEST((step.parts[1].before == step.parts[0].after));
  BOOST_TEST((step.parts[2].after == state));
  BOOST_TEST((step.stage == step.parts[2].stage));

  // The same step whatever was done before, back in time from elsewhere, and the same after a failure.
  State other = at(0.2);
  for (int k = 0; k < 5; ++k) stepper->step(other, 0.1);
  const State kept = other;
  BOOST_CHECK_THROW(stepper->step(other, 1e3), SolveError);
  BOOST_TEST((other == kept));
  State again = at(1.0);
  stepper->step(again, h);
  BOOST_TEST(std::abs(again.x[0] - x) < 1e-12 * x);

  // Small steps are not divided.
  State small = at(1.0);
  const auto fresh = divided.stepper();
  for (int k = 0; k < 5; ++k) fresh->step(small, 0.05);
  BOOST_TEST(fresh->statistics().divisions == 0);
  BOOST_TEST(small.x[0] == plain->advance(at(1.0), 0.05, 5).x[0]);
}

BOOST_AUTO_TEST_CASE(halvings_end) {
  // With one halving the second half is refused.
  const SubsteppingIntegrator once(square_growth(), {.halvings = 1});
  const auto stepper = once.stepper();
  State state = at(1.0);
  BOOST_CHECK_THROW(stepper->step(state, 0.7), SolveError);
  BOOST_TEST((state == at(1.0)));
  BOOST_TEST(stepper->statistics().divisions == 0);
}

BOOST_AUTO_TEST_CASE(pieces_between_corners_are_made_in_parts) {
  const Pointer plain = bent();
  const auto divided = SubsteppingIntegrator(plain, {.corners = {{1.0 / 3.0, 0.0}}}).in_parts(2);
  State by_hand = at(0.7);
  for (const double h : {1.0 / 6.0, 1.0 / 6.0, 1.0 / 12.0, 1.0 / 12.0})
    by_hand = plain->advance(by_hand, h);
  const State found = divided->advance(at(0.7), 0.5);
  BOOST_TEST(std::abs(found.x[0] - by_hand.x[0]) < 1e-14);
  BOOST_TEST(found.t == 0.5);
  BOOST_CHECK_THROW(divided->in_parts(0), std::invalid_argument);
}

// The tangent map is the product of those of the pieces: of 1/x(t) = 1/x - t up to the error of the method, and of
// differences of its steps.
BOOST_AUTO_TEST_CASE(differential_of_substepping) {
  const SubsteppingIntegrator divided(square_growth(), {.corners = {{0.1, 0.0}}, .halvings = 4});
  const auto differential = divided.differential();
  BOOST_TEST_REQUIRE(static_cast<bool>(differential));
  for (const double h : {0.05, 0.2, 0.7}) {
    const auto stepper = divided.stepper();
    stepper->tell_parts();
    State state = at(1.0);
    stepper->step(state, h);
    const double image = (*differential)(stepper->last(), MatrixXd::Ones(1, 1))(0, 0);
    const double e = 1e-5;
    const double difference =
        (divided.advance(at(1.0 + e), h).x[0] - divided.advance(at(1.0 - e), h).x[0]) / (2.0 * e);
    BOOST_TEST(std::abs(image - difference) < 1e-6 * std::abs(image), "h = " << h);
  }
}

BOOST_AUTO_TEST_CASE(claims_and_refusals) {
  const Pointer plain = bent();
  BOOST_TEST(SubsteppingIntegrator(plain, {.corners = {{0.1, 0.2}}}).is_symmetric());
  BOOST_TEST(SubsteppingIntegrator(plain, {.halvings = 1}).order() == 2);
  BOOST_CHECK_THROW(SubsteppingIntegrator(nullptr, {}), std::invalid_argument);
  BOOST_CHECK_THROW(SubsteppingIntegrator(plain, {.halvings = -1}), std::invalid_argument);
  BOOST_CHECK_THROW(SubsteppingIntegrator(plain, {.corners = {{0.0, -1.0}}}),
                    std::invalid_argument);
  BOOST_CHECK_THROW(SubsteppingIntegrator(plain, {.corners = {{NAN, 0.0}}}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
