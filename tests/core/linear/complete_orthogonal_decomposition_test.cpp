#include "courant/core/linear/complete_orthogonal_decomposition.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>

#include "../random_matrix.hpp"

// Mistakes that these cases have to notice:
//  * the data error is not taken into account
//  * solutions are not those of least norm
BOOST_AUTO_TEST_SUITE(complete_orthogonal_decomposition)

using namespace courant;

// The four equations of Penrose determine A⁺.
BOOST_AUTO_TEST_CASE(pseudo_inverse) {
  for (const auto& [m, n, r] :
       {std::array<Index, 3>{0, 0, 0}, std::array<Index, 3>{0, 3, 0}, std::array<Index, 3>{3, 0, 0},
        std::array<Index, 3>{4, 4, 4}, std::array<Index, 3>{6, 4, 4}, std::array<Index, 3>{4, 6, 4},
        std::array<Index, 3>{7, 6, 3}, std::array<Index, 3>{6, 7, 1},
        std::array<Index, 3>{3, 2, 0}}) {
    const MatrixXd A = random_matrix(m, r, 1) * random_matrix(r, n, 2);
    const CompleteOrthogonalDecomposition decomposition(A);
    BOOST_TEST(decomposition.rank() == r);
    BOOST_TEST(!decomposition.decision().ambiguous());
    const MatrixXd P = decomposition.pseudo_inverse();
    const double bound = 1e-12 * (1.0 + A.norm()) * (1.0 + P.norm());
    BOOST_TEST((A * P * A - A).norm() < bound);
    BOOST_TEST((P * A * P - P).norm() < bound);
    BOOST_TEST((A * P - (A * P).transpose()).norm() < bound);
    BOOST_TEST((P * A - (P * A).transpose()).norm() < bound);
    const MatrixXd B = random_matrix(m, 2, 3);
    BOOST_TEST((decomposition.solve(B) - P * B).norm() < bound);
    BOOST_TEST((decomposition.Q().rightCols(m - r).transpose() * A).norm() < bound);
  }
}

BOOST_AUTO_TEST_CASE(what_is_within_the_data_error_is_not_divided_by) {
  MatrixXd A = MatrixXd::Identity(3, 3);
  A(2, 2) = 1e-9;
  BOOST_TEST(CompleteOrthogonalDecomposition(A).rank() == 3);
  const CompleteOrthogonalDecomposition rough(A, 1e-8);
  BOOST_TEST(rough.rank() == 2);
  BOOST_TEST((rough.solve(VectorXd::Ones(3)) - VectorXd(Eigen::Vector3d(1, 1, 0))).norm() < 1e-15);
  // In other units all the same: sizes are relative to the largest.
  BOOST_TEST(CompleteOrthogonalDecomposition(1e6 * A).rank() == 3);
  BOOST_TEST(CompleteOrthogonalDecomposition(1e-6 * A, 1e-8).rank() == 2);
}

BOOST_AUTO_TEST_CASE(order_starts_with_independent_columns) {
  MatrixXd A = random_matrix(5, 4, 7);
  A.col(1) = 3.0 * A.col(2);
  const CompleteOrthogonalDecomposition decomposition(A);
  BOOST_TEST(decomposition.rank() == 3);
  BOOST_TEST((decomposition.order().back() == 1 || decomposition.order().back() == 2));
}

BOOST_AUTO_TEST_CASE(faults_are_reported) {
  MatrixXd A = MatrixXd::Identity(2, 2);
  BOOST_CHECK_THROW(CompleteOrthogonalDecomposition(A).solve(MatrixXd::Ones(3, 1)),
                    std::invalid_argument);
  A(0, 1) = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(CompleteOrthogonalDecomposition{A}, std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
