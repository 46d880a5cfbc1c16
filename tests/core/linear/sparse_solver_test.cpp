#include "courant/core/linear/sparse_solver.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "courant/core/linear/dense_solver.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/linear/solver_choice.hpp"

// Mistakes that these cases have to notice:
//  * singular matrices are solved as if they were regular
//  * the solution is left in the units of the scaled unknowns
//  * units of rows and columns are forgotten
//  * pivots that were chosen for another matrix are kept when they vanish
//    (core/linear/sparse_lu_klu.cpp)
//  * the determinant has the sign of a permuted matrix (core/linear/sparse_lu_klu.cpp)
//  * or when they are to be forgotten (core/linear/sparse_solver.hpp)
//  * large sparse systems are inverted (core/linear/linear_solver.cpp)
//  * matrices that are solved with once are inverted (core/linear/linear_solver.cpp)
BOOST_AUTO_TEST_SUITE(sparse_solver)

using namespace courant;

namespace {

struct Sparse {
  MatrixPattern pattern;
  std::vector<double> entries;

  void add(Index row, Index column, double entry) {
    pattern.row.push_back(row);
    pattern.column.push_back(column);
    entries.push_back(entry);
  }
  MatrixXd dense() const {
    MatrixXd A = MatrixXd::Zero(pattern.rows, pattern.columns);
    for (std::size_t k = 0; k < entries.size(); ++k)
      A(pattern.row[k], pattern.column[k]) += entries[k];
    return A;
  }
};

// One entry in each row and column, and some more; its rows and columns are in any order.
Sparse random_matrix(Index n, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<Index> place(0, std::max<Index>(0, n - 1));
  std::vector<Index> order(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) order[static_cast<std::size_t>(i)] = i;
  std::shuffle(order.begin(), order.end(), generator);
  Sparse A{{.rows = n, .columns = n, .row = {}, .column = {}}, {}};
  for (Index i = 0; i < n; ++i) {
    A.add(i, order[static_cast<std::size_t>(i)], 3.0 * normal(generator) + 1.0);
    const Index other = place(generator);
    if (other != order[static_cast<std::size_t>(i)]) A.add(i, other, normal(generator));
  }
  return A;
}

VectorXd random_vector(Index n, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return VectorXd::NullaryExpr(n, [&] { return normal(generator); });
}

VectorXd solution(LinearSolver& solver, const VectorXd& b, Index size) {
  VectorXd x(size);
  solver.solve(b.data(), x.data());
  return x;
}

}  // namespace

BOOST_AUTO_TEST_CASE(regular_systems_of_every_size) {
  std::mt19937 generator(1);
  for (const Index n : {0, 1, 2, 3, 5, 8, 13, 50, 200})
    for (int trial = 0; trial < 20; ++trial) {
      Sparse A = random_matrix(n, generator);
      const MatrixXd dense = A.dense();
      const LuDecomposition lu(dense);
      if (lu.pivot_ratio() < 1e-4) continue;
      SparseSolver solver(A.pattern);
      BOOST_TEST_REQUIRE(solver.factorize(A.entries.data()));
      BOOST_TEST(solver.is_determined());
      BOOST_TEST(solver.orientation() == lu.orientation());
      const VectorXd b = random_vector(n, generator);
      BOOST_TEST((dense * solution(solver, b, n) - b).norm() < 1e-9 * (1.0 + b.norm()));
    }
}

// The pivots that were chosen first vanish.
BOOST_AUTO_TEST_CASE(one_matrix_after_the_other) {
  std::mt19937 generator(2);
  const Index n = 40;
  Sparse A = random_matrix(n, generator);
  for (Index i = 0; i < n; ++i) A.add(i, (i + 1) % n, 0.0);
  SparseSolver solver(A.pattern);
  for (int trial = 0; trial < 50; ++trial) {
    for (double& entry : A.entries) entry = std::pow(random_vector(1, generator)[0], 5.0);
    const MatrixXd dense = A.dense();
    const LuDecomposition lu(dense);
    BOOST_TEST_REQUIRE(solver.factorize(A.entries.data()));
    if (lu.pivot_ratio() < 1e-6) continue;
    BOOST_TEST(solver.orientation() == lu.orientation());
    const VectorXd x = random_vector(n, generator);
    BOOST_TEST((solution(solver, dense * x, n) - x).norm() < 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(units_do_not_make_a_matrix_singular) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> exponent(-6.0, 6.0);
  const Index n = 30;
  for (int trial = 0; trial < 50; ++trial) {
    Sparse A{{.rows = n, .columns = n, .row = {}, .column = {}}, {}};
    for (Index i = 0; i < n; ++i) {
      A.add(i, i, 4.0);
      A.add(i, (7 * i + 3) % n, 0.5 * random_vector(1, generator)[0]);
    }
    const MatrixXd dense = A.dense();
    const auto units = [&] {
      return VectorXd(
          VectorXd::NullaryExpr(n, [&] { return std::pow(10.0, exponent(generator)); }));
    };
    const VectorXd x = random_vector(n, generator), row = units(), column = units();
    std::vector<double> scaled = A.entries;
    for (std::size_t k = 0; k < scaled.size(); ++k)
      scaled[k] *= row[A.pattern.row[k]] * column[A.pattern.column[k]];
    SparseSolver solver(A.pattern);
    BOOST_TEST_REQUIRE(solver.factorize(scaled.data()));
    BOOST_TEST(solver.orientation() != 0);
    const VectorXd found = solution(solver, row.cwiseProduct(dense * x), n);
    BOOST_TEST((column.cwiseProduct(found) - x).norm() < 1e-11);
  }
}

// An equation that is said twice, an unknown in no equation, more equations than unknowns, and potentials of a ring of
// conductances, whose last pivot is round-off.
BOOST_AUTO_TEST_CASE(what_is_not_regular_is_solved_as_dense_solver_does) {
  std::mt19937 generator(4);
  const Index n = 30;
  Sparse twice = random_matrix(n, generator), missing = twice, tall = twice;
  for (std::size_t k = 0; k < twice.entries.size(); ++k) {
    if (twice.pattern.row[k] == 1) twice.entries[k] = 0.0;
    if (missing.pattern.column[k] == 4) missing.entries[k] = 0.0;
  }
  for (std::size_t k = 0, size = twice.entries.size(); k < size; ++k)
    if (twice.pattern.row[k] == 0) twice.add(1, twice.pattern.column[k], 2.0 * twice.entries[k]);
  tall.pattern.rows = n + 1;
  tall.add(n, 0, 1.0);
  Sparse ring{{.rows = n, .columns = n, .row = {}, .column = {}}, {}};
  const VectorXd conductance = random_vector(n, generator).cwiseAbs().array() + 0.1;
  for (Index i = 0; i < n; ++i) {
    const Index next = (i + 1) % n;
    ring.add(i, i, conductance[i] + conductance[next]);
    ring.add(i, next, -conductance[next]);
    ring.add(next, i, -conductance[next]);
  }
  for (const Sparse& A : {twice, missing, tall, ring}) {
    SparseSolver sparse(A.pattern);
    DenseSolver dense(A.pattern);
    const bool is_tall = A.pattern.rows > n;
    BOOST_TEST_REQUIRE(sparse.factorize(A.entries.data()));
    BOOST_TEST_REQUIRE(dense.factorize(A.entries.data()));
    BOOST_TEST(sparse.is_determined() == is_tall);
    BOOST_TEST(dense.is_determined() == is_tall);
    BOOST_TEST(sparse.orientation() == 0);
    const VectorXd b = random_vector(A.pattern.rows, generator);
    BOOST_TEST((solution(sparse, b, n) - solution(dense, b, n)).norm() == 0.0);
    VectorXd x = random_vector(n, generator), y = x;
    const VectorXd x0 = random_vector(n, generator);
    sparse.settle(x.data(), x0.data());
    dense.settle(y.data(), x0.data());
    BOOST_TEST((x - y).norm() == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(entries_that_are_not_finite) {
  const MatrixPattern pattern{.rows = 1, .columns = 1, .row = {0}, .column = {0}};
  SparseSolver solver(pattern);
  BOOST_TEST(!solver.is_determined());
  const double one = 1.0, nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(solver.factorize(&one));
  BOOST_TEST(solver.is_determined());
  BOOST_TEST(!solver.factorize(&nan));
  BOOST_TEST(!solver.is_determined());
}

BOOST_AUTO_TEST_CASE(the_faster_one_is_taken) {
  const auto chain = [](Index n) {
    MatrixPattern pattern{.rows = n, .columns = n, .row = {}, .column = {}};
    for (Index i = 0; i < n; ++i)
      for (const Index j : {i, (i + 1) % n}) {
        pattern.row.push_back(i);
        pattern.column.push_back(j);
      }
    return pattern;
  };
  const auto is_sparse_solver = [](const std::unique_ptr<LinearSolver>& solver) {
    return dynamic_cast<SparseSolver*>(solver.get()) != nullptr;
  };
  const auto is_sparse = [&](const MatrixPattern& pattern) {
    return is_sparse_solver(linear_solver(pattern));
  };
  const auto is_briefly_sparse = [&](const MatrixPattern& pattern) {
    return is_sparse_solver(brief_linear_solver(pattern));
  };
  BOOST_TEST(is_sparse(chain(1000)));
  BOOST_TEST(!is_sparse(chain(10)));
  MatrixPattern tall = chain(1000);
  tall.rows += 1;
  BOOST_TEST(!is_sparse(tall));
  MatrixPattern full{.rows = 100, .columns = 100, .row = {}, .column = {}};
  for (Index k = 0; k < 10000; ++k) {
    full.row.push_back(k % 100);
    full.column.push_back(k / 100);
  }
  BOOST_TEST(!is_sparse(full));
  // An inverse of fifty rows pays if it is multiplied with many times.
  BOOST_TEST(!is_sparse(chain(50)));
  BOOST_TEST(is_briefly_sparse(chain(50)));
  BOOST_TEST(!is_briefly_sparse(chain(6)));
  BOOST_TEST(!is_briefly_sparse(full));
}

// Pivots that an earlier matrix chose are no part of what is known of this one.
BOOST_AUTO_TEST_CASE(what_was_forgotten_leaves_no_trace) {
  constexpr Eigen::Index n = 40;
  std::vector<double> first, second;
  MatrixPattern pattern{n, n, {}, {}};
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  for (Eigen::Index j = 0; j < n; ++j)
    for (const Eigen::Index i : {j, (j + 1) % n, (7 * j + 3) % n}) {
      pattern.row.push_back(i);
      pattern.column.push_back(j);
      first.push_back((i == j ? 1e-6 : 1.0) * normal(generator));
      second.push_back(normal(generator));
    }
  const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(n, [&] { return normal(generator); });
  const auto solution = [&](LinearSolver& solver) {
    BOOST_TEST_REQUIRE(solver.factorize(second.data()));
    Eigen::VectorXd x(n);
    solver.solve(b.data(), x.data());
    return x;
  };
  SparseSolver fresh(pattern), kept(pattern), forgetful(pattern);
  const Eigen::VectorXd x = solution(fresh);
  for (SparseSolver* solver : {&kept, &forgetful})
    BOOST_TEST_REQUIRE(solver->factorize(first.data()));
  forgetful.forget();
  BOOST_TEST((solution(forgetful) == x));
  // KLU keeps its pivots otherwise, and rounds by them.
  BOOST_TEST((solution(kept) - x).norm() < 1e-9 * x.norm());
}

BOOST_AUTO_TEST_SUITE_END()
