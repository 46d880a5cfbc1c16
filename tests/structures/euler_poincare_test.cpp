#include "courant/structures/euler_poincare.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

// Mistakes that these cases have to notice:
//  * the energy of a reduced Lagrangian with the wrong sign
BOOST_AUTO_TEST_SUITE(euler_poincare)

using namespace courant;

namespace {

using Eigen::Vector3d;

Vector3d inertia() { return {1.0, 2.0, 0.7}; }

// The heavy top: ℓ = Ω·IΩ/2 - w·Γ, ρ(Ω) = Ω ×, with a torque and Ω₂ = 0.1 Γ₀ by force.
EulerPoincare heavy_top(bool lagrangian) {
  EulerPoincare problem{.algebra = LieAlgebra::so3()};
  for (Index i = 0; i < 3; ++i) {
    MatrixXd rho = MatrixXd::Zero(3, 3);
    for (Index j = 0; j < 3; ++j) rho.col(j) = Vector3d::Unit(i).cross(Vector3d::Unit(j));
    problem.representation.push_back(rho);
  }
  const auto weight = [](const ExprVector& Gamma) -> Expr {
    return 0.3 * Gamma[0] - 0.2 * Gamma[1] + 1.1 * Gamma[2];
  };
  if (lagrangian)
    problem.lagrangian = [weight](const ExprVector& xi, const ExprVector& a, const Expr&) -> Expr {
      return 0.5 * (xi[0] * xi[0] + 2.0 * xi[1] * xi[1] + 0.7 * xi[2] * xi[2]) - weight(a);
    };
  else
    problem.hamiltonian = [weight](const ExprVector& mu, const ExprVector& a, const Expr&) -> Expr {
      return 0.5 * (mu[0] * mu[0] + mu[1] * mu[1] / 2.0 + mu[2] * mu[2] / 0.7) + weight(a);
    };
  problem.input = [](const ExprVector& mu, const ExprVector& a, const ExprVector& xi,
                     const Expr& t) {
    return ExprVector{{t, -0.1 * xi[1], mu[0] * a[2]}};
  };
  problem.constraint = [](const ExprVector& a, const ExprVector& xi, const Expr&) {
    return ExprVector::Constant(1, xi[2] + 0.5 * xi[0] - 0.1 * a[0]).eval();
  };
  problem.constraint_names = {"g"};
  return problem;
}

}  // namespace

// μ̇ = μ × Ω + Γ × w + u + κ ∂g/∂Ω, Γ̇ = Γ × Ω, by cross products.
BOOST_AUTO_TEST_CASE(heavy_top_with_input_and_constraint) {
  const Vector3d Omega(0.4, -0.9, 0.3), Gamma(0.2, 0.5, -0.8), w(0.3, -0.2, 1.1);
  const Vector3d mu = inertia().cwiseProduct(Omega);
  const double t = 0.6, kappa = 1.7;
  const Vector3d u(t, -0.1 * Omega[1], mu[0] * Gamma[2]);
  const Vector3d rate = mu.cross(Omega) + Gamma.cross(w) + u + kappa * Vector3d(0.5, 0.0, 1.0);
  VectorXd x(6), v(6), z(4);
  x << mu, Gamma;
  v << rate, Gamma.cross(Omega);
  z << Omega, kappa;
  const double g = Omega[2] + 0.5 * Omega[0] - 0.1 * Gamma[0];
  const auto from_lagrangian = euler_poincare_system(heavy_top(true));
  const VectorXd residual = from_lagrangian->residual(x, v, z, t);
  BOOST_TEST(residual.head(9).norm() < 1e-14);
  BOOST_TEST(std::abs(residual[9] - g) < 1e-15);
  const auto from_hamiltonian = euler_poincare_system(heavy_top(false));
  const VectorXd other = from_hamiltonian->residual(x, v, VectorXd::Constant(1, kappa), t);
  BOOST_TEST(other.head(6).norm() < 1e-14);
  BOOST_TEST(std::abs(other[6] - g) < 1e-15);
  // Both have the energy of the top.
  const double H = 0.5 * mu.dot(Omega) + w.dot(Gamma);
  BOOST_TEST(std::abs(from_lagrangian->energy(constants(x), constants(z), Expr(t))->value() - H) <
             1e-14);
  BOOST_TEST(
      std::abs(from_hamiltonian->energy(constants(x), constants(z.tail(1)), Expr(t))->value() - H) <
      1e-14);
}

BOOST_AUTO_TEST_CASE(names_and_errors) {
  const auto system = euler_poincare_system(heavy_top(true), {{}, {"W[0]", "W[1]", "W[2]"}});
  BOOST_TEST(
      system->names().auxiliary == (std::vector<std::string>{"W[0]", "W[1]", "W[2]", "lambda"}),
      boost::test_tools::per_element());
  BOOST_TEST(system->names().equations.back() == "g");
  EulerPoincare problem = heavy_top(true);
  problem.hamiltonian = problem.lagrangian;
  BOOST_CHECK_THROW(euler_poincare_system(problem), std::invalid_argument);
  problem.lagrangian = problem.hamiltonian = {};
  BOOST_CHECK_THROW(euler_poincare_system(problem), std::invalid_argument);
  problem = heavy_top(true);
  problem.representation[0] *= 2.0;
  BOOST_CHECK_THROW(euler_poincare_system(problem), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
