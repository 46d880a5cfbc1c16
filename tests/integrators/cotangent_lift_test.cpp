#include "courant/integrators/cotangent_lift.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/integrators/theta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"

using namespace courant;
using Eigen::Vector3d;

namespace {

CotangentLift lift(const std::shared_ptr<const Manifold>& Q, double theta) {
  return CotangentLift(std::make_shared<CotangentBundle>(Q), std::make_shared<Theta>(Q, theta));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(cotangent_lift)

// Example 4.13, and the same for any θ: q ∓ …, p₀ = p - (1-θ) ṗ, p₁ = p + θ ṗ.
BOOST_AUTO_TEST_CASE(on_vector_spaces) {
  const auto space = std::make_shared<Euclidean>(2);
  const Eigen::Vector4d x(0.3, -1.0, 2.0, 0.7);   // (q, p)
  const Eigen::Vector4d v(1.5, 0.2, -0.4, -2.0);  // (q̇, ṗ)
  for (const double theta : {0.0, 0.25, 0.5, 1.0}) {
    const CotangentLift map = lift(space, theta);
    const auto [x0, x1] = map.forward(x, v);
    Eigen::Vector4d expected0, expected1;
    expected0 << x.head(2) - theta * v.head(2), x.tail(2) - (1.0 - theta) * v.tail(2);
    expected1 << x.head(2) + (1.0 - theta) * v.head(2), x.tail(2) + theta * v.tail(2);
    BOOST_TEST((x0 - expected0).norm() < 1e-15);
    BOOST_TEST((x1 - expected1).norm() < 1e-15);
    const auto [back, velocity] = map.inverse(expected0, expected1);
    BOOST_TEST((back - x).norm() < 1e-15);
    BOOST_TEST((velocity - v).norm() < 1e-15);
  }
}

// θ = 0 on SO(3), R_d(g, ω) = (g, g exp ω̂), by hand: ⟨p, δ⟩ is the pairing of p₁ with the variation
// of g exp ω̂ in the body, dexp_{-ω} δ, so p = dexp_{-ω}ᵀ p₁; and moving g by g η̂ moves g exp ω̂ by
// Ad_{exp -ω} η, so μ = exp(ω̂) p₁ - p₀ and ρ = μ - ω × p.
BOOST_AUTO_TEST_CASE(explicit_map_on_rotations_by_hand) {
  const auto rotations = std::make_shared<SpecialOrthogonal3>();
  const CotangentLift map = lift(rotations, 0.0);
  std::mt19937 generator(3);
  const VectorXd q0 = rotations->random_point(generator);
  const Vector3d w(0.4, -0.9, 0.3);
  const VectorXd q1 = rotations->retract(q0, w);
  const Vector3d p0(1.0, 0.2, -0.5), p1(0.3, 0.8, 1.1);
  VectorXd x0(12), x1(12);
  x0 << q0, p0;
  x1 << q1, p1;
  const auto [x, v] = map.inverse(x0, x1);

  const double angle = w.norm();
  const auto dexp_minus_transposed = [&](const Vector3d& a) -> Vector3d {
    // dexp_{-ω} = 1 - (1-cos)/θ² ω̂ + (θ-sin)/θ³ ω̂²; its transpose has the sign of ω̂ changed.
    return a + (1.0 - std::cos(angle)) / (angle * angle) * w.cross(a) +
           (angle - std::sin(angle)) / std::pow(angle, 3) * w.cross(w.cross(a));
  };
  const VectorXd identity_to_exp =
      rotations->retract(VectorXd(Eigen::Matrix3d::Identity().reshaped()), w);
  const Eigen::Matrix3d exp_w = identity_to_exp.reshaped<Eigen::RowMajor>(3, 3);
  const Vector3d p = dexp_minus_transposed(p1);
  const Vector3d mu = exp_w * p1 - p0;
  BOOST_TEST((x.head(9) - q0).norm() < 1e-15);
  BOOST_TEST((x.tail(3) - p).norm() < 1e-14);
  BOOST_TEST((v.head(3) - w).norm() < 1e-14);
  BOOST_TEST((v.tail(3) - (mu - w.cross(p))).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(momenta_stay_covectors_of_the_sphere) {
  const auto sphere = std::make_shared<Sphere>(2);
  const CotangentLift map = lift(sphere, 0.5);
  std::mt19937 generator(5);
  const auto& M = *map.manifold();
  const VectorXd x = M.random_point(generator);
  const auto [x0, x1] = map.forward(x, M.random_tangent(x, 0.5, generator));
  BOOST_TEST(M.point_defect(x0) < 1e-15);
  BOOST_TEST(M.point_defect(x1) < 1e-15);
}

BOOST_AUTO_TEST_CASE(errors) {
  const auto space = std::make_shared<Euclidean>(2);
  const auto phase_space = std::make_shared<CotangentBundle>(space);
  BOOST_CHECK_THROW(CotangentLift(phase_space, nullptr), std::invalid_argument);
  BOOST_CHECK_THROW(CotangentLift(nullptr, std::make_shared<Theta>(space)), std::invalid_argument);
  // Another object, though it is the same space.
  BOOST_CHECK_THROW(
      CotangentLift(phase_space, std::make_shared<Theta>(std::make_shared<Euclidean>(2))),
      std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
