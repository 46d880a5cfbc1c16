#include "courant/integrators/certificate/damped_inverse.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>

namespace courant {
// Mistakes that these cases have to notice:
//  * matrices that are not finite are factored
BOOST_AUTO_TEST_SUITE(damped_inverse_test)

// x + y = -g: the second unknown costs twice as much, and moves a quarter as far.
BOOST_AUTO_TEST_CASE(the_cheapest_of_the_best_steps) {
  const SparseMatrixXd S = MatrixXd{{1.0, 1.0}}.sparseView();
  const DampedInverse inverse(S, VectorXd{{1.0, 2.0}}, 0.0);
  BOOST_TEST((inverse.step(VectorXd{{-5.0}}) - VectorXd{{4.0, 1.0}}).norm() < 1e-14);
}

// (s² + μ c²) δ = -s g.
BOOST_AUTO_TEST_CASE(damping_shortens_steps) {
  const SparseMatrixXd S = MatrixXd{{2.0}}.sparseView();
  const DampedInverse inverse(S, VectorXd{{3.0}}, 0.5);
  BOOST_TEST((inverse.step(VectorXd{{-17.0}}) - VectorXd{{34.0 / 8.5}}).norm() < 1e-14);
}

// Singular values below 10⁻⁹ of the others are none: no step along them.
BOOST_AUTO_TEST_CASE(negligible_directions_do_not_move) {
  const SparseMatrixXd S = MatrixXd{{1.0, 0.0}, {0.0, 1e-14}}.sparseView();
  const VectorXd step = DampedInverse(S, VectorXd::Ones(2), 0.0).step(VectorXd{{-1.0, -1.0}});
  BOOST_TEST((step - VectorXd{{1.0, 0.0}}).norm() < 1e-12);
}

// Sparse factors of a large one give the same step as dense ones of its only row.
BOOST_AUTO_TEST_CASE(large_ones_have_sparse_factors) {
  const Index n = 300;
  SparseMatrixXd S(1, n);
  for (Index j = 0; j < n; ++j) S.insert(0, j) = 1.0;
  S.makeCompressed();
  BOOST_TEST(!is_factored_dense(S));
  const VectorXd step = DampedInverse(S, VectorXd::Ones(n), 0.0).step(VectorXd{{-300.0}});
  BOOST_TEST((step - VectorXd::Ones(n)).norm() < 1e-6);
}

BOOST_AUTO_TEST_CASE(numbers_that_are_not_finite_have_no_step) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const SparseMatrixXd S = MatrixXd{{infinity}}.sparseView();
  BOOST_TEST(DampedInverse(S, VectorXd::Ones(1), 0.0).step(VectorXd{{1.0}}).size() == 0);
  const SparseMatrixXd one = MatrixXd{{1.0}}.sparseView();
  BOOST_TEST(DampedInverse(one, VectorXd::Ones(1), 0.0).step(VectorXd{{infinity}}).size() == 0);
}

BOOST_AUTO_TEST_CASE(a_direction_loses_what_is_normal_to_the_kernel) {
  const SparseMatrixXd S = MatrixXd{{1.0, 1.0, 0.0}}.sparseView();
  const VectorXd part = kernel_part(S, VectorXd{{1.0, 0.0, 7.0}});
  BOOST_TEST((part - VectorXd{{0.5, -0.5, 7.0}}).norm() < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
