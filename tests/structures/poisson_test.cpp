#include "courant/structures/poisson.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"

BOOST_AUTO_TEST_SUITE(poisson)

using namespace courant;

BOOST_AUTO_TEST_CASE(example_2_2_3) {
  // ⟨β, ♯α⟩ = Λ(β, α): the rigid body bivector at ξ, v = ξ × α up to the sign of Λ_ξ in
  // Example 5.6, v = Λ_ξ α.
  const auto M = std::make_shared<Euclidean>(3);
  const Poisson structure(M, [](const ExprVector& x) {
    ExprMatrix matrix(3, 3);
    matrix << Expr(0.0), -x[2], x[1], x[2], Expr(0.0), -x[0], -x[1], x[0], Expr(0.0);
    return matrix;
  });
  const Eigen::Vector3d xi(0.3, -0.5, 0.8), alpha(1.0, 0.4, -0.2);
  const Eigen::Vector3d v = xi.cross(alpha);
  const auto residual = [&](const Eigen::Vector3d& velocity) {
    return VectorXd(values(
        structure.membership(constants(xi), constants(velocity), constants(alpha), ExprVector(0))));
  };
  BOOST_TEST(residual(v).norm() < 1e-16);
  BOOST_TEST(residual(v + xi).norm() > 0.9);
}

BOOST_AUTO_TEST_CASE(membership_checks_sizes) {
  const auto M = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
  const CanonicalSymplectic structure(M);
  BOOST_CHECK_THROW(structure.membership(ExprVector::Zero(2), ExprVector::Zero(1),
                                         ExprVector::Zero(2), ExprVector(0)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
