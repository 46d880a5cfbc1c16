#include "courant/manifolds/special_euclidean3.hpp"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/manifolds/rotation.hpp"

// Mistakes that these cases have to notice:
//  * the screw of an exponential is a translation
BOOST_AUTO_TEST_SUITE(special_euclidean3)

using namespace courant;
using Eigen::Matrix4d;
using Vector6d = Eigen::Matrix<double, 6, 1>;

namespace {

// The 4 × 4 matrix of a motion, and of an element (ω, u) of the Lie algebra.
Matrix4d motion(const VectorXd& x) {
  Matrix4d A = Matrix4d::Identity();
  A.topLeftCorner(3, 3) = x.head(9).reshaped<Eigen::RowMajor>(3, 3);
  A.topRightCorner(3, 1) = x.tail(3);
  return A;
}
Matrix4d algebra(const VectorXd& v) {
  Matrix4d A = Matrix4d::Zero();
  A.topLeftCorner(3, 3) = values(hat(constants(VectorXd(v.head(3)))));
  A.topRightCorner(3, 1) = v.tail(3);
  return A;
}

// exp A = (exp A/2¹⁰)^1024, by the power series.
Matrix4d matrix_exponential(const Matrix4d& A) {
  Matrix4d result = Matrix4d::Identity();
  Matrix4d term = Matrix4d::Identity();
  for (int k = 1; k < 12; ++k) {
    term = term * A / (1024.0 * k);
    result += term;
  }
  for (int i = 0; i < 10; ++i) result = (result * result).eval();
  return result;
}

Vector6d generic() { return (Vector6d() << 0.5, -1.2, 0.7, 2.0, 0.3, -1.0).finished(); }

}  // namespace

BOOST_AUTO_TEST_CASE(exponential_is_that_of_matrices) {
  const SpecialEuclidean3 G;
  std::mt19937 generator(2);
  const VectorXd x = G.random_point(generator);
  for (const double scale : {1e-6, 1.0, 1.9}) {
    const Vector6d v = scale * generic();
    const Matrix4d expected = motion(x) * matrix_exponential(algebra(v));
    BOOST_TEST((motion(G.retract(x, v)) - expected).norm() < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(cayley_is_the_fraction_of_matrices) {
  const SpecialEuclidean3 G(SpecialEuclidean3::cayley());
  std::mt19937 generator(3);
  const VectorXd x = G.random_point(generator);
  for (const double scale : {1e-6, 1.0, 5.0}) {
    const Vector6d v = scale * generic();
    const Matrix4d half = algebra(v) / 2;
    const Matrix4d one = Matrix4d::Identity();
    const Matrix4d expected = motion(x) * (one - half).inverse() * (one + half);
    BOOST_TEST((motion(G.retract(x, v)) - expected).norm() < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(frame_is_left_trivialised) {
  const SpecialEuclidean3 G;
  std::mt19937 generator(4);
  const VectorXd x = G.random_point(generator);
  const VectorXd velocity = G.frame(x) * generic();
  Matrix4d expected = motion(x) * algebra(generic());
  Matrix4d measured = motion(velocity);
  measured(3, 3) = 0.0;
  BOOST_TEST((measured - expected).norm() < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
