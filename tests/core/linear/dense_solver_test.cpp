#include "courant/core/linear/dense_solver.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>

// Mistakes that these cases have to notice:
//  * what is open is taken as predicted
//  * what is open is set to zero, not to where the state has it
//  * the factors of a regular matrix answer for a singular one
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

// With factors in the place of an inverse the solutions are the same to round-off; what is singular or not square has a
// pseudo-inverse either way.
BOOST_AUTO_TEST_CASE(factors_say_what_an_inverse_does) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  for (const Index n : {1, 2, 5, 8, 9, 20, 70}) {
    const VectorXd unit =
        VectorXd::NullaryExpr(n, [&] { return std::pow(10.0, 3.0 * normal(generator)); });
    const MatrixXd A =
        MatrixXd::NullaryExpr(n, n, [&] { return normal(generator); }) * unit.asDiagonal();
    const VectorXd x = unit.cwiseInverse().cwiseProduct(
        VectorXd::NullaryExpr(n, [&] { return normal(generator); }));
    DenseSolver by_factors(full(n, n), DenseSolver::Keeps::factors), by_inverse(full(n, n));
    for (DenseSolver* solver : {&by_factors, &by_inverse}) {
      BOOST_TEST_REQUIRE(solver->factorize(A.data()));
      BOOST_TEST(solver->is_determined());
      BOOST_TEST((unit.asDiagonal() * (solution(*solver, A * x, n) - x)).norm() < 1e-10);
    }
    BOOST_TEST(by_factors.orientation() == by_inverse.orientation());
    BOOST_TEST((by_factors.inverse() == nullptr));
    BOOST_TEST((by_inverse.inverse() != nullptr));
    if (n == 1) continue;

    MatrixXd singular = A;
    singular.row(n - 1) = singular.row(0);
    BOOST_TEST_REQUIRE(by_factors.factorize(singular.data()));
    BOOST_TEST(!by_factors.is_determined());
    BOOST_TEST((by_factors.inverse() == nullptr));
    const VectorXd b = singular * x;
    BOOST_TEST((singular * solution(by_factors, b, n) - b).norm() < 1e-9 * b.norm());
    BOOST_TEST_REQUIRE(by_factors.factorize(A.data()));  // and back
    BOOST_TEST((unit.asDiagonal() * (solution(by_factors, A * x, n) - x)).norm() < 1e-10);
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

// What the equation says, x₁ + x₂, is kept; what it leaves open, x₁ - x₂, is taken from x₀.
BOOST_AUTO_TEST_CASE(what_is_open_is_settled) {
  const double row[] = {1.0, 1.0};
  DenseSolver solver(full(1, 2));
  BOOST_TEST_REQUIRE(solver.factorize(row));
  Eigen::Vector2d x(3.0, 1.0);
  const Eigen::Vector2d x0(0.5, 1.5);
  solver.settle(x.data(), x0.data());
  BOOST_TEST((x - Eigen::Vector2d(1.5, 2.5)).norm() < 1e-15);

  const double regular[] = {1.0, 1.0, 1.0, -1.0};
  DenseSolver determined(full(2, 2));
  BOOST_TEST_REQUIRE(determined.factorize(regular));
  x = Eigen::Vector2d(3.0, 1.0);
  determined.settle(x.data(), x0.data());
  BOOST_TEST((x - Eigen::Vector2d(3.0, 1.0)).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(more_equations_than_unknowns) {
  const double entries[] = {1.0, 1.0};
  DenseSolver solver(full(2, 1));
  BOOST_TEST_REQUIRE(solver.factorize(entries));
  BOOST_TEST(solver.is_determined());
  BOOST_TEST(std::abs(solution(solver, Eigen::Vector2d(1.0, 3.0), 1)[0] - 2.0) < 1e-15);
}

// A matrix of condition 10 whose unknowns and equations are measured in units up to 10^±15: it is
// regular, and solved to the same digits.
BOOST_AUTO_TEST_CASE(units_do_not_make_a_matrix_singular) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-15.0, 15.0);
  for (int trial = 0; trial < 200; ++trial) {
    const Index n = 3 + trial % 6;
    const auto units = [&] {
      return VectorXd(
          VectorXd::NullaryExpr(n, [&] { return std::pow(10.0, exponent(generator)); }));
    };
    const MatrixXd A = 4.0 * MatrixXd::Identity(n, n) +
                       MatrixXd::NullaryExpr(n, n, [&] { return 0.5 * normal(generator); });
    const VectorXd x = VectorXd::NullaryExpr(n, [&] { return normal(generator); });
    const VectorXd row = units(), column = units();
    const MatrixXd scaled = row.asDiagonal() * A * column.asDiagonal();
    DenseSolver solver(full(n, n));
    BOOST_TEST_REQUIRE(solver.factorize(scaled.data()));
    BOOST_TEST(solver.is_determined());
    BOOST_TEST(solver.orientation() != 0);
    const VectorXd found = solution(solver, row.cwiseProduct(A * x), n);
    BOOST_TEST((column.cwiseProduct(found) - x).norm() < 1e-12);
  }
}

// A multiple of another row stays one: A and B A for a B of rank n - 1, in units of any size.
BOOST_AUTO_TEST_CASE(units_do_not_make_a_matrix_regular) {
  std::mt19937 generator(4);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(-12.0, 12.0);
  for (int trial = 0; trial < 200; ++trial) {
    const Index n = 3 + trial % 6;
    MatrixXd A = MatrixXd::NullaryExpr(n, n, [&] { return normal(generator); });
    A.row(n - 1) = A.row(0) - 2.0 * A.row(1);
    for (Index i = 0; i < n; ++i) {
      A.row(i) *= std::exp2(std::round(3.0 * exponent(generator)));
      A.col(i) *= std::exp2(std::round(3.0 * exponent(generator)));
    }
    DenseSolver solver(full(n, n));
    BOOST_TEST_REQUIRE(solver.factorize(A.data()));
    BOOST_TEST(!solver.is_determined());
  }
}

BOOST_AUTO_TEST_CASE(entries_that_are_not_finite) {
  DenseSolver solver(full(1, 1));
  const double one = 1.0, nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(solver.factorize(&one));
  BOOST_TEST(!solver.factorize(&nan));
  BOOST_TEST(!solver.is_determined());
}

BOOST_AUTO_TEST_SUITE_END()
