#include "courant/integrators/certificate/row_reduction.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

// Mistakes that these cases have to notice:
//  * elimination with the largest pivots does not believe its bounds
//  * a pivot that is hardly more than its error comes first because it is large
BOOST_AUTO_TEST_SUITE(row_reduction_test)

using namespace courant;

namespace {

UncertainMatrix within(const MatrixXd& value, const MatrixXd& error) {
  return {value.sparseView(), error.sparseView()};
}

// Of all rows and columns alike.
RowReduction reduced(const UncertainMatrix& A, RowReduction::Pivots pivots) {
  const std::vector<Index> level(static_cast<std::size_t>(A.rows()), 0);
  const std::vector<Index> group(static_cast<std::size_t>(A.cols()), 0);
  return RowReduction(A, level, group, pivots);
}

std::size_t rank(const UncertainMatrix& A, RowReduction::Pivots pivots) {
  return reduced(A, pivots).group(0).size();
}

}  // namespace

// The second row is the first but for 10⁻⁴, in numbers that are known to 10⁻³. That is more than bounds are
// believed for where pivots are chosen for their sparsity.
BOOST_AUTO_TEST_CASE(the_largest_pivots_believe_their_bounds) {
  MatrixXd A(2, 2);
  A << 1, 1, 1, 1 + 1e-4;
  const MatrixXd error = MatrixXd::Constant(2, 2, 1e-3);
  BOOST_TEST(rank(within(A, error), RowReduction::Pivots::sparse) == 2U);
  BOOST_TEST(rank(within(A, error), RowReduction::Pivots::largest) == 1U);
  BOOST_TEST(rank(within(A, 1e-6 * error), RowReduction::Pivots::largest) == 2U);
}

// An entry that is hardly more than its bound is no pivot while there are others, though it be the largest.
BOOST_AUTO_TEST_CASE(clear_pivots_come_first) {
  MatrixXd A(2, 2), error(2, 2);
  A << 2, 1, 0, 1;
  error << 1, 1e-9, 0, 1e-9;
  const RowReduction reduction = reduced(within(A, error), RowReduction::Pivots::largest);
  BOOST_TEST_REQUIRE(reduction.group(0).size() == 2U);
  BOOST_TEST(reduction.group(0)[0].pivot == 1);
}

// A = multipliersᵀ A, whichever pivots are taken.
BOOST_AUTO_TEST_CASE(rows_are_what_their_multipliers_say) {
  MatrixXd A(3, 3);
  A << 2, 1, 0.5, 1, 3, -1, 4, -2, 1;
  for (const auto pivots : {RowReduction::Pivots::sparse, RowReduction::Pivots::largest}) {
    const RowReduction reduction = reduced(within(A, MatrixXd::Zero(3, 3)), pivots);
    BOOST_TEST_REQUIRE(reduction.group(0).size() == 3U);
    for (const RowReduction::Row& row : reduction.group(0)) {
      VectorXd sum = VectorXd::Zero(3);
      for (const auto& [i, factor] : row.multipliers) sum += factor * A.row(i).transpose();
      for (const auto& [j, value] : row.entries) sum[j] -= value;
      BOOST_TEST(sum.lpNorm<Eigen::Infinity>() < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
