#include "courant/core/linear/sparse_rank_decision.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "courant/core/linear/fundamental_subspaces.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(sparse_rank_decision_test)

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

SparseMatrixXd sparse(Index m, Index n, const Triplets& triplets) {
  SparseMatrixXd A(m, n);
  A.setFromTriplets(triplets.begin(), triplets.end());
  return A;
}

// The incidence matrix of a grid of k × k nodes: rank k² - 1.
SparseMatrixXd grid_incidence(int k) {
  Triplets triplets;
  int edge = 0;
  const auto connect = [&](int a, int b) {
    triplets.emplace_back(a, edge, 1.0);
    triplets.emplace_back(b, edge++, -1.0);
  };
  for (int i = 0; i < k; ++i) {
    for (int j = 0; j < k; ++j) {
      if (i + 1 < k) connect(i * k + j, (i + 1) * k + j);
      if (j + 1 < k) connect(i * k + j, i * k + j + 1);
    }
  }
  return sparse(k * k, edge, triplets);
}

}  // namespace

BOOST_AUTO_TEST_CASE(agrees_with_the_dense_decision) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    const Index m = static_cast<Index>(generator() % 30), n = static_cast<Index>(generator() % 30);
    // Few entries, and some rows and columns twice: ranks of all kinds.
    MatrixXd A = MatrixXd::NullaryExpr(
        m, n, [&] { return generator() % 8 == 0 ? uniform(generator) : 0.0; });
    for (Index i = 0; i + 1 < m; i += 3) A.row(i + 1) = 2.0 * A.row(i);
    for (Index j = 0; j + 2 < n; j += 5) A.col(j + 2) = A.col(j) - A.col(j + 1);
    const RankDecision dense = decide_rank(A);
    const RankDecision decision = decide_rank(SparseMatrixXd(A.sparseView()));
    BOOST_TEST(decision.rank == dense.rank);
    BOOST_TEST(decision.rows == m);
    BOOST_TEST(decision.columns == n);
    // The gap is an underestimate, up to the accuracy of the inverse iteration, and not an idle
    // one.
    BOOST_TEST(decision.gap < 1.1 * dense.gap);
    BOOST_TEST_INFO(dense << " " << decision);
    BOOST_TEST(!decision.ambiguous());
  }
}

BOOST_AUTO_TEST_CASE(does_not_depend_on_units) {
  std::mt19937 generator(3);
  const SparseMatrixXd A = grid_incidence(12);
  const auto scales = [&](Index n) {
    return VectorXd(VectorXd::NullaryExpr(
        n, [&] { return std::pow(1e6, static_cast<int>(generator() % 3) - 1); }));
  };
  for (int trial = 0; trial < 5; ++trial) {
    const SparseMatrixXd scaled = scales(A.rows()).asDiagonal() * A * scales(A.cols()).asDiagonal();
    BOOST_TEST(decide_rank(scaled).rank == 143);
    BOOST_TEST(!decide_rank(scaled).ambiguous());
  }
}

BOOST_AUTO_TEST_CASE(rank_of_an_incidence_matrix) {
  const RankDecision decision = decide_rank(grid_incidence(50));
  BOOST_TEST(decision.rank == 2499);
  BOOST_TEST(!decision.ambiguous());
  // σ_r = 2 sin(π/100)·…: the square root of the second eigenvalue of the grid's Laplacian.
  BOOST_TEST(decision.above > 1e-3);
}

// Triangular with ones on the diagonal, and singular to working precision: QR, which looks at its
// diagonal, finds nothing; the singular values do. (Kahan's example.)
BOOST_AUTO_TEST_CASE(sees_a_singular_matrix_that_hides_from_qr) {
  const int n = 150;
  const double c = 0.6, s = 0.8;
  Triplets triplets;
  for (int i = 0; i < n; ++i) {
    triplets.emplace_back(i, i, std::pow(s, i));
    for (int j = i + 1; j < n; ++j) triplets.emplace_back(i, j, -c * std::pow(s, i));
  }
  const SparseMatrixXd kahan = sparse(n, n, triplets);
  const RankDecision dense = decide_rank(MatrixXd(kahan));
  const RankDecision decision = decide_rank(kahan);
  BOOST_TEST(dense.rank == n - 1);
  BOOST_TEST(decision.rank == n - 1);
  BOOST_TEST(decision.below < 1e-11);
}

BOOST_AUTO_TEST_CASE(knows_empty_and_zero_matrices) {
  for (const auto& [m, n] : {std::pair<Index, Index>{0, 0}, {0, 4}, {4, 0}, {3, 5}}) {
    BOOST_TEST(decide_rank(SparseMatrixXd(m, n)).rank == 0);
    BOOST_TEST(!decide_rank(SparseMatrixXd(m, n)).ambiguous());
  }
  BOOST_TEST(decide_rank(sparse(4, 5, {{1, 2, 1e-200}, {3, 0, 1e200}})).rank == 2);
  BOOST_CHECK_THROW(decide_rank(sparse(1, 1, {{0, 0, std::numeric_limits<double>::quiet_NaN()}})),
                    std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
