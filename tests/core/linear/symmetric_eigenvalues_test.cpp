#include "courant/core/linear/symmetric_eigenvalues.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

BOOST_AUTO_TEST_SUITE(symmetric_eigenvalues)

BOOST_AUTO_TEST_CASE(increasing_from_the_lower_triangle) {
  Eigen::MatrixXd A(3, 3);  // a rotation of diag(1, 3) by 45°, and 0
  A << 2, 99, 99, 1, 2, 99, 0, 0, 0;
  const Eigen::VectorXd values = courant::symmetric_eigenvalues(A);
  BOOST_TEST((values - Eigen::VectorXd(Eigen::Vector3d(0, 1, 3))).norm() < 1e-14);
  BOOST_TEST(courant::symmetric_eigenvalues(Eigen::MatrixXd(0, 0)).size() == 0);
  BOOST_CHECK_THROW(courant::symmetric_eigenvalues(Eigen::MatrixXd::Ones(1, 2)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(vectors_that_the_matrix_stretches_by_its_values) {
  const Eigen::MatrixXd half = Eigen::MatrixXd::Random(5, 5), A = half + half.transpose();
  const auto [values, Q] = courant::symmetric_eigenvectors(A);
  BOOST_TEST((A * Q - Q * values.asDiagonal()).norm() < 1e-13);
  BOOST_TEST((Q.transpose() * Q - Eigen::MatrixXd::Identity(5, 5)).norm() < 1e-13);
  BOOST_TEST(courant::symmetric_eigenvectors(Eigen::MatrixXd(0, 0)).values.size() == 0);
  BOOST_CHECK_THROW(courant::symmetric_eigenvectors(Eigen::MatrixXd::Ones(1, 2)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
