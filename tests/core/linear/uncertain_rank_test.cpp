#include "courant/core/linear/uncertain_rank.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * scales that small entries mislead lose ranks
//  * a pivot is taken that hides numbers in errors
//  * no scales heed errors
//  * errors times 10⁸ leave the range of doubles
BOOST_AUTO_TEST_SUITE(uncertain_rank_test)

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

class Random {
 public:
  // Entries O(1), half of them zero.
  MatrixXd sparse(Index m, Index n) {
    return MatrixXd::NullaryExpr(m, n,
                                 [&] { return generator_() % 2 == 0 ? 0.0 : normal_(generator_); });
  }
  MatrixXd dense(Index m, Index n) {
    return MatrixXd::NullaryExpr(m, n, [&] { return normal_(generator_); });
  }
  // Powers of two between 2⁻⁴⁰ and 2⁴⁰.
  VectorXd scales(Index n) {
    return VectorXd::NullaryExpr(
        n, [&] { return std::exp2(static_cast<double>(generator_() % 81) - 40.0); });
  }
  Eigen::PermutationMatrix<Eigen::Dynamic> permutation(Index n) {
    Eigen::PermutationMatrix<Eigen::Dynamic> P(n);
    P.setIdentity();
    std::shuffle(P.indices().begin(), P.indices().end(), generator_);
    return P;
  }
  Index below(Index n) { return static_cast<Index>(generator_() % static_cast<unsigned long>(n)); }
  double sign() { return generator_() % 2 == 0 ? 1.0 : -1.0; }

 private:
  std::mt19937 generator_{1};
  std::normal_distribution<double> normal_;
};

// The matrices within E of A, entries within their error left out as the class asks.
UncertainMatrix within(const MatrixXd& A, const MatrixXd& E) {
  const auto is_number = (A.array().abs() > E.array()).eval();
  return {SparseMatrixXd(MatrixXd(is_number.select(A, 0.0)).sparseView()),
          SparseMatrixXd(MatrixXd(is_number.select(E, E + A.cwiseAbs())).sparseView())};
}

UncertainMatrix rounded(const MatrixXd& A, double error) { return within(A, error * A.cwiseAbs()); }

}  // namespace

// R1, R2, R3 on products of known rank, whose entries are as uncertain as their sums make them.
BOOST_AUTO_TEST_CASE(rank_of_products_in_any_order_and_units) {
  Random random;
  for (int trial = 0; trial < 400; ++trial) {
    const Index m = 1 + random.below(12), n = 1 + random.below(12);
    const Index r = random.below(std::min(m, n) + 1);
    const MatrixXd B = random.dense(m, r), C = random.dense(r, n);
    const MatrixXd A = B * C;
    const MatrixXd E = static_cast<double>(r) * eps * (B.cwiseAbs() * C.cwiseAbs());
    const auto check = [&](const MatrixXd& value, const MatrixXd& error) {
      const RankDecision decision = decide_rank(within(value, error));
      BOOST_TEST(decision.rank == r);
      BOOST_TEST(!decision.ambiguous());
    };
    check(A, E);
    check(A.transpose(), E.transpose());
    const auto P = random.permutation(m), Q = random.permutation(n);
    check(P * A * Q, P * E * Q);
    const VectorXd d1 = random.scales(m), d2 = random.scales(n);
    check(d1.asDiagonal() * A * d2.asDiagonal(), d1.asDiagonal() * E * d2.asDiagonal());
  }
}

// Sparse ones in extreme units, of full rank by construction: a triangle, hidden.
BOOST_AUTO_TEST_CASE(triangles_in_any_order_and_units) {
  Random random;
  for (int trial = 0; trial < 200; ++trial) {
    const Index n = 2 + random.below(20);
    MatrixXd A = random.sparse(n, n).triangularView<Eigen::StrictlyUpper>();
    A.diagonal().setOnes();
    A = random.scales(n).asDiagonal() * A * random.scales(n).asDiagonal();
    A = random.permutation(n) * A * random.permutation(n);
    const RankDecision decision = decide_rank(rounded(A, eps));
    BOOST_TEST(decision.rank == n);
    BOOST_TEST(!decision.ambiguous());
  }
}

// The derivative array of two capacitors in parallel, in nonlinear coordinates near rest, without the
// columns of the point: x₁, z₀, x₂, z₁, x₃, z₂ with three x and two z. Rows of order i are O(1) in x_i or
// x_{i+1}, and z_i, and 10⁻¹⁰ in all x before. The fourth row is one of the point alone. Scales that make
// all entries as equal as can be lose two of the other 14.
BOOST_AUTO_TEST_CASE(many_small_entries_hide_no_rank) {
  Random random;
  for (int trial = 0; trial < 50; ++trial) {
    MatrixXd A = MatrixXd::Zero(15, 15);
    const auto x = [&](Index row, Index order, double size) {
      if (order > 0) A.block(row, 5 * (order - 1), 1, 3) = size * random.dense(1, 3);
    };
    for (Index i = 0; i < 3; ++i)
      for (Index row = 0; row < 5; ++row) {
        const bool is_dynamic = row < 2 || row == 4;
        const Index first_small = is_dynamic && row < 2 ? i : i - 1;
        for (Index j = 1; j <= first_small; ++j) x(5 * i + row, j, 1e-10);
        if (is_dynamic) x(5 * i + row, i + 1, 1.0);
        if (row >= 2) x(5 * i + row, i, 1.0);
        if (row < 3) A.block(5 * i + row, 5 * i + 3, 1, 2) = random.dense(1, 2);
      }
    const RankDecision decision = decide_rank(rounded(A, eps));
    BOOST_TEST(decision.rank == 14);
    BOOST_TEST(!decision.ambiguous());
  }
}

// A number is one at any size; noise is none at any size.
BOOST_AUTO_TEST_CASE(size_is_told_by_the_error) {
  MatrixXd A = MatrixXd::Identity(3, 3), E = MatrixXd::Zero(3, 3);
  A(2, 2) = 1e-30;
  BOOST_TEST(decide_rank(within(A, E)).rank == 3);
  E(2, 2) = 2e-30;
  BOOST_TEST(decide_rank(within(A, E)).rank == 2);
  A(2, 2) = 1e-10;
  E(2, 2) = 1e-9;
  BOOST_TEST(decide_rank(within(A, E)).rank == 2);
}

// A zero that is not exact matters where it is divided by a small pivot: with a₁₂ = ±e the rank of
//
//   ( p  e )
//   ( q  s )     is 1 for s = q e / p.
BOOST_AUTO_TEST_CASE(errors_beside_a_pivot_are_carried_along) {
  MatrixXd A(2, 2), E = MatrixXd::Zero(2, 2);
  A << 1e-8, 0.0, 1.0, 1e-9;
  E(0, 1) = 1e-16;
  const RankDecision doubtful = decide_rank(within(A, E));
  BOOST_TEST((doubtful.rank == 1 || doubtful.ambiguous()));
  E(0, 1) = 1e-20;
  const RankDecision certain = decide_rank(within(A, E));
  BOOST_TEST(certain.rank == 2);
  BOOST_TEST(!certain.ambiguous());
}

// A pivot of 6·10⁻⁵ whose row has 0 ± 10⁻³ would bring errors of 10¹³ to a number of 10¹²: another is
// taken first, in any order.
BOOST_AUTO_TEST_CASE(no_pivot_hides_a_number) {
  MatrixXd A(3, 2), E(3, 2);
  A << 1e12, 1e12, 0, -1e12, 0, -6.1e-5;
  E << 4.4e-4, 4.4e-4, 0, 4.4e-4, 1.1e-3, 2.7e-20;
  Random random;
  for (int trial = 0; trial < 20; ++trial) {
    const auto P = random.permutation(3);
    const auto Q = random.permutation(2);
    const RankDecision decision = decide_rank(within(P * A * Q, P * E * Q));
    BOOST_TEST(decision.rank == 2);
    BOOST_TEST(!decision.ambiguous());
    BOOST_TEST(decide_rank(within((P * A * Q).transpose(), (P * E * Q).transpose())).rank == 2);
  }
}

// The second derivatives of √(w₀² - w₁² - w₂²) where w₂ is large: the last row has small entries and an
// error that is large beside them in scales that make them 1.
BOOST_AUTO_TEST_CASE(scales_heed_errors) {
  MatrixXd A(3, 3), E = MatrixXd::Zero(3, 3);
  A << 1.7e-8, 0, 5.8e-18, 0, 1.7e-8, -1.9e-17, 5.8e-18, -1.9e-17, 0;
  E = 1e-15 * A.cwiseAbs();
  E(2, 2) = 5.8e-23;
  const RankDecision decision = decide_rank(within(A, E));
  BOOST_TEST(decision.rank == 2);
  BOOST_TEST(!decision.ambiguous());
  // Bounds near the largest number there is are looked at.
  E(2, 2) = 1e305;
  BOOST_TEST(decide_rank(within(A, E)).rank <= 2);
}

// "At least r" is proven: no matrix within the errors has a lower rank.
BOOST_AUTO_TEST_CASE(every_matrix_of_the_set_has_the_rank) {
  Random random;
  int full = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Index n = 2 + random.below(6);
    const MatrixXd A = random.dense(n, n);
    const SingularValueDecomposition svd = singular_value_decomposition(A);
    // The nearest singular matrix, by a rank-one change; the set contains it, or not.
    const double smallest = svd.values[n - 1];
    const MatrixXd change = smallest * svd.U.col(n - 1) * svd.V.col(n - 1).transpose();
    const RankDecision contains = decide_rank(within(A, change.cwiseAbs()));
    BOOST_TEST((contains.rank < n || contains.ambiguous()));
    const RankDecision away = decide_rank(within(A, 1e-6 * change.cwiseAbs()));
    BOOST_TEST(away.rank == n);
    full += away.ambiguous() ? 0 : 1;
  }
  BOOST_TEST(full == 300);
}

BOOST_AUTO_TEST_CASE(nothing_is_decided_on_what_is_not_finite) {
  MatrixXd A = MatrixXd::Identity(2, 2), E = MatrixXd::Zero(2, 2);
  E(1, 1) = std::numeric_limits<double>::infinity();
  const UncertainMatrix unknown = {SparseMatrixXd(A.sparseView()), SparseMatrixXd(E.sparseView())};
  BOOST_TEST(decide_rank(unknown).ambiguous());
}

// Large blocks go by sparse factorisation: the same ranks.
BOOST_AUTO_TEST_CASE(large_blocks) {
  constexpr Index n = 240;
  // A cycle with one chord: Σ of all rows is zero in exact arithmetic.
  MatrixXd A = MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    for (const auto& [j, weight] : {std::pair((i + 1) % n, 0.7), std::pair((i + 2) % n, 1.3)}) {
      A(i, i) += weight;
      A(j, j) += weight;
      A(i, j) -= weight;
      A(j, i) -= weight;
    }
  }
  const RankDecision singular = decide_rank(rounded(A, 4 * eps));
  BOOST_TEST(singular.rank == n - 1);
  BOOST_TEST(!singular.ambiguous());
  A(0, 0) += 1e-3;
  BOOST_TEST(decide_rank(rounded(A, 4 * eps)).rank == n);
}

// Where the rank is that of all rows, columns that the factorisation drops are no sign of another one.
BOOST_AUTO_TEST_CASE(large_wide_blocks_of_full_rank) {
  constexpr Index n = 240, copies = 40;
  constexpr double error = 1e-10;
  Random random;
  MatrixXd A = MatrixXd::Zero(n, n + copies);
  for (Index i = 0; i < n; ++i) {
    A(i, i) = 1.0;
    A(i, (i + 1) % n) = 0.3;
    A(i, (i + 7) % n) = -0.2;
  }
  A.rightCols(copies) = A.leftCols(copies);
  for (Index j = 0; j < copies; ++j)
    for (Index i = 0; i < n; ++i)
      if (A(i, j) != 0.0) A(i, n + j) += random.sign() * error;
  const RankDecision decision = decide_rank(rounded(A, error));
  BOOST_TEST(decision.rank == n);
  BOOST_TEST(decision.below == 0.0);
  BOOST_TEST(!decision.ambiguous());
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
