#include "courant/core/linear/structural_rank.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/core/linear/fundamental_subspaces.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * stored zeros count as entries
BOOST_AUTO_TEST_SUITE(structural_rank_test)

namespace {

SparseMatrixXd sparse(const MatrixXd& A) { return A.sparseView(); }

}  // namespace

BOOST_AUTO_TEST_CASE(empty_matrices_have_none) {
  BOOST_TEST(structural_rank(SparseMatrixXd(0, 0)) == 0);
  BOOST_TEST(structural_rank(SparseMatrixXd(3, 2)) == 0);
}

// Two rows with entries in the first column only: one is too much.
BOOST_AUTO_TEST_CASE(rows_that_share_their_only_column_count_once) {
  MatrixXd A(3, 3);
  A << 1, 0, 0, 2, 0, 0, 3, 4, 5;
  BOOST_TEST(structural_rank(sparse(A)) == 2);
}

// Numbers do not matter: (1 1; 1 1) could have rank 2. Stored zeros are no entries.
BOOST_AUTO_TEST_CASE(it_is_of_the_pattern_alone) {
  BOOST_TEST(structural_rank(sparse(MatrixXd::Ones(2, 2))) == 2);
  SparseMatrixXd A(2, 2);
  A.insert(0, 0) = 1.0;
  A.insert(1, 1) = 0.0;
  BOOST_TEST(structural_rank(A) == 1);
}

BOOST_AUTO_TEST_CASE(random_numbers_of_a_pattern_have_it) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(0.5, 1.5);
  for (int sample = 0; sample < 50; ++sample) {
    const Index m = 3 + sample % 4, n = 2 + sample % 5;
    const MatrixXd A = MatrixXd::NullaryExpr(
        m, n, [&] { return generator() % 3 == 0 ? uniform(generator) : 0.0; });
    BOOST_TEST(structural_rank(sparse(A)) == decide_rank(A).rank);
  }
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
