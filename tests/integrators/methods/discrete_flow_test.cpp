#include "courant/integrators/methods/discrete_flow.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "../example_systems.hpp"
#include "../step/integrator_catalogue.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/composition.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/integrators/step/parameter_projector.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/parameter_extension.hpp"

// Mistakes that these cases have to notice:
//  * slopes at the steps between are left out of a gradient, or come a step too late
//  * what is pulled back is not that of the steps which were made
//  * the adjoint of a step forgets the unknowns z (integrators/step/stage_step_differential.cpp)
//  * the adjoint of Method 2 is that of its end alone
//    (integrators/methods/constrain_first_differential.cpp)
//  * the constraint set stands still while a parameter moves (structures/parameter_extension.cpp)
//  * a solution of a linear system is right next to the largest of its numbers alone
//    (integrators/step/step_differential.cpp)
//  * exponents are those of the last step
BOOST_AUTO_TEST_SUITE(discrete_flow)

using namespace courant;

namespace {

const std::vector<test::IntegratorEntry>& methods() {
  static const auto table = test::integrator_catalogue();
  return table;
}

VectorXd vector(std::initializer_list<double> entries) {
  return Eigen::Map<const VectorXd>(entries.begin(), static_cast<Index>(entries.size()));
}

std::shared_ptr<const CotangentBundle> plane() {
  return std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
}

// H = p²/2 + s k q²/2 on T*R.
std::shared_ptr<const ImplicitSystem> quadratic(double k) {
  return std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(plane()),
      std::make_shared<Hamiltonian>(plane(), [k](const ExprVector& x, const Expr&) {
        return (x[1] * x[1] + Parameter{"k", k}.at(x) * x[0] * x[0]) / 2.0;
      }));
}

// Of S, or of its extension, on a product of T*R and Rᵖ.
std::shared_ptr<const Integrator> midpoint(const std::shared_ptr<const ImplicitSystem>& system) {
  return std::make_shared<DiscretizeFirst>(system, std::make_shared<Theta>(system->manifold(), 0.5),
                                           DiscretizeFirst::Options{Backend::interpreter});
}

// A pendulum of length l in the plane, with gravity g: x' = v, v' = -(0, g) - λ x, |x|² = l².
constexpr double kLength = 1.3, kGravity = 9.81;
std::shared_ptr<const ImplicitSystem> pendulum() {
  return std::make_shared<examples::FormulaSystem>(
      std::make_shared<Euclidean>(4), 1, 5,
      [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        const Expr l = Parameter{"l", kLength}.at(x), g = Parameter{"g", kGravity}.at(x);
        return examples::equations({v[0] - x[2], v[1] - x[3], v[2] + z[0] * x[0],
                                    v[3] + g + z[0] * x[1], x[0] * x[0] + x[1] * x[1] - l * l});
      });
}

struct Constrained {
  ParameterExtension with{pendulum(), {{"l", kLength}, {"g", kGravity}}};
  ConstraintLadder ladder;
  std::shared_ptr<const Integrator> method;

  explicit Constrained(int order = 2) {
    const double angle = 0.4;
    const State start{.x = vector({kLength * std::sin(angle), -kLength * std::cos(angle),
                                   0.6 * std::cos(angle), 0.6 * std::sin(angle)})};
    ladder = extended_ladder(with, start);
    method = std::make_shared<ConstrainFirst>(
        with.extended(), ladder, std::make_shared<Theta>(with.extended()->manifold(), 0.5),
        std::make_shared<ParameterProjector>(std::make_shared<OrthogonalProjector>(), with),
        ConstrainFirst::Options{Backend::interpreter});
    if (order > 2) method = std::make_shared<Composition>(method, order);
  }
  MatrixXd directions() const {
    return consistent_directions(*with.extended()->manifold(), ladder.conormals(), ladder.point.x);
  }
  // By differences of order 8 of steps from consistent points nearby, as long as `size`.
  VectorXd by_differences(const DiscreteFlow& flow, const VectorXd& direction, double size) const {
    constexpr std::array weights = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
    VectorXd sum = VectorXd::Zero(direction.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double s = static_cast<double>(i + 1) * size;
      const auto end = [&](double along) {
        return flow.push_forward(moved(direction, along), MatrixXd(6, 0)).end.x;
      };
      sum += weights[i] / size * (end(s) - end(-s));
    }
    return sum;
  }
  // A curve of consistent points (angle, speed, l, g) with this velocity, in closed form.
  State moved(const VectorXd& direction, double along) const {
    const VectorXd& x = ladder.point.x;
    const double l = x[4], angle = std::atan2(x[0], -x[1]),
                 speed = x[2] * std::cos(angle) + x[3] * std::sin(angle);
    const double turn = (direction[0] * std::cos(angle) + direction[1] * std::sin(angle)) / l;
    const double faster = direction[2] * std::cos(angle) + direction[3] * std::sin(angle);
    const double a = angle + along * turn, u = speed + along * faster,
                 length = l + along * direction[4];
    State state = ladder.point;
    state.x = vector({length * std::sin(a), -length * std::cos(a), u * std::cos(a), u * std::sin(a),
                      length, x[5] + along * direction[5]});
    return state;
  }
};

// The same pendulum with momenta, and with velocities as unknowns: x' = w, p' = -m (0, g) - λ x, m w = p.
constexpr double kMass = 0.7;
std::shared_ptr<const ImplicitSystem> pendulum_with_momenta() {
  return std::make_shared<examples::FormulaSystem>(
      std::make_shared<Euclidean>(4), 3, 7,
      [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        const Expr m = Parameter{"m", kMass}.at(x);
        return examples::equations(
            {v[0] - z[0], v[1] - z[1], v[2] + z[2] * x[0], v[3] + m * kGravity + z[2] * x[1],
             m * z[0] - x[2], m * z[1] - x[3], x[0] * x[0] + x[1] * x[1] - kLength * kLength});
      });
}

}  // namespace

// x_n = A(k)ⁿ x₀ with A = (1 - hB/2)⁻¹ (1 + hB/2), B = (0 1; -k 0), a rotation in (√k q, p) by θ with tan(θ/2) = √k h/2.
BOOST_AUTO_TEST_CASE(derivatives_by_a_parameter_are_those_of_the_closed_form) {
  const double k = 2.3, h = 0.1, q = 0.8;
  const long n = 37;
  const ParameterExtension with(quadratic(k), {{"k", k}});
  const DiscreteFlow flow(midpoint(with.extended()), h, n);
  const auto [end, images] =
      flow.push_forward(with.to_extended({.x = vector({q, 0})}), MatrixXd::Identity(3, 3));
  const double w = std::sqrt(k), theta = 2.0 * std::atan(0.5 * w * h), N = static_cast<double>(n);
  const double turn = h / (1.0 + 0.25 * w * w * h * h) / (2.0 * w);  // dθ/dk
  BOOST_TEST(std::abs(end.x[0] - q * std::cos(N * theta)) < 1e-13);
  BOOST_TEST(std::abs(images(0, 2) + q * N * std::sin(N * theta) * turn) < 1e-12);
  BOOST_TEST(std::abs(images(1, 2) + q * std::sin(N * theta) / (2.0 * w) +
                      w * q * N * std::cos(N * theta) * turn) < 1e-12);
  BOOST_TEST(std::abs(images(0, 0) - std::cos(N * theta)) < 1e-13);
  BOOST_TEST((images.row(2) == VectorXd::Unit(3, 2).transpose()));
  BOOST_TEST(end.x[2] == k);
}

// Of Method 2, whose constraint set moves with the length, alone and in a composition.
BOOST_AUTO_TEST_CASE(derivatives_go_through_constraints_that_a_parameter_moves) {
  for (const int order : {2, 4}) {
    const Constrained problem(order);
    const DiscreteFlow flow(problem.method, 0.05, 12);
    const MatrixXd V = problem.directions();
    BOOST_TEST_REQUIRE(V.cols() == 4);
    const auto [end, images] = flow.push_forward(problem.ladder.point, V);
    for (Index j = 0; j < V.cols(); ++j)
      for (const double size : {0.04, 0.02}) {
        const VectorXd measured = problem.by_differences(flow, V.col(j), size);
        BOOST_TEST(
            (measured - images.col(j)).norm() < 1e-9 * (1.0 + images.col(j).norm()),
            "order " << order << ", direction " << j << ": " << (measured - images.col(j)).norm());
      }
    // d(|x|² - l²) = 0 and its velocity, at the end.
    const VectorXd& x = end.x;
    const VectorXd position =
        2.0 * (x[0] * images.row(0) + x[1] * images.row(1) - x[4] * images.row(4)).transpose();
    BOOST_TEST(position.norm() < 1e-11);
    BOOST_TEST(images.row(4).norm() > 0.1);
  }
}

// Of Method 2 by a mass that all of the kinetic energy has in common, at each of many steps: now and then an entry that
// stands for 0 is a little more than noise, and the scales of its row and column are round-off.
BOOST_AUTO_TEST_CASE(derivatives_by_a_common_mass_are_right_at_every_step) {
  const ParameterExtension with(pendulum_with_momenta(), {{"m", kMass}});
  const auto point = [](double angle, double speed, double m) {
    return vector({kLength * std::sin(angle), -kLength * std::cos(angle),
                   m * speed * std::cos(angle), m * speed * std::sin(angle), m});
  };
  State start{.x = point(0.4, 0.6, kMass).head(4)};
  const ConstraintLadder ladder = extended_ladder(with, start);
  const ConstrainFirst method(
      with.extended(), ladder, std::make_shared<Theta>(with.extended()->manifold(), 0.5),
      std::make_shared<ParameterProjector>(std::make_shared<OrthogonalProjector>(), with),
      ConstrainFirst::Options{Backend::interpreter});
  const auto differential = method.differential();
  const double h = 0.05;
  const auto stepper = method.stepper();
  State state = ladder.point;
  stepper->prepare(state, h);
  for (int k = 0; k < 200; ++k) {
    const VectorXd x = state.x;
    const double angle = std::atan2(x[0], -x[1]),
                 speed = (x[2] * std::cos(angle) + x[3] * std::sin(angle)) / x[4];
    const State before = state;
    stepper->step(state, h);
    const MatrixXd by_mass = (point(angle, speed, 1.0) - point(angle, speed, 0.0));
    const VectorXd image = (*differential)(stepper->last(), by_mass);
    for (const double size : {0.02, 0.01}) {
      constexpr std::array weights = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
      VectorXd measured = VectorXd::Zero(5);
      for (std::size_t i = 0; i < weights.size(); ++i) {
        const double s = static_cast<double>(i + 1) * size;
        const auto end = [&](double along) {
          State from = before;
          from.x = point(angle, speed, x[4] + along);
          const auto alone = method.stepper();
          alone->prepare(from, h);
          alone->step(from, h);
          return from.x;
        };
        measured += weights[i] / size * (end(s) - end(-s));
      }
      BOOST_TEST((measured - image).norm() < 1e-10,
                 "step " << k << ": " << (measured - image).norm());
    }
  }
}

// ⟨λ, TΦ V⟩ = ⟨TΦ* λ, V⟩ of every method, on every space.
BOOST_AUTO_TEST_CASE(the_adjoint_is_that_of_the_tangent_map) {
  int found = 0;
  for (const auto& [name, integrator, setting, both_ways] : methods()) {
    const Manifold& M = *setting.system->manifold();
    if (M.dimension() == 0 || !integrator->differential()) continue;
    const DiscreteFlow flow(integrator, setting.step, 7);
    const MatrixXd V = consistent_directions(M, setting.conormals, setting.initial.x);
    const auto [end, images] = flow.push_forward(setting.initial, V);
    const Index size = setting.initial.x.size();
    const auto [same, covectors] =
        flow.pull_back(setting.initial, [&](long j, const State&) -> MatrixXd {
          return j == 7 ? MatrixXd::Identity(size, size) : MatrixXd();
        });
    const MatrixXd one = images, other = covectors.transpose() * V;
    BOOST_TEST((one - other).norm() < 1e-10 * (1.0 + one.norm()),
               name << ": " << (one - other).norm());
    BOOST_TEST((end.x - same.x).norm() < 1e-11 * (1.0 + end.x.norm()), name);
    ++found;
  }
  BOOST_TEST(found > 20);
}

// Σ_j q_j² by q₀: twice Σ_j q_j ∂q_j/∂q₀, for numbers of steps around squares.
BOOST_AUTO_TEST_CASE(slopes_at_all_steps_come_into_a_gradient) {
  const double k = 2.3, h = 0.1, q = 0.8, theta = 2.0 * std::atan(0.5 * std::sqrt(k) * h);
  for (const long n : {0L, 1L, 2L, 24L, 25L, 26L}) {
    const DiscreteFlow flow(midpoint(quadratic(k)), h, n);
    const auto gradient = flow.pull_back({.x = vector({q, 0})}, [](long, const State& at) {
      return MatrixXd(vector({2.0 * at.x[0], 0.0}));
    });
    double expected = 0.0;
    for (long j = 0; j <= n; ++j) {
      const double c = std::cos(static_cast<double>(j) * theta);
      expected += 2.0 * q * c * c;
    }
    BOOST_TEST(std::abs(gradient.covectors(0, 0) - expected) < 1e-12 * expected, n);
  }
}

// Of H = (p² - ω² q²)/2 the midpoint rule stretches by (1 ± hω/2)/(1 ∓ hω/2) a step.
BOOST_AUTO_TEST_CASE(exponents_of_a_saddle_are_the_logarithms_of_its_factors) {
  const double w = 1.7, h = 0.1;
  const DiscreteFlow flow(midpoint(quadratic(-w * w)), h, 400);
  const double exact = std::log((1.0 + 0.5 * h * w) / (1.0 - 0.5 * h * w)) / h;
  for (const long every : {1L, 7L}) {
    const VectorXd found =
        flow.lyapunov_exponents({.x = vector({1e-3, -1.7e-3})}, MatrixXd::Identity(2, 2), every);
    // The first direction turns to the one that grows: that costs a number over the time.
    BOOST_TEST(std::abs(found[0] - exact) < 1.0 / 40.0);
    BOOST_TEST(std::abs(found.sum()) < 1e-13);
    BOOST_TEST(found[0] > found[1]);
  }
  // Along the direction that grows from the start the exponent is exact.
  MatrixXd growing(2, 1);
  growing << 1.0, w;
  const VectorXd alone = flow.lyapunov_exponents({.x = vector({0, 0})}, growing);
  BOOST_TEST(std::abs(alone[0] - exact) < 1e-13);
  BOOST_CHECK_THROW(flow.lyapunov_exponents({.x = vector({0, 0})}, growing, 0),
                    std::invalid_argument);
}

// With tan(θ/2) = ωh/2 and θ = 2π/n the orbit closes after n steps, as every other one does.
BOOST_AUTO_TEST_CASE(multipliers_are_those_of_an_orbit_that_closes) {
  const double w = 1.7;
  const long n = 12;
  const double h = 2.0 * std::tan(std::numbers::pi / static_cast<double>(n)) / w;
  const State start{.x = vector({0.5, 0.2})};
  const auto closed =
      DiscreteFlow(midpoint(quadratic(w * w)), h, n).multipliers(start, MatrixXd::Identity(2, 2));
  for (const auto& multiplier : closed) BOOST_TEST(std::abs(multiplier - 1.0) < 1e-7);
  BOOST_CHECK_THROW(DiscreteFlow(midpoint(quadratic(w * w)), h, n - 1)
                        .multipliers(start, MatrixXd::Identity(2, 2)),
                    std::domain_error);
  // At the equilibrium any number of steps is an orbit: e^{±inθ}.
  const auto rotation = DiscreteFlow(midpoint(quadratic(w * w)), h, 2)
                            .multipliers({.x = vector({0, 0})}, MatrixXd::Identity(2, 2));
  BOOST_TEST(std::abs(std::abs(rotation[0].imag()) - std::sin(4.0 * std::numbers::pi / 12.0)) <
             1e-13);
}

BOOST_AUTO_TEST_CASE(what_makes_no_flow_is_refused) {
  BOOST_CHECK_THROW(DiscreteFlow(nullptr, 0.1, 1), std::invalid_argument);
  BOOST_CHECK_THROW(DiscreteFlow(midpoint(quadratic(1)), 0.0, 1), std::invalid_argument);
  BOOST_CHECK_THROW(DiscreteFlow(midpoint(quadratic(1)), 0.1, -1), std::invalid_argument);
  const DiscreteFlow flow(midpoint(quadratic(1)), 0.1, 1);
  BOOST_CHECK_THROW(flow.push_forward({.x = vector({1, 0})}, MatrixXd::Identity(3, 3)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
