#include "courant/integrators/methods/constrain_first.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/integrators/maps/spherical_midpoint.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/manifolds/tangent_bundle.hpp"
#include "courant/tests/integrators/example_systems.hpp"
#include "courant/tests/integrators/vortices.hpp"

// Mistakes that these cases have to notice:
//  * unknowns that no equation contains are those of an older step
//    (integrators/step/step_solver.hpp)
//  * a projection may end anywhere on M_f (integrators/methods/constrain_first_projection.cpp)
//  * what the projection leaves open is extrapolated
//    (integrators/methods/constrain_first_projection.cpp)
//  * what a step leaves open is extrapolated
BOOST_AUTO_TEST_SUITE(constrain_first)

using namespace courant;
using namespace courant::vortices;
using examples::FormulaSystem;

namespace {

// dα as the matrix ∂α_j/∂q_i - ∂α_i/∂q_j.
MatrixXd exterior_derivative(const OneForm& alpha, const VectorXd& q) {
  Graph graph;
  const ExprVector at = graph.variables("q", q.size());
  const ExprVector rows = jacobian(alpha(at), at).dense().reshaped();
  const VectorXd entries = values(substitute(rows, at, constants(q)));
  const MatrixXd d = Eigen::Map<const MatrixXd>(entries.data(), q.size(), q.size());
  return d.transpose() - d;
}

// ‖Φ*dα - dα‖_∞ of one step on M_f ≅ Q.
double preservation_defect(const Degenerate& problem, const VectorXd& q0, double h,
                           double theta = 0.5) {
  const std::shared_ptr<const Integrator> method =
      problem.method_2(q0, std::make_shared<MomentumProjector>(problem.phase_space), theta);
  const Index n = q0.size();
  const auto map = [&](const VectorXd& q) {
    return VectorXd(one_step(*method, problem.over(q), h).head(n));
  };
  const MatrixXd D = derivative(map, q0);
  return (D.transpose() * exterior_derivative(problem.form, map(q0)) * D -
          exterior_derivative(problem.form, q0))
      .lpNorm<Eigen::Infinity>();
}

// Cartesian pendulum: unit mass on a rod of length ℓ, gravity g, with the multiplier as z.
// Coordinates (x, y, v_x, v_y).
constexpr double kLength = 1.5, kGravity = 0.8;

std::shared_ptr<const ImplicitSystem> cartesian_pendulum() {
  return std::make_shared<FormulaSystem>(
      std::make_shared<Euclidean>(4), 1, 5,
      [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        return examples::equations({v[0] - x[2], v[1] - x[3], v[2] - z[0] * x[0],
                                    v[3] - z[0] * x[1] + kGravity,
                                    square(x[0]) + square(x[1]) - kLength * kLength});
      });
}

// ż = y ẋ on T*R³ with V = (x² + y²)/2.
std::shared_ptr<const ImplicitSystem> nonholonomic_particle(
    std::shared_ptr<const CotangentBundle> phase_space) {
  return std::make_shared<FormulaSystem>(
      phase_space, 1, 7,
      [](const ExprVector& x, const ExprVector& v, const ExprVector& z, const Expr&) {
        return examples::equations({v[0] - x[3], v[1] - x[4], v[2] - x[5],
                                    v[3] + x[0] + z[0] * x[1], v[4] + x[1], v[5] - z[0],
                                    x[5] - x[1] * x[3]});
      });
}

// ẋ = A x + z Π(x)∇g on S³ with a skew A and g(x) = x₀² + 2 x₁² - 0.7 = 0.
class RollOnSphere final : public ImplicitSystem {
 public:
  RollOnSphere() : ImplicitSystem(std::make_shared<Sphere>(3), 1, 5, {}) {}
  Index tangent_blocks() const override { return 1; }

 private:
  ExprVector do_residual(const ExprVector& x, const ExprVector& v, const ExprVector& z,
                         const Expr&) const override {
    const ExprVector turning = examples::equations(
        {x[2] + 0.3 * x[1], 0.7 * x[3] - 0.3 * x[0], -x[0] + 0.2 * x[3], -0.7 * x[1] - 0.2 * x[2]});
    const ExprVector gradient = examples::equations({2.0 * x[0], 4.0 * x[1], 0.0, 0.0});
    ExprVector F(5);
    F << v - turning - z[0] * (manifold()->tangent_projector(x) * gradient).eval(),
        square(x[0]) + 2.0 * square(x[1]) - 0.7;
    return F;
  }
};

VectorXd pendulum_point(double angle, double rate) {
  return (VectorXd(4) << kLength * std::sin(angle), -kLength * std::cos(angle),
          kLength * rate * std::cos(angle), kLength * rate * std::sin(angle))
      .finished();
}

}  // namespace

BOOST_AUTO_TEST_CASE(equation_15_is_the_step_on_q) {
  const Degenerate vortices = lagrangian_form();
  const auto regular = regular_form();
  const DiscretizeFirst midpoint(regular, std::make_shared<Theta>(regular->manifold()));
  const auto method =
      vortices.method_2(positions(), std::make_shared<MomentumProjector>(vortices.phase_space));
  const VectorXd a = midpoint.advance({.x = positions()}, 1.0, 50).x;
  const VectorXd b = method->advance({.x = vortices.over(positions())}, 1.0, 50).x;
  BOOST_TEST((a - b.head(8)).lpNorm<Eigen::Infinity>() < 1e-12);
  BOOST_TEST((b - vortices.over(b.head(8))).lpNorm<Eigen::Infinity>() < 1e-14);
}

BOOST_AUTO_TEST_CASE(proposition_6_3_linear_alpha_is_preserved) {
  BOOST_TEST(preservation_defect(lagrangian_form(), positions(), 1.0) < 1e-10);
}

BOOST_AUTO_TEST_CASE(proposition_6_3_nonlinear_alpha_is_not) {
  // dα = (1 + q₁²) dq₁ ∧ dq₂ is not constant: the defect is there, and of third order in h.
  const Degenerate problem(
      2,
      [](const ExprVector& q) {
        return examples::equations({0.0, q[0] + q[0] * square(q[0]) / 3.0});
      },
      [](const ExprVector& q) {
        return 0.5 * square(q[0]) + 0.5 * square(q[1]) + 0.2 * q[0] * square(q[1]);
      });
  const VectorXd q0 = (VectorXd(2) << 0.7, 0.4).finished();
  const double coarse = preservation_defect(problem, q0, 0.2);
  const double fine = preservation_defect(problem, q0, 0.1);
  BOOST_TEST(coarse > 1e-5);
  BOOST_TEST(std::log2(coarse / fine) == 3.0, boost::test_tools::tolerance(0.1));
}

// Linear up to a differential is enough: (14) contains α through dα alone.
BOOST_AUTO_TEST_CASE(proposition_6_3_an_exact_part_of_alpha_changes_nothing) {
  // φ = Σ q_i³/30 + q_0 q_5²/10
  const Degenerate linear = lagrangian_form();
  const Degenerate curved(
      8,
      [](const ExprVector& q) {
        ExprVector result = alpha(q) + Expr(0.1) * q.cwiseProduct(q);
        result[0] += 0.1 * square(q[5]);
        result[5] += 0.2 * q[0] * q[5];
        return result;
      },
      hamiltonian);
  const auto end = [](const Degenerate& problem) {
    const auto method =
        problem.method_2(positions(), std::make_shared<MomentumProjector>(problem.phase_space));
    return one_step(*method, problem.over(positions()), 1.0);
  };
  const VectorXd a = end(linear), b = end(curved);
  BOOST_TEST((a - b).head(8).norm() < 1e-13);
  BOOST_TEST((a - b).tail(8).norm() > 0.1);  // while p = α(q) differs
  BOOST_TEST(preservation_defect(curved, positions(), 1.0) < 1e-10);
}

BOOST_AUTO_TEST_CASE(remark_6_4_theta_other_than_one_half_breaks_it) {
  BOOST_TEST(preservation_defect(lagrangian_form(), positions(), 1.0, 0.4) > 1e-4);
}

BOOST_AUTO_TEST_CASE(proposition_7_3_pendulum_keeps_both_constraints_at_order_two) {
  const auto system = cartesian_pendulum();
  const VectorXd x0 = pendulum_point(1.0, 0.3);
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = x0});
  const ConstrainFirst method(system, ladder, std::make_shared<Theta>(system->manifold()),
                              std::make_shared<OrthogonalProjector>());
  // The same motion in the angle: φ̈ = -(g/ℓ) sin φ, by classical Runge–Kutta at a step where its
  // error is below 10⁻¹².
  Eigen::Vector2d angle(1.0, 0.3);
  const auto f = [](const Eigen::Vector2d& a) {
    return Eigen::Vector2d(a[1], -kGravity / kLength * std::sin(a[0]));
  };
  for (int k = 0; k < 4000; ++k) {
    const double h = 2.0 / 4000;
    const Eigen::Vector2d a = f(angle), b = f(angle + 0.5 * h * a), c = f(angle + 0.5 * h * b),
                          d = f(angle + h * c);
    angle += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  const VectorXd reference = pendulum_point(angle[0], angle[1]);
  std::vector<double> errors;
  double violation = 0.0;
  for (const double h : {0.08, 0.04, 0.02, 0.01}) {
    const auto stepper = method.stepper();
    State state{.x = x0};
    for (long k = 0; k < std::lround(2.0 / h); ++k) {
      stepper->step(state, h);
      const VectorXd& x = state.x;
      violation = std::max({violation, std::abs(x.head(2).squaredNorm() - kLength * kLength),
                            std::abs(x.head(2).dot(x.tail(2)))});
    }
    errors.push_back((state.x - reference).norm());
  }
  BOOST_TEST(violation < 3e-15);
  for (std::size_t i = 1; i < errors.size(); ++i)
    BOOST_TEST(std::log2(errors[i - 1] / errors[i]) == 2.0, boost::test_tools::tolerance(0.075));
}

BOOST_AUTO_TEST_CASE(equations_39_to_43_nonholonomic_particle) {
  // μ = (-y, 0, 1), eq. (34)-(35); M_0: p_z - y p_x = 0.
  // Momentum projector 𝒫 of Section 8.2.
  const auto base = std::make_shared<Euclidean>(3);
  const auto phase_space = std::make_shared<CotangentBundle>(base);
  const auto system = nonholonomic_particle(phase_space);
  const VectorXd x0 = (VectorXd(6) << 0.5, 0.8, 0.0, 0.6, -0.3, 0.48).finished();
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = x0});
  const ConstrainFirst method(
      system, ladder, std::make_shared<CotangentLift>(phase_space, std::make_shared<Theta>(base)),
      std::make_shared<MomentumProjector>(phase_space));
  // (39)-(43) solved by hand for one step: unknown (q, p) at the middle, fixed-point iteration.
  const double h = 0.1;
  const auto force = [](const VectorXd& q, const VectorXd& p) {
    // λ from d/dt(p_z - y p_x) = 0: (1 + y²) λ = ẏ p_x - y x.
    const double lambda = (p[1] * p[0] - q[1] * q[0]) / (1.0 + q[1] * q[1]);
    return VectorXd((VectorXd(3) << -q[0] - lambda * q[1], -q[1], lambda).finished());
  };
  const auto project = [](const VectorXd& q, VectorXd p) {
    const double c = (p[2] - q[1] * p[0]) / (1.0 + q[1] * q[1]);
    p[0] += c * q[1];
    p[2] -= c;
    return p;
  };
  const VectorXd q0 = x0.head(3), p0 = x0.tail(3);
  VectorXd q = q0, p = p0;
  double c = 0.0;  // p₀ + c μ(q₀) is what P takes to p₀
  for (int k = 0; k < 200; ++k) {
    const VectorXd mu = (VectorXd(3) << -q0[1], 0.0, 1.0).finished();
    q = q0 + 0.5 * h * p;
    VectorXd free = p0 + 0.5 * h * force(q, p);
    // c so that the middle point is on M_0, equation (41).
    c = -(free[2] - q[1] * free[0]) / (mu[2] - q[1] * mu[0]);
    p = free + c * mu;
  }
  const VectorXd q1 = q + 0.5 * h * p;
  VectorXd expected(6);
  expected << q1, project(q1, p + 0.5 * h * force(q, p));
  BOOST_TEST((one_step(method, x0, h) - expected).lpNorm<Eigen::Infinity>() < 1e-13);

  const auto stepper = method.stepper();
  State state{.x = x0};
  double violation = 0.0;
  for (int k = 0; k < 1000; ++k) {
    stepper->step(state, h);
    const VectorXd& x = state.x;
    violation = std::max(violation, std::abs(x[5] - x[1] * x[3]));
  }
  BOOST_TEST(violation < 1e-14);
}

// The step and the projection are both begun from an extrapolation of the last ones: few
// iterations, and the same result as without a past.
BOOST_AUTO_TEST_CASE(few_iterations_to_the_result_of_a_fresh_start) {
  const auto pendulum = cartesian_pendulum();
  const auto base = std::make_shared<Euclidean>(3);
  const auto phase_space = std::make_shared<CotangentBundle>(base);
  const auto particle = nonholonomic_particle(phase_space);
  const auto on_sphere = std::make_shared<RollOnSphere>();
  const struct {
    std::shared_ptr<const ImplicitSystem> system;
    VectorXd x;
    std::shared_ptr<const DiscretizationMap> map;
    std::shared_ptr<const Projector> projector;
  } cases[] = {
      {pendulum, pendulum_point(1.0, 0.3), std::make_shared<Theta>(pendulum->manifold()),
       std::make_shared<OrthogonalProjector>()},
      {particle, (VectorXd(6) << 0.5, 0.8, 0.0, 0.6, -0.3, 0.48).finished(),
       std::make_shared<CotangentLift>(phase_space, std::make_shared<Theta>(base)),
       std::make_shared<MomentumProjector>(phase_space)},
      {on_sphere,
       (VectorXd(4) << std::sqrt(0.3), std::sqrt(0.2), std::sqrt(0.4), -std::sqrt(0.1)).finished(),
       std::make_shared<SphericalMidpoint>(
           std::dynamic_pointer_cast<const Sphere>(on_sphere->manifold())),
       std::make_shared<OrthogonalProjector>()},
  };
  const double h = 0.01;
  for (const auto& [system, x, map, projector] : cases) {
    const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = x});
    const ConstrainFirst method(system, ladder, map, projector);
    const auto stepper = method.stepper();
    State state{.x = ladder.point.x};
    for (int k = 0; k < 100; ++k) stepper->step(state, h);
    const long before = stepper->statistics().iterations;
    for (int k = 0; k < 1000; ++k) stepper->step(state, h);
    BOOST_TEST(static_cast<double>(stepper->statistics().iterations - before) / 1000 < 12.0,
               system->manifold()->name());
    BOOST_TEST(stepper->statistics().failures == 0);
    // Of 2,000 steps on the sphere two in a thousand differ by more than 3e-15, the most by 7e-15.
    int farther = 0;
    for (int k = 0; k < 100; ++k) {
      const State a = method.advance(state, h);
      stepper->step(state, h);
      const State& b = state;
      const double apart = (a.x - b.x).lpNorm<Eigen::Infinity>() / b.x.lpNorm<Eigen::Infinity>();
      if (apart >= 3e-15) ++farther;
      BOOST_TEST(apart < 1e-14);
      BOOST_TEST((a.z - b.z).lpNorm<Eigen::Infinity>() < 1e-12 * (1.0 + b.z.norm()));
    }
    BOOST_TEST(farther <= 1, system->manifold()->name());
  }
}

// A spherical pendulum in a field as six equations on TS². Now and then an old factorisation leads the
// projection to other solutions, whose velocities may be a hundred times larger.
BOOST_AUTO_TEST_CASE(projections_end_nearby) {
  const auto bundle = std::make_shared<TangentBundle>(std::make_shared<Sphere>(2));
  const auto system = std::make_shared<FormulaSystem>(
      bundle, 0, 6,
      [bundle](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        const ExprVector q = x.head(3), w = x.tail(3), rate = bundle->frame(x) * v;
        const ExprVector gradient = examples::equations({q[1], q[0], Expr(1.0)});
        const Expr force = w.dot(w) - q.dot(gradient);
        return joined(rate.head(3) - w, rate.tail(3) + gradient + force * q);
      });
  const auto energy = [](const VectorXd& x) {
    return 0.5 * x.tail(3).squaredNorm() + x[0] * x[1] + x[2];
  };
  State state{.x = VectorXd(6)};
  state.x << 0.6, 0.0, 0.8, 0.4, 0.7, -0.3;
  state.x.tail(3) -= state.x.tail(3).dot(state.x.head(3)) * state.x.head(3);
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = state.x});
  const ConstrainFirst method(system, ladder, std::make_shared<Theta>(bundle),
                              std::make_shared<OrthogonalProjector>());
  const auto stepper = method.stepper();
  const double before = energy(state.x);
  for (int k = 0; k < 3000; ++k) {
    stepper->step(state, 0.25);
    BOOST_REQUIRE(std::abs(energy(state.x) - before) < 0.1);
  }
  BOOST_TEST(stepper->statistics().failures > 0);
}

// The model of Christ and Lee with V = (r² - 1)²/4 + r²/2: in every frame r'' = -r³, so that from rest
// r = r₀ cn(r₀ t; ½). With r₀² = 1.04 that is 0.400408 at t = 6.
BOOST_AUTO_TEST_CASE(gauge_variables_stay_with_the_state) {
  const auto phase_space = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(3));
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(phase_space),
      std::make_shared<Lagrangian>(
          phase_space, [](const ExprVector& q, const ExprVector& w, const Expr&) {
            const Expr r2 = square(q[0]) + square(q[1]);
            return 0.5 * (square(w[0] + q[2] * q[1]) + square(w[1] - q[2] * q[0])) -
                   0.25 * square(r2 - 1.0) - 0.5 * r2;
          }));
  const auto map =
      std::make_shared<CotangentLift>(phase_space, std::make_shared<Theta>(phase_space->base()));
  for (const double turning : {0.0, 0.3, 2.0}) BOOST_TEST_CONTEXT("z = " << turning) {
      VectorXd x = VectorXd::Zero(6);
      x.head(3) << 1.0, 0.2, turning;
      const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = x});
      BOOST_TEST_REQUIRE(to_string(ladder.verdict) == "gauge");
      const ConstrainFirst method(system, ladder, map, std::make_shared<OrthogonalProjector>());
      const auto stepper = method.stepper();
      State state = ladder.point;
      for (int k = 0; k < 600; ++k) stepper->step(state, 0.01);
      BOOST_TEST(std::abs(state.x.head(2).norm() - 0.400408) < 2e-3);
      BOOST_TEST(std::abs(state.x[0] * state.x[4] - state.x[1] * state.x[3]) < 1e-13);
      // Of two attempts in a step most would be lost.
      BOOST_TEST(stepper->statistics().failures <= 6);
    }
}

BOOST_AUTO_TEST_CASE(momentum_projector_refuses_position_constraints) {
  // A holonomic constraint cannot be met by moving momenta.
  const auto phase_space = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(phase_space),
      std::make_shared<Lagrangian>(phase_space,
                                   [](const ExprVector& q, const ExprVector& w, const Expr&) {
                                     return 0.5 * square(w[0]) + q[1] * (q[0] - 1.0);
                                   }));
  const ConstraintLadder ladder = ConstraintAlgorithm().run(system, {.x = VectorXd::Unit(4, 0)});
  BOOST_TEST_REQUIRE(to_string(ladder.verdict) == "regular");
  const auto map =
      std::make_shared<CotangentLift>(phase_space, std::make_shared<Theta>(phase_space->base()));
  const ConstrainFirst method(system, ladder, map,
                              std::make_shared<MomentumProjector>(phase_space));
  BOOST_CHECK_THROW(method.advance({.x = ladder.point.x}, 0.1), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
