#include "courant/core/solve/contraction.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "../random_matrix.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/small_product.hpp"
#include "courant/core/linear/static_size.hpp"

// Mistakes that these cases have to notice:
//  * a matrix that contracts badly is gone on with
//  * the change before is that of after learning
//  * the last of an odd number of columns is left out (core/linear/small_product.hpp)
BOOST_AUTO_TEST_SUITE(contraction_test)

using namespace courant;

namespace {

// F(u; J, b) = J u + ε u³ - b, entry by entry, with an inverse of J that is wrong by `wrong`.
struct Problem {
  Problem(Index count, double wrong)
      : n(count), u(VectorXd::Zero(n)), residual(n), change(n), before(n) {
    const Graph graph;
    const ExprVector y = graph.variables("u", n), entries = graph.variables("J", n * n),
                     right = graph.variables("b", n);
    ExprVector F(n);
    for (Index i = 0; i < n; ++i) {
      F[i] = 0.01 * y[i] * y[i] * y[i] - right[i];
      for (Index j = 0; j < n; ++j) F[i] += entries[i + n * j] * y[j];
    }
    function = Function("F", {{"u", y}, {"J", entries}, {"b", right}}, F);
    J = 2.0 * MatrixXd::Identity(n, n) + 0.3 * random_matrix(n, n, 1);
    b = random_matrix(n, 1, 2);
    A = LuDecomposition(J).inverse() + wrong * random_matrix(n, n, 3);
  }

  Contraction::Result solve(
      double tolerance = 1e-17, int most = 60,
      Contraction::Instructions instructions = Contraction::Instructions::best) {
    const Contraction contraction(n, instructions);
    BOOST_TEST_REQUIRE(contraction.is_available());
    return contraction(
        function, Inputs(u.data(), {J.data(), b.data()}), workspace(),
        {.scale = 1.0, .tolerance = tolerance, .slow = 0.2, .most = most, .is_exact = false});
  }
  Contraction::Workspace workspace() {
    return {.inverse = A.data(),
            .u = u.data(),
            .residual = residual.data(),
            .change = change.data(),
            .before = before.data()};
  }
  double defect() const {
    return (J * u + 0.01 * u.array().cube().matrix() - b).lpNorm<Eigen::Infinity>();
  }

  Index n;
  Function function;
  MatrixXd J, A;
  VectorXd b, u, residual, change, before;
};

}  // namespace

BOOST_AUTO_TEST_CASE(finds_the_root_for_each_size) {
  for (Index n = 1; n <= 8; ++n) {
    Problem problem(n, 0.01);
    const Contraction::Result result = problem.solve(1e-15);
    BOOST_TEST(result.has_converged);
    BOOST_TEST(problem.defect() < 1e-15 * static_cast<double>(n));
    BOOST_TEST(result.moved < 1e-12);
    BOOST_TEST(result.size == std::max(1.0, problem.u.lpNorm<Eigen::Infinity>()));
    BOOST_TEST(result.iterations > 3);
  }
  BOOST_TEST(!Contraction(0).is_available());
  BOOST_TEST(!Contraction(9).is_available());
  BOOST_TEST(!Contraction().is_available());
}

// Programs in C are compiled without the instructions of one processor, and runs go on where others ended.
BOOST_AUTO_TEST_CASE(all_instructions_give_the_same_bits) {
  for (Index n = 1; n <= 8; ++n) {
    Problem best(n, 0.1), plain(n, 0.1);
    const Contraction::Result of_best = best.solve(1e-15);
    const Contraction::Result of_plain = plain.solve(1e-15, 60, Contraction::Instructions::plain);
    BOOST_TEST(of_best.iterations == of_plain.iterations);
    BOOST_TEST(of_best.has_learned == of_plain.has_learned);
    BOOST_TEST((best.u.array() == plain.u.array()).all());
    BOOST_TEST((best.A.array() == plain.A.array()).all());
  }
}

// One change is A F to the last bit of another order of sums.
BOOST_AUTO_TEST_CASE(one_change) {
  for (Index n = 1; n <= 8; ++n) {
    Problem problem(n, 0.1);
    problem.residual = random_matrix(n, 1, 5);
    problem.u = random_matrix(n, 1, 6);
    const VectorXd expected = problem.A * problem.residual, u = problem.u - expected;
    double size = 0.0;
    const double largest = Contraction(n).improve(problem.workspace(), size);
    BOOST_TEST((problem.change - expected).norm() < 1e-15);
    BOOST_TEST((problem.u - u).norm() < 1e-15);
    BOOST_TEST(std::fabs(largest - expected.lpNorm<Eigen::Infinity>()) < 1e-15);
    BOOST_TEST(std::fabs(size - u.lpNorm<Eigen::Infinity>()) < 1e-15);
    problem.residual[n - 1] = std::numeric_limits<double>::quiet_NaN();
    BOOST_TEST(Contraction(n).improve(problem.workspace(), size) ==
               std::numeric_limits<double>::infinity());
  }
}

// Sums of even and of odd columns, whose bits programs in C rely on.
BOOST_AUTO_TEST_CASE(small_products_add_up_even_and_odd_columns) {
  for (Index n = 1; n <= 8; ++n) {
    const MatrixXd A = random_matrix(n, n, 7);
    const VectorXd b = random_matrix(n, 1, 8);
    VectorXd product(n);
    with_static_size(n, [&](auto size) {
      if constexpr (decltype(size)::value != Eigen::Dynamic)
        product = small_product<decltype(size)::value>(A.data(), b.data()).matrix();
      return 0;
    });
    for (Index i = 0; i < n; ++i) {
      double even = A(i, 0) * b[0], odd = n > 1 ? A(i, 1) * b[1] : 0.0;
      for (Index j = 2; j < n; ++j) (j % 2 == 0 ? even : odd) += A(i, j) * b[j];
      BOOST_TEST(product[i] == (n > 1 ? even + odd : even));
    }
  }
}

// A matrix that contracts badly is given up after the change that shows it, with both changes told.
BOOST_AUTO_TEST_CASE(bad_contraction_ends_it) {
  Problem problem(4, 0.0);
  problem.A *= 0.5;  // contraction 1/2
  const Contraction::Result result = problem.solve();
  BOOST_TEST(!result.has_converged);
  BOOST_TEST(result.iterations == 2);
  BOOST_TEST(std::fabs(result.moved / result.previous - 0.5) < 0.02);
  BOOST_TEST(!result.has_learned);
  BOOST_TEST((problem.before - 2.0 * problem.change).norm() < 0.05 * problem.before.norm());
}

BOOST_AUTO_TEST_CASE(what_is_not_finite_ends_it) {
  Problem problem(3, 0.0);
  problem.b[1] = std::numeric_limits<double>::infinity();
  const Contraction::Result result = problem.solve();
  BOOST_TEST(!result.has_converged);
  BOOST_TEST(result.iterations == 1);
  BOOST_TEST(!(result.moved <= std::numeric_limits<double>::max()));
}

BOOST_AUTO_TEST_CASE(iterations_are_limited) {
  Problem problem(5, 0.01);
  const Contraction::Result result = problem.solve(1e-17, 2);
  BOOST_TEST(!result.has_converged);
  BOOST_TEST(result.iterations == 2);
}

// The inverse learns once a solve, so that the next solves take fewer iterations than with the matrix as it was.
BOOST_AUTO_TEST_CASE(the_inverse_learns) {
  Problem learning(6, 0.02);
  const MatrixXd as_it_was = learning.A;
  int with = 0, without = 0;
  for (int k = 0; k < 12; ++k) {
    Problem fixed(6, 0.0);
    fixed.A = as_it_was;
    const VectorXd b = random_matrix(6, 1, 20);
    learning.b = fixed.b = b * (1.0 + 0.01 * k);
    learning.u.setZero();
    const Contraction::Result result = learning.solve();
    BOOST_TEST(result.has_learned);
    BOOST_TEST((learning.A - as_it_was).norm() > 1e-6);
    with += result.iterations;
    without += fixed.solve().iterations;
  }
  BOOST_TEST(with < without);
}

// A short change after a long one may be an accident.
BOOST_AUTO_TEST_CASE(when_changes_have_ended) {
  using contraction::has_ended;
  BOOST_TEST(has_ended(9e-16, 1e-13, 1e-17));
  BOOST_TEST(!has_ended(2e-15, 1e-13, 1e-17));
  BOOST_TEST(!has_ended(1e-17, 0.02, 1e-3));   // the one before was long
  BOOST_TEST(!has_ended(0.6e-9, 1e-9, 1e-3));  // hardly shorter
  BOOST_TEST(!has_ended(1e-13, 5e-3, 1e-17));  // a contraction below the length of the one before
  BOOST_TEST(!has_ended(std::nan(""), 1e-9, 1e-3));
  BOOST_TEST(contraction::relative(0.0, 0.0) == 0.0);
  BOOST_TEST(contraction::relative(2.0, 0.0) == 1.0);
  BOOST_TEST(contraction::relative(1.0, 4.0) == 0.25);
}

BOOST_AUTO_TEST_SUITE_END()
