#include "courant/integrators/maps/discrete_dirac_structure.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/structures/canonical_symplectic.hpp"
#include "courant/structures/poisson.hpp"

BOOST_AUTO_TEST_SUITE(discrete_dirac_structure)

using namespace courant;
using Eigen::Vector3d;

namespace {

constexpr double tolerance = 1e-12;

ExprMatrix hat(const ExprVector& a) {
  ExprMatrix result(3, 3);
  result << Expr(0.0), -a[2], a[1], a[2], Expr(0.0), -a[0], -a[1], a[0], Expr(0.0);
  return result;
}

double residual(const DiscreteDiracStructure& D, const VectorXd& x0, const VectorXd& x1,
                const VectorXd& alpha, double h = 1.0) {
  return values(D.membership(constants(x0), constants(x1), constants(alpha), ExprVector(0), h))
      .norm();
}

VectorXd log_sphere(const Vector3d& x, const Vector3d& y) {
  const Vector3d projected = y - x * x.dot(y);
  return std::acos(x.dot(y)) * projected / projected.norm();
}

}  // namespace

// Over each x the elements (R_d(x, v), α), (v, α) ∈ D_x, and no others; isotropic for the pairing.
BOOST_AUTO_TEST_CASE(definition_5_1) {
  const auto S2 = std::make_shared<Sphere>(2);
  const auto D = std::make_shared<Poisson>(S2, hat);
  const DiscreteDiracStructure discrete(D, std::make_shared<Chordal>(S2));
  std::mt19937 generator(1);
  const VectorXd x = S2->random_point(generator);
  const auto elements = discrete.elements(x, 0.7);
  BOOST_TEST(elements.size() == 2U);
  for (const auto& a : elements) {
    BOOST_TEST((discrete.base_point(a.x0, a.x1) - x).norm() < tolerance);
    BOOST_TEST(discrete.distance(a.x0, a.x1, a.alpha) < tolerance);
    BOOST_TEST(residual(discrete, a.x0, a.x1, a.alpha) < tolerance);
    for (const auto& b : elements)
      BOOST_TEST(std::abs(discrete.pairing(a.x0, a.x1, a.alpha, b.x0, b.x1, b.alpha)) < tolerance);
    // Off D_d: another covector, and the points in the other order.
    BOOST_TEST(discrete.distance(a.x0, a.x1, 2.0 * a.alpha) > 0.1);
    BOOST_TEST(discrete.distance(a.x1, a.x0, a.alpha) > 0.1);
  }
  // With a time step, v = R_d⁻¹/h.
  const auto& a = elements.front();
  BOOST_TEST(discrete.distance(a.x0, a.x1, a.alpha / 0.1, 0.1) < 1e-10);
  // Elements over different points have no pairing.
  const auto elsewhere = discrete.elements(S2->random_point(generator), 0.7).front();
  BOOST_CHECK_THROW(
      discrete.pairing(a.x0, a.x1, a.alpha, elsewhere.x0, elsewhere.x1, elsewhere.alpha),
      std::domain_error);
  BOOST_CHECK_THROW(
      DiscreteDiracStructure(D, std::make_shared<Theta>(std::make_shared<Sphere>(3), 0.5)),
      std::invalid_argument);
}

// x_{k+1} - x_k = Λ(x_{k+1/2}) α.
BOOST_AUTO_TEST_CASE(example_5_2) {
  const auto M = std::make_shared<Euclidean>(3);
  const DiscreteDiracStructure discrete(std::make_shared<Poisson>(M, hat),
                                        std::make_shared<Theta>(M, 0.5));
  const Vector3d middle(0.3, -0.5, 0.8), alpha(1.0, 0.4, -0.2), v = middle.cross(alpha);
  const Vector3d x0 = middle - v / 2.0, x1 = middle + v / 2.0;
  BOOST_TEST(residual(discrete, x0, x1, alpha) < tolerance);
  BOOST_TEST((discrete.base_point(x0, x1) - middle).norm() < tolerance);
  // Λ at x_k instead of the middle is another set.
  const Vector3d explicit_end = x0 + x0.cross(alpha);
  BOOST_TEST(residual(discrete, x0, explicit_end, alpha) > 0.01);
}

// log_{x_k}(x_{k+1}) = Λ(x_k) α, and by the symmetric map 2 (x_{k+1} - x_k)/|s| = Λ(s/|s|) α, s =
// x_k + x_{k+1}.
BOOST_AUTO_TEST_CASE(example_5_3) {
  const auto S2 = std::make_shared<Sphere>(2);
  const auto D = std::make_shared<Poisson>(S2, hat);
  const Vector3d x0 = Vector3d(0.3, -0.5, 0.8).normalized(),
                 x1 = Vector3d(0.5, -0.2, 0.7).normalized();

  const DiscreteDiracStructure exponential(D, std::make_shared<Theta>(S2, 0.0));
  // α with x₀ × α = log: α = log × x₀.
  const Vector3d log = log_sphere(x0, x1), alpha = log.cross(x0);
  BOOST_TEST((x0.cross(alpha) - log).norm() < tolerance);
  BOOST_TEST(residual(exponential, x0, x1, alpha) < tolerance);
  BOOST_TEST((exponential.base_point(x0, x1) - x0).norm() < tolerance);

  const DiscreteDiracStructure symmetric(D, std::make_shared<Chordal>(S2));
  const Vector3d s = x0 + x1, middle = s.normalized(), v = 2.0 * (x1 - x0) / s.norm();
  const Vector3d beta = v.cross(middle);
  BOOST_TEST((middle.cross(beta) - v).norm() < tolerance);
  BOOST_TEST(residual(symmetric, x0, x1, beta) < tolerance);
  BOOST_TEST((symmetric.base_point(x0, x1) - middle).norm() < tolerance);
  // The two are different sets.
  BOOST_TEST(residual(symmetric, x0, x1, alpha) > 1e-3);
}

// exp⁻¹(g_k⁻¹ g_{k+1}) = Λ(g_k) α, both left-trivialised.
BOOST_AUTO_TEST_CASE(example_5_4) {
  const auto G = std::make_shared<SpecialOrthogonal3>();
  const auto lambda = [](const ExprVector& g) { return hat(g.head(3)); };  // of the first row of g
  const DiscreteDiracStructure discrete(std::make_shared<Poisson>(G, lambda),
                                        std::make_shared<Theta>(G, 0.0));
  const Vector3d alpha(0.4, -0.7, 0.2);
  const Eigen::Matrix3d g0 = Eigen::AngleAxisd(0.8, Vector3d(1.0, 2.0, -1.0).normalized()).matrix();
  const Vector3d xi = Vector3d(g0.row(0)).cross(alpha);
  const Eigen::Matrix3d g1 = g0 * Eigen::AngleAxisd(xi.norm(), xi.normalized()).matrix();
  const auto point = [](const Eigen::Matrix3d& g) {
    const Eigen::Matrix3d rows = g.transpose();
    return VectorXd(rows.reshaped());
  };
  BOOST_TEST(residual(discrete, point(g0), point(g1), alpha) < tolerance);
  BOOST_TEST(residual(discrete, point(g0), point(g1.transpose()), alpha) > 0.1);
  BOOST_TEST(discrete.distance(point(g0), point(g1), alpha) < tolerance);
}

// On T*Q: q_{k+1} - q_k = P_p, p_{k+1} - p_k = -P_q at the middle.
BOOST_AUTO_TEST_CASE(example_5_5) {
  const auto Q = std::make_shared<Euclidean>(2);
  const auto M = std::make_shared<CotangentBundle>(Q);
  const DiscreteDiracStructure discrete(
      std::make_shared<CanonicalSymplectic>(M),
      std::make_shared<CotangentLift>(M, std::make_shared<Theta>(Q, 0.5)));
  const VectorXd x0 = VectorXd{{0.1, -0.4, 0.9, 0.3}}, x1 = VectorXd{{0.5, 0.2, 0.6, 0.8}};
  VectorXd alpha(4);
  alpha << -(x1 - x0).tail(2), (x1 - x0).head(2);  // (P_q, P_p)
  BOOST_TEST(residual(discrete, x0, x1, alpha) < tolerance);
  BOOST_TEST((discrete.base_point(x0, x1) - 0.5 * (x0 + x1)).norm() < tolerance);
  BOOST_TEST(residual(discrete, x0, x1, -alpha) > 0.1);

  // On T*S², where the lift is no midpoint rule: the elements over a point are on it, i_v ω = α.
  const auto S2 = std::make_shared<Sphere>(2);
  const auto T = std::make_shared<CotangentBundle>(S2);
  const auto omega = std::make_shared<CanonicalSymplectic>(T);
  const DiscreteDiracStructure on_sphere(
      omega, std::make_shared<CotangentLift>(T, std::make_shared<Theta>(S2, 0.5)));
  std::mt19937 generator(2);
  const VectorXd x = T->random_point(generator);
  for (const auto& element : on_sphere.elements(x, 0.4)) {
    BOOST_TEST((on_sphere.base_point(element.x0, element.x1) - x).norm() < 1e-10);
    BOOST_TEST(residual(on_sphere, element.x0, element.x1, element.alpha) < 1e-10);
  }
}

BOOST_AUTO_TEST_SUITE_END()
