#include "courant/integrators/maps/cotangent_lift.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"

BOOST_AUTO_TEST_SUITE(cotangent_lift)

using namespace courant;
using Eigen::Vector3d;

namespace {

CotangentLift lift(const std::shared_ptr<const Manifold>& Q, double theta) {
  return CotangentLift(std::make_shared<CotangentBundle>(Q), std::make_shared<Theta>(Q, theta));
}

// R_d(q, v) = (q - v/2 + a(v), q + v/2 + b(q, v)) with a, b of second order in v: a map whose T R_d
// depends on the point, and which no retraction gives.
class Bent final : public DiscretizationMap {
 public:
  explicit Bent(std::shared_ptr<const Euclidean> plane)
      : DiscretizationMap("Bent", std::move(plane)) {}
  bool has_inverse() const override { return false; }
  int order() const override { return 1; }
  bool is_symmetric() const override { return false; }

 private:
  PointPair<Expr> do_forward(const ExprVector& q, const ExprVector& v) const override {
    const ExprVector a = (ExprVector(2) << 0.1 * v[0] * v[1], 0.2 * square(v[0])).finished();
    const ExprVector b = (ExprVector(2) << sin(q[1]) * square(v[0]), q[0] * v[0] * v[1]).finished();
    const ExprVector half = Expr(0.5) * v;
    return {q - half + a, q + half + b};
  }
};

}  // namespace

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

// Φ⁻¹ ∘ R̂_d ∘ α_Q with each factor by its definition, for a map R_d that isn't linear, with
//   α_Q: TT*Q → T*TQ, (q, p, q̇, ṗ) ↦ (q, v, p_q, p_v) = (q, q̇, ṗ, p).
// The printed direction, (a, b, c, d) ↦ (a, d, b, c), gives another map, for which (D2) fails.
BOOST_AUTO_TEST_CASE(alpha_q_leads_to_the_cotangent_bundle_of_the_tangent_bundle) {
  using Eigen::Vector2d, Eigen::Vector4d;
  const auto plane = std::make_shared<Euclidean>(2);
  const auto R_d = std::make_shared<Bent>(plane);
  const CotangentLift map(std::make_shared<CotangentBundle>(plane), R_d);
  Graph graph;
  const ExprVector y = graph.variables("y", 4);
  const auto [first, second] = R_d->forward(ExprVector(y.head(2)), ExprVector(y.tail(2)));
  ExprVector both(4);
  both << first, second;
  const ExprVector entries = jacobian(both, y).dense().reshaped();

  // (q, v, p_q, p_v) ↦ (q₀, p₀; q₁, p₁): R̂_d = (T R_d⁻¹)*, then Φ⁻¹.
  const auto lifted = [&](const Vector2d& q, const Vector2d& v, const Vector2d& p_q,
                          const Vector2d& p_v) {
    const Vector4d at = (Vector4d() << q, v).finished();
    const MatrixXd T = values(substitute(entries, y, constants(at))).reshaped(4, 4);
    const Vector4d ends = values(substitute(both, y, constants(at)));
    const Vector4d covector =
        LuDecomposition(T.transpose()).solve((Vector4d() << p_q, p_v).finished());
    return std::pair{(Vector4d() << ends.head(2), -covector.head(2)).finished(),
                     (Vector4d() << ends.tail(2), covector.tail(2)).finished()};
  };
  const Vector2d q(0.3, -1.0), p(2.0, 0.7), q_dot(0.5, 0.2), p_dot(-0.4, -0.9);
  const auto [x0, x1] =
      map.forward((Vector4d() << q, p).finished(), (Vector4d() << q_dot, p_dot).finished());
  const auto [y0, y1] = lifted(q, q_dot, p_dot, p);
  BOOST_TEST((x0 - y0).norm() + (x1 - y1).norm() < 1e-14);
  const auto [z0, z1] = lifted(q, p_dot, p, q_dot);
  BOOST_TEST((x0 - z0).norm() + (x1 - z1).norm() > 0.1);
  // (D1) is lost too: at (q, p, 0, 0) the printed direction puts q̇ = 0 in the place of p.
  const auto [w0, w1] = lifted(q, Vector2d::Zero(), p, Vector2d::Zero());
  BOOST_TEST((w0.tail(2) - p).norm() + (w1.tail(2) - p).norm() > 0.1);
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
  BOOST_CHECK_THROW(
      CotangentLift(phase_space, std::make_shared<Theta>(std::make_shared<Euclidean>(3))),
      std::invalid_argument);
  // Another object, and the same space.
  BOOST_CHECK_NO_THROW(
      CotangentLift(phase_space, std::make_shared<Theta>(std::make_shared<Euclidean>(2))));
}

BOOST_AUTO_TEST_SUITE_END()
