// Section 8 on a system with two constraints and a metric that isn't constant: H = gⁱʲ p_i p_j/2 +
// V on T*R⁴, every derivative by hand.
#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/integrators/certificate/constraint_algorithm.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/integrators/methods/constrain_first.hpp"
#include "courant/integrators/methods/discretize_first.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/closed_port_hamiltonian.hpp"
#include "courant/structures/dirac_system.hpp"
#include "varying_metric.hpp"

BOOST_AUTO_TEST_SUITE(nonholonomic)

using namespace courant;
using Eigen::Matrix2d;
using namespace varying_metric;

namespace {

ExprMatrix metric(const ExprVector& q) {
  ExprMatrix g = ExprMatrix::Zero(4, 4);
  g(0, 0) = 1.0;
  g(1, 1) = 1.0 + square(q[0]);
  g(2, 2) = 1.0 / 0.7;
  g(3, 3) = 1.0 / 1.2;
  return g;
}
// λ_b of Section 8.2, with ∂(μ_i^a gⁱʲ)/∂q^k p_j q̇^k by hand.
Vector2d multipliers(const Vector4d& q, const Vector4d& p) {
  const double s = 1.0 + q[0] * q[0];
  const Matrix4d G = inverse_metric(q);
  const Vector4d velocity = G * p;
  const Vector2d along(-velocity[1] * p[0], -p[1] * velocity[0] * (1.0 - q[0] * q[0]) / (s * s));
  const Matrix2d C = mu(q).transpose() * G * mu(q);
  return C.inverse() * (mu(q).transpose() * G * dH_dq(q, p) - along);
}
// 𝒫(α) = α - C_ab (gⁱʲ α_j μ_i^a) μ^b
Vector4d projected_momentum(const Vector4d& q, const Vector4d& p) {
  const Matrix2d C = mu(q).transpose() * inverse_metric(q) * mu(q);
  return p - mu(q) * C.inverse() * constraints(q, p);
}

struct Nonholonomic {
  Nonholonomic()
      : base(std::make_shared<Euclidean>(4)),
        phase_space(std::make_shared<CotangentBundle>(base)),
        lift(std::make_shared<CotangentLift>(phase_space, std::make_shared<Theta>(base))) {
    // Equations (34), (35).
    const auto structure = std::make_shared<ClosedPortHamiltonian>(
        phase_space,
        [](const ExprVector&) {
          ExprMatrix J = ExprMatrix::Zero(8, 8);
          for (Index i = 0; i < 4; ++i) J(i, 4 + i) = 1.0, J(4 + i, i) = -1.0;
          return J;
        },
        2,
        [](const ExprVector& x) {
          ExprMatrix B = ExprMatrix::Zero(8, 2);
          B(4, 0) = -x[1];
          B(6, 0) = 1.0;
          B(5, 1) = -x[0];
          B(7, 1) = 1.0;
          return B;
        });
    system = std::make_shared<DiracSystem>(
        structure, std::make_shared<Hamiltonian>(phase_space, [](const ExprVector& x, const Expr&) {
          return 0.5 * (square(x[4]) + square(x[5]) / (1.0 + square(x[0])) + 0.7 * square(x[6]) +
                        1.2 * square(x[7])) +
                 potential(x);
        }));
  }
  static Expr potential(const ExprVector& q) {
    return 0.5 * (square(q[0]) + square(q[1]) + square(q[2]) + square(q[3])) + 0.3 * q[0] * q[1];
  }

  std::shared_ptr<const Euclidean> base;
  std::shared_ptr<const CotangentBundle> phase_space;
  std::shared_ptr<const DiscretizationMap> lift;
  std::shared_ptr<const DiracSystem> system;
};

VectorXd start() {
  const Vector4d q(0.5, 0.8, -0.3, 0.6);
  VectorXd x(8);
  x << q, projected_momentum(q, Vector4d(0.9, -0.7, 0.4, 0.5));
  return x;
}

VectorXd one_step(const Integrator& method, double h) {
  return method.advance({.x = start()}, h).x;
}

VectorXd stacked(const Vector4d& a, const Vector4d& b) {
  VectorXd result(8);
  result << a, b;
  return result;
}

}  // namespace

// L = K_g - V has the motion of H.
BOOST_AUTO_TEST_CASE(equation_33) {
  const Nonholonomic problem;
  const DiracSystem lagrangian(
      std::make_shared<CanonicalSymplectic>(problem.phase_space),
      std::make_shared<Lagrangian>(
          problem.phase_space, [](const ExprVector& q, const ExprVector& w, const Expr&) {
            return 0.5 * (square(w[0]) + square(w[1]) * (1.0 + square(q[0])) + square(w[2]) / 0.7 +
                          square(w[3]) / 1.2) -
                   Nonholonomic::potential(q);
          }));
  const Vector4d q(0.5, 0.8, -0.3, 0.6), p(0.9, -0.7, 0.4, 0.5);
  const Vector4d velocity = inverse_metric(q) * p;
  const VectorXd x = stacked(q, p);
  BOOST_TEST(lagrangian.residual(x, stacked(velocity, -dH_dq(q, p)), velocity, 0.0).norm() < 1e-14);
  BOOST_TEST(lagrangian.residual(x, stacked(velocity, dH_dq(q, p)), velocity, 0.0).norm() > 0.1);
}

BOOST_AUTO_TEST_CASE(equations_34_and_35) {
  const Nonholonomic problem;
  const Vector4d q(0.5, 0.8, -0.3, 0.6), p(0.9, -0.7, 0.4, 0.5);  // not on M_0
  const Vector2d lambda(0.4, -1.3);
  const VectorXd v = stacked(inverse_metric(q) * p, mu(q) * lambda - dH_dq(q, p));
  const VectorXd r = problem.system->residual(stacked(q, p), v, lambda, 0.0);
  BOOST_TEST(r.size() == 10);
  BOOST_TEST(r.head(8).norm() < 1e-14);
  BOOST_TEST((r.tail(2) - constraints(q, p)).norm() < 1e-14);
  BOOST_TEST(constraints(q, p).norm() > 0.1);
}

BOOST_AUTO_TEST_CASE(the_ladder_finds_the_multipliers_of_section_8_2) {
  const Nonholonomic problem;
  const ConstraintLadder ladder = ConstraintAlgorithm().run(problem.system, {.x = start()});
  const VectorXd& x = ladder.point.x;
  const Vector2d lambda = multipliers(x.head(4), x.tail(4));
  BOOST_TEST((Vector2d(ladder.point.z) - lambda).norm() < 1e-12);
  BOOST_TEST(lambda.cwiseAbs().minCoeff() > 1e-2);
}

BOOST_AUTO_TEST_CASE(equations_36_to_38) {
  const Nonholonomic problem;
  const DiscretizeFirst method(problem.system, problem.lift);
  const double h = 0.1;
  const VectorXd x0 = start(), x1 = one_step(method, h), middle = 0.5 * (x0 + x1);
  const Vector4d q = middle.head(4), p = middle.tail(4);
  BOOST_TEST(((x1 - x0).head(4) / h - inverse_metric(q) * p).norm() < 1e-13);
  // (37) holds with some λ.
  const Vector4d reaction = (x1 - x0).tail(4) / h + dH_dq(q, p);
  const Vector2d lambda = QrDecomposition::in_order(mu(q)).solve(reaction);
  BOOST_TEST((reaction - mu(q) * lambda).norm() < 1e-13);
  BOOST_TEST(lambda.cwiseAbs().minCoeff() > 1e-2);
  BOOST_TEST(constraints(q, p).norm() < 1e-14);
  // In the middle, not at the end: that is what Method 2 is for.
  BOOST_TEST(constraints(x1.head(4), x1.tail(4)).norm() > 1e-5);
}

// λ_a μ^a in (40) and (43) is a sum over a.
BOOST_AUTO_TEST_CASE(equations_39_to_43) {
  const Nonholonomic problem;
  const ConstrainFirst method(
      problem.system, ConstraintAlgorithm().run(problem.system, {.x = start()}), problem.lift,
      std::make_shared<MomentumProjector>(problem.phase_space, metric));
  const double h = 0.1;
  const VectorXd x0 = start(), x1 = one_step(method, h);
  const Vector4d q0 = x0.head(4), p0 = x0.tail(4), q1 = x1.head(4), p1 = x1.tail(4);
  const Vector4d q = 0.5 * (q0 + q1);                              // (39) and (42)
  const Vector4d p = inverse_metric(q).inverse() * (q1 - q0) / h;  // their difference
  BOOST_TEST(constraints(q, p).norm() < 1e-13);                    // (41)
  const Vector2d lambda = multipliers(q, p);
  const auto defects = [&](const Vector4d& force) {
    return Vector2d((projected_momentum(q0, p - h / 2 * force) - p0).norm(),   // (40)
                    (projected_momentum(q1, p + h / 2 * force) - p1).norm());  // (43)
  };
  BOOST_TEST(defects(mu(q) * lambda - dH_dq(q, p)).norm() < 1e-13);
  // 𝒫 removes all of λ_a μ^a but what μ has turned by within half a step: one of them is missed all
  // the same.
  for (Index a = 0; a < 2; ++a)
    BOOST_TEST(defects(mu(q).col(a) * lambda[a] - dH_dq(q, p)).norm() > 1e-6);

  const auto stepper = method.stepper();
  State state{.x = x0};
  double violation = 0.0;
  for (int k = 0; k < 1000; ++k) {
    stepper->step(state, h);
    const VectorXd& x = state.x;
    violation = std::max(violation, constraints(x.head(4), x.tail(4)).norm());
  }
  BOOST_TEST(violation < 1e-13);
}

// The last display of Section 7.2: what d_TΦ adds to S_1 is said of the vector
// (x̄, v) = (R_d^{M_0})⁻¹(x_k, x_{k+1}) / h, so it is the inverse that pulls it back to M_0 × M_0:
//   Φ(x̄) = 0,   (d_TΦ)(x̄, v) = ⟨dΦ(x̄), v⟩ = 0.
// A step of Method 1 has the first of these alone.
BOOST_AUTO_TEST_CASE(section_7_2_the_tangent_lift_is_pulled_back_by_the_inverse) {
  const Nonholonomic problem;
  const double h = 0.1;
  const VectorXd x0 = start();
  // ⟨dΦ(x̄), (q̇, μ_a λ^a - ∂H/∂q)⟩ for a step to x1 with p̄ = g q̇. (40) and (43), linear in λ, give
  // λ: P0 and P1 are what the ends' momenta are taken through.
  const auto slope = [&](const VectorXd& x1, const auto& P0, const auto& P1) {
    const Vector4d q = 0.5 * (x0 + x1).head(4), velocity = (x1 - x0).head(4) / h;
    const Vector4d p = inverse_metric(q).inverse() * velocity;
    BOOST_TEST(constraints(q, p).norm() < 1e-13);
    const auto ends = [&](const Vector4d& force) {
      return stacked(P0(p - h / 2 * force) - x0.tail(4), P1(p + h / 2 * force) - x1.tail(4));
    };
    const VectorXd known = ends(-dH_dq(q, p));
    MatrixXd A(8, 2);
    for (Index a = 0; a < 2; ++a) A.col(a) = ends(mu(q).col(a) - dH_dq(q, p)) - known;
    const Vector2d lambda = QrDecomposition::in_order(A).solve(-known);
    BOOST_TEST((A * lambda + known).norm() < 1e-13);
    const Vector4d dq = 1e-5 * velocity, dp = 1e-5 * (mu(q) * lambda - dH_dq(q, p));
    return ((constraints(q + dq, p + dp) - constraints(q - dq, p - dp)) / 2e-5).norm();
  };
  const ConstrainFirst second(problem.system, ConstraintAlgorithm().run(problem.system, {.x = x0}),
                              problem.lift,
                              std::make_shared<MomentumProjector>(problem.phase_space, metric));
  const VectorXd x2 = one_step(second, h);
  BOOST_TEST(slope(
                 x2, [&](const Vector4d& p) { return projected_momentum(x0.head(4), p); },
                 [&](const Vector4d& p) { return projected_momentum(x2.head(4), p); }) < 1e-9);
  const auto as_it_is = [](const Vector4d& p) { return p; };
  const VectorXd x1 = one_step(DiscretizeFirst(problem.system, problem.lift), h);
  BOOST_TEST(slope(x1, as_it_is, as_it_is) > 1e-3);
}

BOOST_AUTO_TEST_SUITE_END()
