#include "courant/manifolds/stiefel.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/core/linear/lu_decomposition.hpp"

// Mistakes that these cases have to notice:
//  * dependent columns are projected somewhere
BOOST_AUTO_TEST_SUITE(stiefel)

using namespace courant;

namespace {

MatrixXd matrix(const VectorXd& x, Index n, Index k) { return x.reshaped<Eigen::RowMajor>(n, k); }

}  // namespace

// By the definition, with Eigen's inverse of 1 - W/2.
BOOST_AUTO_TEST_CASE(cayley_retraction) {
  const Stiefel M(5, 2);
  std::mt19937 generator(4);
  const VectorXd x = M.random_point(generator);
  const MatrixXd X = matrix(x, 5, 2);
  for (const double length : {1e-8, 0.5, 4.0}) {
    const VectorXd v = M.random_tangent(x, length, generator);
    const MatrixXd V = matrix(v, 5, 2);
    const MatrixXd PV = V - X * (X.transpose() * V) / 2;
    const MatrixXd W = PV * X.transpose() - X * PV.transpose();
    const MatrixXd one = MatrixXd::Identity(5, 5);
    BOOST_TEST((W * X - V).norm() < 1e-14 * (1.0 + length));
    const MatrixXd expected = LuDecomposition(one - W / 2).solve((one + W / 2) * X);
    BOOST_TEST((matrix(M.retract(x, v), 5, 2) - expected).norm() < 1e-14);
  }
}

// The closed inverse against a left inverse that knows only the retraction, at long distance.
BOOST_AUTO_TEST_CASE(inverse_of_long_vectors) {
  const Stiefel M(4, 3);
  std::mt19937 generator(5);
  for (const double length : {1.0, 5.0, 20.0}) {
    const VectorXd x = M.random_point(generator);
    const VectorXd v = M.random_tangent(x, length, generator);
    BOOST_TEST((M.inverse_retract(x, M.retract(x, v)) - v).norm() < 1e-13 * length * length);
  }
}

BOOST_AUTO_TEST_CASE(dimensions) {
  BOOST_TEST(Stiefel(3, 1).dimension() == 2);  // the sphere
  BOOST_TEST(Stiefel(3, 3).dimension() == 3);  // the orthogonal group
  BOOST_TEST(Stiefel(1, 1).dimension() == 0);
  BOOST_CHECK_THROW(Stiefel(2, 3), std::invalid_argument);
  BOOST_CHECK_THROW(Stiefel(2, 0), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(projection_is_the_polar_factor) {
  const Stiefel M(4, 2);
  std::mt19937 generator(6);
  const MatrixXd X = matrix(M.random_point(generator), 4, 2);
  const Eigen::Matrix2d S = (Eigen::Matrix2d() << 2.0, 0.3, 0.3, 0.5).finished();
  const MatrixXd XS = X * S;
  BOOST_TEST((matrix(M.project(XS.reshaped<Eigen::RowMajor>()), 4, 2) - X).norm() < 1e-14);
  BOOST_CHECK_THROW(M.project(VectorXd::Zero(8)), std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
