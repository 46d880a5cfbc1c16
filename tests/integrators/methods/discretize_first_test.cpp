#include "courant/integrators/methods/discretize_first.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../example_systems.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/tests/integrators/vortices.hpp"

// Mistakes that these cases have to notice:
//  * a step that did not converge is taken (integrators/step/step_solver.hpp)
BOOST_AUTO_TEST_SUITE(discretize_first)

using namespace courant;
using namespace courant::vortices;

namespace {

// ΔJ - J' over a symplectic matrix: ‖DᵀΩD - Ω‖_∞ with Ω = dq ∧ dp.
double symplecticity_defect(const MatrixXd& D) {
  const Index n = D.rows() / 2;
  MatrixXd Omega = MatrixXd::Zero(2 * n, 2 * n);
  Omega.topRightCorner(n, n).setIdentity();
  Omega.bottomLeftCorner(n, n) = -MatrixXd::Identity(n, n);
  return (D.transpose() * Omega * D - Omega).lpNorm<Eigen::Infinity>();
}

// f(z) of Section 6.1 as the real vector field of equation (6), by hand.
VectorXd velocity(const VectorXd& q) {
  VectorXd f = VectorXd::Zero(8);
  for (Index i = 0; i < 4; ++i) {
    for (Index j = 0; j < 4; ++j) {
      if (i == j) continue;
      const double dx = q[i] - q[j], dy = q[4 + i] - q[4 + j];
      const double c = kStrength[j] / (2.0 * std::numbers::pi * (dx * dx + dy * dy));
      f[i] -= c * dy;
      f[4 + i] += c * dx;
    }
  }
  return f;
}

}  // namespace

BOOST_AUTO_TEST_CASE(equation_12_of_the_regular_form_is_the_midpoint_rule) {
  const auto system = regular_form();
  const DiscretizeFirst method(system, std::make_shared<Theta>(system->manifold()));
  const VectorXd q0 = positions();
  const VectorXd q1 = one_step(method, q0, 1.0);
  BOOST_TEST((q1 - q0 - velocity(0.5 * (q0 + q1))).lpNorm<Eigen::Infinity>() < 1e-15);
}

// The midpoint integrator of a regular Lagrangian: (p₀ + p₁)/2 = ∂L/∂q̇ and p₁ - p₀ = h ∂L/∂q at
// ((q₀ + q₁)/2, (q₁ - q₀)/h), and not as printed.
BOOST_AUTO_TEST_CASE(section_5_1_1_the_midpoint_integrator_of_a_lagrangian) {
  // L = (1.3 u² + 0.6 w²)/2 + 0.4 x² w - cos(x) y
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(2));
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<Lagrangian>(M, [](const ExprVector& q, const ExprVector& w, const Expr&) {
        return 0.65 * square(w[0]) + 0.3 * square(w[1]) + 0.4 * square(q[0]) * w[1] -
               cos(q[0]) * q[1];
      }));
  const DiscretizeFirst method(
      system, std::make_shared<CotangentLift>(M, std::make_shared<Theta>(M->base())));
  const double h = 0.2;
  const VectorXd x0 = (VectorXd(4) << 0.7, -0.4, 1.1, 0.5).finished();
  const VectorXd x1 = one_step(method, x0, h);
  const Eigen::Vector2d q = 0.5 * (x0 + x1).head(2), w = (x1 - x0).head(2) / h;
  const Eigen::Vector2d dL_dw(1.3 * w[0], 0.6 * w[1] + 0.4 * q[0] * q[0]);
  const Eigen::Vector2d dL_dq(0.8 * q[0] * w[1] + std::sin(q[0]) * q[1], -std::cos(q[0]));
  BOOST_TEST((0.5 * (x0 + x1).tail(2) - dL_dw).norm() < 1e-14);
  BOOST_TEST(((x1 - x0).tail(2) - h * dL_dq).norm() < 1e-14);
  BOOST_TEST(((x1 - x0).head(2) - h * dL_dw).norm() > 1e-2);
  BOOST_TEST(((x1 - x0).tail(2) + h * dL_dq).norm() > 1e-2);
}

// The discrete equations by hand, at points of T*Q × T*Q: p₀ is any covector, and q₁ depends on it.
BOOST_AUTO_TEST_CASE(equation_12_is_in_the_cotangent_bundle) {
  const Degenerate vortices = lagrangian_form();
  const auto method = vortices.method_1();
  const double h = 0.5;
  const auto step = [&](double off) {
    VectorXd x0 = vortices.over(positions());
    x0.tail(8) += off * VectorXd::LinSpaced(8, -1.0, 1.0);
    const VectorXd x1 = one_step(*method, x0, h);
    const VectorXd q = 0.5 * (x0 + x1).head(8), w = (x1 - x0).head(8) / h;
    const VectorXd f = velocity(q);
    VectorXd alpha(8), force(8);  // force = ∂α_j/∂q q̇_j - ∂H/∂q, with ∂H/∂q from (6)
    for (Index j = 0; j < 4; ++j) {
      alpha[j] = -0.5 * kStrength[j] * q[4 + j];
      alpha[4 + j] = 0.5 * kStrength[j] * q[j];
      force[j] = kStrength[j] * (0.5 * w[4 + j] - f[4 + j]);
      force[4 + j] = -kStrength[j] * (0.5 * w[j] - f[j]);
    }
    BOOST_TEST((0.5 * (x0 + x1).tail(8) - alpha).lpNorm<Eigen::Infinity>() < 1e-14);
    BOOST_TEST(((x1 - x0).tail(8) - h * force).lpNorm<Eigen::Infinity>() < 1e-14);
    return x1;
  };
  BOOST_TEST((step(0.05) - step(0.0)).head(8).norm() > 1e-2);
}

BOOST_AUTO_TEST_CASE(equation_13_is_the_map_without_p) {
  // Two steps from any (q₀, p₀): q₂ - q₀ = h (f(q_{1/2}) + f(q_{3/2})), whatever p₀ is.
  const Degenerate vortices = lagrangian_form();
  const auto method = vortices.method_1();
  VectorXd x0 = vortices.over(positions());
  x0.tail(8) += 0.05 * VectorXd::LinSpaced(8, -1.0, 1.0);
  const State first = method->advance({.x = x0}, 1.0);
  const VectorXd q0 = x0.head(8), q1 = first.x.head(8);
  const VectorXd q2 = method->advance(first, 1.0).x.head(8);
  const VectorXd expected = q0 + velocity(0.5 * (q0 + q1)) + velocity(0.5 * (q1 + q2));
  BOOST_TEST((q2 - expected).lpNorm<Eigen::Infinity>() < 1e-13);
  // The control: a perturbed p₀ is not on M_0, so one step is not the midpoint rule.
  BOOST_TEST((q1 - q0 - velocity(0.5 * (q0 + q1))).lpNorm<Eigen::Infinity>() > 1e-3);
}

BOOST_AUTO_TEST_CASE(section_6_1_the_map_is_symplectic) {
  const Degenerate vortices = lagrangian_form();
  const VectorXd x0 = vortices.over(positions());
  const auto map = [&](double theta) {
    return [method = std::shared_ptr<const Integrator>(vortices.method_1(theta))](
               const VectorXd& x) { return one_step(*method, x, 1.0); };
  };
  BOOST_TEST(symplecticity_defect(derivative(map(0.5), x0)) < 1e-10);
}

BOOST_AUTO_TEST_CASE(order_is_two_on_a_pendulum_and_one_off_the_middle) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
  const auto system = std::make_shared<DiracSystem>(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<Hamiltonian>(M, [](const ExprVector& x, const Expr&) {
        return 0.5 * square(x[1]) / 1.3 - 0.7 * cos(x[0]);
      }));
  const VectorXd x0 = (VectorXd(2) << 1.0, 0.4).finished();
  const auto end = [&](double theta, double h) {
    const DiscretizeFirst method(
        system, std::make_shared<CotangentLift>(M, std::make_shared<Theta>(M->base(), theta)));
    return method.advance({.x = x0}, h, std::lround(2.0 / h)).x;
  };
  // An independent solution: classical Runge–Kutta at a step where its error is 10⁻¹³.
  VectorXd reference = x0;
  const auto f = [](const VectorXd& x) {
    return VectorXd((VectorXd(2) << x[1] / 1.3, -0.7 * std::sin(x[0])).finished());
  };
  for (int k = 0; k < 4000; ++k) {
    const double h = 2.0 / 4000;
    const VectorXd a = f(reference), b = f(reference + 0.5 * h * a), c = f(reference + 0.5 * h * b),
                   d = f(reference + h * c);
    reference += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  for (const auto& [theta, order] :
       {std::pair{0.5, 2.0}, std::pair{0.3, 1.0}, std::pair{1.0, 1.0}}) {
    std::vector<double> errors;
    for (const double h : {0.04, 0.02, 0.01, 0.005})
      errors.push_back((end(theta, h) - reference).norm());
    for (std::size_t i = 1; i < errors.size(); ++i)
      BOOST_TEST(std::log2(errors[i - 1] / errors[i]) == order,
                 boost::test_tools::tolerance(0.075));
  }
}

BOOST_AUTO_TEST_CASE(a_step_through_a_singular_point_fails_and_keeps_the_state) {
  const Degenerate vortices = lagrangian_form();
  VectorXd q = positions();
  q[1] = q[0];  // two vortices in one place
  const auto stepper = vortices.method_1()->stepper();
  State state{.x = vortices.over(q)};
  const State before = state;
  BOOST_CHECK_THROW(stepper->step(state, 1.0), SolveError);
  BOOST_TEST((state == before));
  BOOST_TEST(stepper->statistics().steps == 0);
}

BOOST_AUTO_TEST_CASE(wrong_arguments_are_refused) {
  const Degenerate vortices = lagrangian_form();
  const auto method = vortices.method_1();
  BOOST_CHECK_THROW(method->advance({.x = positions()}, 1.0), std::invalid_argument);
  BOOST_CHECK_THROW(method->advance({.x = vortices.over(positions())}, 0.0), std::invalid_argument);
  BOOST_CHECK_THROW(
      DiscretizeFirst(vortices.system, std::make_shared<Theta>(std::make_shared<Euclidean>(16))),
      std::invalid_argument);
  BOOST_CHECK_THROW(
      DiscretizeFirst(nullptr, std::make_shared<Theta>(std::make_shared<Euclidean>(16))),
      std::invalid_argument);
}

// |x| = 3 on the unit sphere.
BOOST_AUTO_TEST_CASE(starts_off_the_manifold_are_refused) {
  const auto sphere = std::make_shared<Sphere>(2);
  const auto system = std::make_shared<examples::FormulaSystem>(
      sphere, 0, 3, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        ExprVector turning(3);
        turning << -x[1], x[0], 0.0;
        return ExprVector(v - turning);
      });
  const DiscretizeFirst method(system, std::make_shared<Theta>(sphere));
  const VectorXd x = Eigen::Vector3d(0.6, 0.0, 0.8);
  BOOST_CHECK_NO_THROW(method.advance({.x = x}, 0.1));
  BOOST_CHECK_NO_THROW(method.advance({.x = (1.0 + 1e-8) * x}, 0.1));
  for (const double factor : {3.0, 1.0 + 1e-5, std::nan("")})
    BOOST_CHECK_THROW(method.advance({.x = factor * x}, 0.1), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
