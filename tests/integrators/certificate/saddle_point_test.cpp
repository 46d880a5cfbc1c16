#include "courant/integrators/certificate/saddle_point.hpp"

#include <boost/test/unit_test.hpp>

namespace courant {
// Mistakes that these cases have to notice:
//  * the nearest point is not searched where factors break down
BOOST_AUTO_TEST_SUITE(saddle_point_test)

// ½ (2 x² + 3 y²) - a·(x, y) where x + y = 1: by hand x = (a₁ - a₂ + 3)/5.
BOOST_AUTO_TEST_CASE(the_least_value_on_a_line) {
  const SparseMatrixXd P = sparse_diagonal(VectorXd{{2.0, 3.0}});
  const SparseMatrixXd S = MatrixXd{{1.0, 1.0}}.sparseView();
  const SaddlePoint saddle(P, S, 1e-14);
  BOOST_TEST(saddle.columns() == 2);
  const VectorXd at = saddle.solve(VectorXd{{4.0, 2.0}}, VectorXd{{1.0}});
  BOOST_TEST((at - VectorXd{{1.0, 0.0}}).norm() < 1e-12);
}

// A first pivot of 0, which a factorisation without exchanges cannot divide by.
BOOST_AUTO_TEST_CASE(pivots_may_vanish) {
  const SparseMatrixXd P = sparse_diagonal(VectorXd{{0.0, 0.0}});
  const SparseMatrixXd S = MatrixXd{{1.0, 1.0}, {1.0, -1.0}}.sparseView();
  const VectorXd at = SaddlePoint(P, S, 0.0).solve(VectorXd{{0.0, 0.0}}, VectorXd{{3.0, 1.0}});
  BOOST_REQUIRE(at.size() == 2);
  BOOST_TEST((at - VectorXd{{2.0, 1.0}}).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(dense_factors_are_for_small_ones) {
  BOOST_TEST(is_factored_dense(SparseMatrixXd(200, 3)));
  BOOST_TEST(!is_factored_dense(SparseMatrixXd(201, 3)));
  BOOST_TEST(!is_factored_dense(SparseMatrixXd(3, 201)));
  BOOST_TEST(
      (MatrixXd(sparse_diagonal(VectorXd{{2.0, 0.0}})) == MatrixXd({{2.0, 0.0}, {0.0, 0.0}})));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
