#include "courant/core/linear/lu_decomposition.hpp"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../random_matrix.hpp"

// Mistakes that these cases have to notice:
//  * the sign of the exchanges is forgotten
//  * rows of large matrices are exchanged the other way
//  * rows of an inverse end before the diagonal
BOOST_AUTO_TEST_SUITE(lu_decomposition)

using namespace courant;

BOOST_AUTO_TEST_CASE(solves_and_inverts) {
  for (const Index n : {0, 1, 2, 5, 40, 80}) {
    const MatrixXd A = random_matrix(n, n, 1), B = random_matrix(n, 3, 2);
    const LuDecomposition lu(A);
    const double bound = 1e-11 * (1.0 + A.norm());
    BOOST_TEST((A * lu.solve(B) - B).norm() < bound);
    BOOST_TEST((A * lu.inverse() - MatrixXd::Identity(n, n)).norm() < bound);
    VectorXd x = B.col(0);
    lu.solve(x.data());
    BOOST_TEST((A * x - B.col(0)).norm() < bound);
  }
}

// A zero in the corner needs an exchange, which changes the sign of the determinant.
BOOST_AUTO_TEST_CASE(determinants_have_the_sign_of_the_exchange) {
  MatrixXd A(3, 3);
  A << 0.0, 2.0, 0.0, 3.0, 1.0, 0.0, 0.0, 5.0, 0.5;
  BOOST_TEST(std::abs(LuDecomposition(A).determinant() + 3.0) < 1e-14);
  BOOST_TEST(LuDecomposition(MatrixXd(0, 0)).determinant() == 1.0);
  BOOST_TEST(LuDecomposition(MatrixXd::Zero(2, 2)).determinant() == 0.0);
}

BOOST_AUTO_TEST_CASE(pivots_tell_singular_matrices) {
  MatrixXd A = random_matrix(6, 6, 3);
  BOOST_TEST(LuDecomposition(A).pivot_ratio() > 1e-3);
  A.row(4) = A.row(1) - 2.0 * A.row(2);
  BOOST_TEST(LuDecomposition(A).pivot_ratio() < 1e-14);
  BOOST_TEST(LuDecomposition(MatrixXd::Zero(3, 3)).pivot_ratio() == 0.0);
  BOOST_TEST(LuDecomposition(MatrixXd(0, 0)).pivot_ratio() == 1.0);
}

// Loops of known length, plain loops and blocks, one matrix after the other in the same object.
BOOST_AUTO_TEST_CASE(takes_another_matrix) {
  LuDecomposition lu;
  BOOST_TEST(lu.size() == 0);
  MatrixXd inverse;
  for (const Index n : {3, 8, 9, 70, 63, 4, 4, 1, 0}) {
    const MatrixXd A = random_matrix(n, n, static_cast<unsigned>(n) + 7);
    lu.compute(A);
    BOOST_TEST(lu.size() == n);
    lu.inverse(inverse);
    BOOST_TEST((inverse * A - MatrixXd::Identity(n, n)).norm() < 1e-10 * (1.0 + A.norm()));
    const double exact = A.determinant();
    BOOST_TEST(std::fabs(lu.determinant() - exact) < 1e-9 * std::fabs(exact));
    BOOST_TEST(lu.orientation() == (exact > 0.0 ? 1 : -1));
  }
}

BOOST_AUTO_TEST_CASE(sizes_are_checked) {
  BOOST_CHECK_THROW(LuDecomposition(MatrixXd::Ones(2, 3)), std::invalid_argument);
  BOOST_CHECK_THROW(LuDecomposition(MatrixXd::Identity(2, 2)).solve(MatrixXd::Ones(3, 1)),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
