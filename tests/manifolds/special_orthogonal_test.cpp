#include "courant/manifolds/special_orthogonal.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"

// Mistakes that these cases have to notice:
//  * reflections are points
BOOST_AUTO_TEST_SUITE(special_orthogonal)

using namespace courant;

namespace {

MatrixXd matrix(const VectorXd& x, Index n) { return x.reshaped<Eigen::RowMajor>(n, n); }
MatrixXd skew(const VectorXd& v, Index n) {
  MatrixXd V = MatrixXd::Zero(n, n);
  for (Index i = 0, a = 0; i < n; ++i)
    for (Index j = i + 1; j < n; ++j, ++a) {
      V(i, j) = v[a];
      V(j, i) = -v[a];
    }
  return V;
}

}  // namespace

// By the definition, with an inverse that has pivots; no vector is too long.
BOOST_AUTO_TEST_CASE(cayley_retraction) {
  const SpecialOrthogonal M(5);
  std::mt19937 generator(3);
  const VectorXd x = M.random_point(generator);
  for (const double length : {1e-8, 0.5, 20.0}) {
    const VectorXd v = M.random_tangent(x, length, generator);
    const MatrixXd one = MatrixXd::Identity(5, 5), half = skew(v, 5) / 2;
    const MatrixXd expected = matrix(x, 5) * LuDecomposition(one - half).solve(one + half);
    BOOST_TEST((matrix(M.retract(x, v), 5) - expected).norm() < 1e-13);
    BOOST_TEST((M.inverse_retract(x, M.retract(x, v)) - v).norm() <
               1e-13 * (1.0 + length * length));
  }
}

// (v_01, v_02, v_12) = (-ω₂, ω₁, -ω₀).
BOOST_AUTO_TEST_CASE(rotations_of_space_in_another_basis) {
  const SpecialOrthogonal M(3);
  const SpecialOrthogonal3 other(SpecialOrthogonal3::cayley());
  std::mt19937 generator(4);
  const VectorXd x = other.random_point(generator), w = VectorXd{{0.3, -0.8, 0.5}};
  BOOST_TEST((M.retract(x, VectorXd{{-w[2], w[1], -w[0]}}) - other.retract(x, w)).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(nearest_rotation) {
  const SpecialOrthogonal M(4);
  std::mt19937 generator(5);
  const VectorXd x = M.random_point(generator);
  const VectorXd near = M.project(1.3 * x + 0.01 * VectorXd::LinSpaced(16, -1.0, 1.0));
  BOOST_TEST(M.point_defect(near) < 1e-14);
  BOOST_TEST((near - x).norm() < 0.1);
  VectorXd reflected = VectorXd::Zero(16);
  for (Index i = 0; i < 4; ++i) reflected[5 * i] = i == 0 ? -1.0 : 1.0;
  BOOST_TEST(std::isinf(M.point_defect(reflected)));
  BOOST_CHECK_THROW(M.project(reflected), std::domain_error);
  BOOST_CHECK_THROW(M.project(VectorXd::Zero(16)), std::domain_error);
  BOOST_CHECK_THROW(SpecialOrthogonal(0), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
