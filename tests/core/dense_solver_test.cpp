#include "courant/core/dense_solver.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>
#include <random>

BOOST_AUTO_TEST_SUITE(dense_solver)

using namespace courant;

namespace {

MatrixPattern full(Index rows, Index columns) {
  MatrixPattern pattern{.rows = rows, .columns = columns, .row = {}, .column = {}};
  for (Index j = 0; j < columns; ++j)
    for (Index i = 0; i < rows; ++i) {
      pattern.row.push_back(i);
      pattern.column.push_back(j);
    }
  return pattern;
}

VectorXd solution(DenseSolver& solver, const VectorXd& b, Index size) {
  VectorXd x(size);
  solver.solve(b.data(), x.data());
  return x;
}

}  // namespace

BOOST_AUTO_TEST_CASE(regular_systems_of_every_size) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  for (Index n = 0; n <= 12; ++n) {
    const MatrixXd A = MatrixXd::NullaryExpr(n, n, [&] { return normal(generator); });
    const VectorXd b = VectorXd::NullaryExpr(n, [&] { return normal(generator); });
    DenseSolver solver(full(n, n));
    BOOST_TEST_REQUIRE(solver.factorize(A.data()));
    BOOST_TEST(solver.is_determined());
    BOOST_TEST((A * solution(solver, b, n) - b).norm() < 1e-11);
  }
}

// Rows of very different units, one of them said twice; the second unknown is in no equation.
BOOST_AUTO_TEST_CASE(redundant_and_undetermined_systems) {
  const MatrixPattern pattern{.rows = 3, .columns = 3, .row = {0, 1, 2, 2}, .column = {0, 0, 0, 2}};
  const double entries[] = {1e6, 1e-6, 1.0, 1.0};
  DenseSolver solver(pattern);
  BOOST_TEST_REQUIRE(solver.factorize(entries));
  BOOST_TEST(!solver.is_determined());
  const VectorXd x = solution(solver, Eigen::Vector3d(2e6, 2e-6, 5.0), 3);
  BOOST_TEST((x - VectorXd(Eigen::Vector3d(2.0, 0.0, 3.0))).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(more_equations_than_unknowns) {
  const double entries[] = {1.0, 1.0};
  DenseSolver solver(full(2, 1));
  BOOST_TEST_REQUIRE(solver.factorize(entries));
  BOOST_TEST(solver.is_determined());
  BOOST_TEST(std::abs(solution(solver, Eigen::Vector2d(1.0, 3.0), 1)[0] - 2.0) < 1e-15);
}

BOOST_AUTO_TEST_CASE(entries_that_are_not_finite) {
  DenseSolver solver(full(1, 1));
  const double one = 1.0, nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(solver.factorize(&one));
  BOOST_TEST(!solver.factorize(&nan));
  BOOST_TEST(!solver.is_determined());
}

BOOST_AUTO_TEST_SUITE_END()
