#include "courant/core/linear/orthogonal_rows.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

#include "courant/core/linear/complete_orthogonal_decomposition.hpp"

// Mistakes that these cases have to notice:
//  * rows keep their parts along those before
//  * a right-hand side keeps its parts along rows before
//  * a dependent row is solved, or what is left of it is not told
//  * rows are taken in the order in which they stand
BOOST_AUTO_TEST_SUITE(orthogonal_rows)

using namespace courant;

namespace {

OrthogonalRows::Rows rows_of(const MatrixXd& A) {
  OrthogonalRows::Rows rows(static_cast<std::size_t>(A.rows()));
  for (Index i = 0; i < A.rows(); ++i)
    for (Index j = 0; j < A.cols(); ++j) rows[static_cast<std::size_t>(i)].emplace_back(A(i, j));
  return rows;
}

std::vector<DoubleDouble> numbers(const VectorXd& b) { return {b.begin(), b.end()}; }

VectorXd rounded(const std::vector<DoubleDouble>& x) {
  return VectorXd::NullaryExpr(std::ssize(x),
                               [&](Index i) { return x[static_cast<std::size_t>(i)].high; });
}

// The largest |A x - b|, in the digits of x.
double defect(const MatrixXd& A, const std::vector<DoubleDouble>& x, const VectorXd& b) {
  double largest = 0.0;
  for (Index i = 0; i < A.rows(); ++i) {
    DoubleDouble sum = -b[i];
    for (Index j = 0; j < A.cols(); ++j)
      sum += DoubleDouble(A(i, j)) * x[static_cast<std::size_t>(j)];
    largest = std::max(largest, std::fabs(sum.high));
  }
  return largest;
}

constexpr double negligible = 0x1p-64;

}  // namespace

BOOST_AUTO_TEST_CASE(solutions_have_the_least_norm) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  const auto random = [&](Index m, Index n) {
    return MatrixXd(MatrixXd::NullaryExpr(m, n, [&] { return normal(generator); }));
  };
  for (const Index rank : {1, 3, 6})
    for (const Index m : {6, 9})
      for (const Index n : {6, 11}) {
        // Rows that are sums of others have no round-off: entries are small whole numbers.
        const MatrixXd A = (random(m, rank) * 4.0).array().round().matrix() *
                           (random(rank, n) * 4.0).array().round().matrix();
        const VectorXd b = A * random(n, 1).unaryExpr([](double a) { return std::round(8.0 * a); });
        const OrthogonalRows inverse(rows_of(A), negligible);
        const auto solution = inverse.solve(numbers(b));
        const CompleteOrthogonalDecomposition expected(A, 1e-12);
        BOOST_TEST(inverse.rank() == static_cast<std::size_t>(expected.rank()));
        const VectorXd least = expected.solve(b);
        BOOST_TEST((rounded(solution.x) - least).norm() < 1e-9 * (1.0 + least.norm()));
        BOOST_TEST(defect(A, solution.x, b) < 1e-24);
        BOOST_TEST(solution.left < 1e-24);
      }
}

BOOST_AUTO_TEST_CASE(what_contradicts_is_left) {
  const MatrixXd A{{1.0, 0.0}, {0.0, 0.5}, {1.0, 0.5}};
  const auto solution =
      OrthogonalRows(rows_of(A), negligible).solve(numbers(VectorXd{{1, 2, 3.25}}));
  BOOST_TEST(std::fabs(solution.left - 0.25) < 1e-15);
  BOOST_TEST(OrthogonalRows(rows_of(MatrixXd(0, 0)), negligible).solve({}).x.empty());
  const auto nothing = OrthogonalRows(rows_of(MatrixXd::Zero(2, 3)), negligible);
  BOOST_TEST(nothing.rank() == 0u);
  BOOST_TEST(nothing.solve(numbers(VectorXd{{-2, 1}})).left == 2.0);
}

// Rows that differ by 10⁻¹⁷ of themselves.
BOOST_AUTO_TEST_CASE(divides_by_what_double_takes_for_round_off) {
  OrthogonalRows::Rows rows{{1.0, 0.0}, {1.0, 1e-17}};
  const auto solution =
      OrthogonalRows(rows, negligible).solve({DoubleDouble(1.0), DoubleDouble(1.0, 1e-17)});
  BOOST_TEST(std::fabs(solution.x[0].high - 1.0) < 1e-12);
  BOOST_TEST(std::fabs(solution.x[1].high - 1.0) < 1e-12);
}

// A row that is small, and in its direction but for what is negligible, depends on the large one, wherever it stands.
BOOST_AUTO_TEST_CASE(the_row_with_the_largest_entry_is_first) {
  const MatrixXd small_first{{1e-10, 1e-22}, {1.0, 0.0}};
  BOOST_TEST(OrthogonalRows(rows_of(small_first), negligible).rank() == 1u);
  BOOST_TEST(OrthogonalRows(rows_of(small_first.colwise().reverse()), negligible).rank() == 1u);
}

BOOST_AUTO_TEST_SUITE_END()
