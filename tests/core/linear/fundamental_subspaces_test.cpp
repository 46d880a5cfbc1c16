#include "courant/core/linear/fundamental_subspaces.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>

#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/linear/sparse_rank_decision.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(fundamental_subspaces_test)

namespace {

class Random {
 public:
  MatrixXd matrix(Index m, Index n) {
    return MatrixXd::NullaryExpr(m, n, [&] { return normal_(generator_); });
  }
  MatrixXd matrix(Index m, Index n, Index rank) { return matrix(m, rank) * matrix(rank, n); }
  // Entries O(1), about half of them zero.
  MatrixXd sparse(Index m, Index n) {
    return matrix(m, n).unaryExpr([&](double a) { return below(2) == 0 ? 0.0 : a; });
  }
  // Each one of 10⁻⁶, 1, 10⁶.
  VectorXd scales(Index n) {
    return VectorXd::NullaryExpr(n, [&] { return std::pow(1e6, below(3) - 1); });
  }
  Eigen::PermutationMatrix<Eigen::Dynamic> permutation(Index n) {
    Eigen::PermutationMatrix<Eigen::Dynamic> P(n);
    P.setIdentity();
    std::shuffle(P.indices().begin(), P.indices().end(), generator_);
    return P;
  }
  int below(Index n) { return static_cast<int>(generator_() % static_cast<unsigned long>(n)); }

 private:
  std::mt19937 generator_{1};
  std::normal_distribution<double> normal_;
};

double orthogonality_defect(const MatrixXd& Q) {
  return (Q.transpose() * Q - MatrixXd::Identity(Q.cols(), Q.cols())).norm();
}

// max |AB|_ij / (|A||B|)_ij: how well A annihilates B, whatever the scales.
double relative_product(const MatrixXd& A, const MatrixXd& B) {
  if (A.rows() == 0 || B.cols() == 0) return 0.0;
  const MatrixXd bound = A.cwiseAbs() * B.cwiseAbs();
  return (bound.array() > 0.0).select((A * B).array().abs() / bound.array(), 0.0).maxCoeff();
}

}  // namespace

BOOST_AUTO_TEST_CASE(finds_the_rank_of_products) {
  Random random;
  for (int trial = 0; trial < 1000; ++trial) {
    const Index m = random.below(13), n = random.below(13);
    const Index r = random.below(std::min(m, n) + 1);
    const RankDecision decision = decide_rank(random.matrix(m, n, r));
    BOOST_TEST(decision.rank == r);
    BOOST_TEST(decision.nullity() == n - r);
    BOOST_TEST(!decision.ambiguous());
    BOOST_TEST(decision.singular_values.size() == std::min(m, n));
    BOOST_TEST((r == 0 || decision.above > decision.threshold));
    BOOST_TEST(decision.below <= decision.threshold);
  }
}

BOOST_AUTO_TEST_CASE(does_not_depend_on_units_or_order) {
  Random random;
  for (int trial = 0; trial < 500; ++trial) {
    const Index m = 1 + random.below(12), n = 1 + random.below(12);
    const Index r = random.below(std::min(m, n) + 1);
    const MatrixXd A = trial % 2 == 0 ? random.matrix(m, n, r) : random.sparse(m, n);
    const Index rank = decide_rank(A).rank;
    const MatrixXd scaled = random.scales(m).asDiagonal() * A * random.scales(n).asDiagonal();
    const MatrixXd permuted = random.permutation(m) * A * random.permutation(n);
    BOOST_TEST(decide_rank(scaled).rank == rank);
    BOOST_TEST(decide_rank(permuted).rank == rank);
    BOOST_TEST(decide_rank(A.transpose()).rank == rank);
    BOOST_TEST(decide_rank(scaled).ambiguous() == decide_rank(A).ambiguous());
  }
}

// The large entries of two rows share a column: with maxima alone for scales, σ₃ falls with x.
BOOST_AUTO_TEST_CASE(sees_through_scales_that_maxima_do_not_show) {
  for (const double x : {1.0, 1e-6, 1e-12}) {
    const MatrixXd A{{1, 1 * x, 2 * x}, {1, 3 * x, -1 * x}, {0, 1, 1}};
    const RankDecision decision = decide_rank(A);
    BOOST_TEST(decision.rank == 3);
    BOOST_TEST(decision.above > 0.1);
  }
}

// cos(π/2) = 6e-17 in place of 0: scaled up like a number it would make the rank 3.
BOOST_AUTO_TEST_CASE(takes_rounding_noise_next_to_numbers_for_zero) {
  const MatrixXd A{{1, 1, 0}, {1, 1, std::cos(std::numbers::pi / 2)}, {0, 0, 1}};
  BOOST_TEST(decide_rank(A).rank == 2);
  BOOST_TEST(!decide_rank(A).ambiguous());
}

BOOST_AUTO_TEST_CASE(believes_exact_data_down_to_rounding) {
  for (const double small : {1e-3, 1e-6, 1e-9}) {
    const RankDecision decision = decide_rank(MatrixXd{{1, 1}, {1, 1 + small}});
    BOOST_TEST(decision.rank == 2);
    BOOST_TEST(!decision.ambiguous());
  }
  // Fifty roundings are noise rather than a number, with so wide a gap above.
  BOOST_TEST(decide_rank(MatrixXd{{1, 1}, {1, 1 + 1e-13}}).rank == 1);
}

BOOST_AUTO_TEST_CASE(discounts_the_error_of_the_data) {
  Random random;
  const RankOptions options{.data_error = 1e-8};
  for (int trial = 0; trial < 200; ++trial) {
    const Index n = 2 + random.below(11);
    const Index r = 1 + random.below(n - 1);
    MatrixXd A = random.matrix(n, n, r);
    A += 1e-9 * A.cwiseProduct(random.matrix(n, n));
    BOOST_TEST(decide_rank(A, options).rank == r);
    // The control: errors are numbers if nobody says that they are errors.
    BOOST_TEST(decide_rank(A).rank == n);
  }
  // Next to entries good to 1e-8, 1e-4 is a number, and of 1e-7 nobody knows.
  const auto almost_singular = [](double x) { return MatrixXd{{1, 1}, {1, 1 + x}}; };
  BOOST_TEST(decide_rank(almost_singular(1e-4), options).rank == 2);
  BOOST_TEST(!decide_rank(almost_singular(1e-4), options).ambiguous());
  BOOST_TEST(decide_rank(almost_singular(2e-5), options).ambiguous());
  BOOST_TEST(decide_rank(almost_singular(1e-7), options).rank == 1);
}

// A block of an orthogonal matrix that should be zero: its rounding errors are no numbers.
BOOST_AUTO_TEST_CASE(knows_noise_by_its_magnitude) {
  Random random;
  const MatrixXd noise = 1e-16 * random.matrix(4, 3);
  BOOST_TEST(decide_rank(noise).rank == 3);
  BOOST_TEST(decide_rank(noise, {.magnitude = 1.0}).rank == 0);
  BOOST_TEST(FundamentalSubspaces(noise, {.magnitude = 1.0}).kernel().cols() == 3);
  BOOST_TEST(!decide_rank(noise, {.magnitude = 1.0}).ambiguous());
  BOOST_TEST(decide_rank(noise, {.data_error = 1e-8, .magnitude = 1e-17}).rank == 3);
  BOOST_TEST(decide_rank(1e-9 * random.matrix(4, 3), {.magnitude = 1.0}).rank == 3);
  BOOST_TEST(decide_rank(SparseMatrixXd(noise.sparseView(0.0, 0.0)), {.magnitude = 1.0}).rank == 0);
  BOOST_TEST(
      decide_rank(SparseMatrixXd(random.matrix(4, 3).sparseView()), {.magnitude = 1.0}).rank == 3);
}

BOOST_AUTO_TEST_CASE(says_when_it_is_ambiguous) {
  // Singular values 10⁰, 10⁻¹, … 10⁻¹⁶ leave no gap anywhere.
  Random random;
  const MatrixXd U = orthonormalized(random.matrix(17, 17));
  const MatrixXd V = orthonormalized(random.matrix(17, 17));
  const VectorXd sigma = VectorXd::NullaryExpr(17, [](Index k) { return std::pow(10.0, -k); });
  const RankDecision decision = decide_rank(U * sigma.asDiagonal() * V);
  BOOST_TEST(decision.ambiguous());
  std::ostringstream text;
  text << decision;
  BOOST_TEST(text.str().ends_with(", ambiguous"));
}

BOOST_AUTO_TEST_CASE(knows_empty_and_zero_matrices) {
  for (const auto& [m, n] : {std::pair<Index, Index>{0, 0}, {0, 4}, {4, 0}, {1, 1}, {3, 5}}) {
    const MatrixXd zero = MatrixXd::Zero(m, n);
    BOOST_TEST(decide_rank(zero).rank == 0);
    BOOST_TEST(!decide_rank(zero).ambiguous());
    BOOST_TEST(std::isfinite(decide_rank(zero).gap));
    const FundamentalSubspaces subspaces(zero);
    BOOST_TEST(subspaces.kernel().cols() == n);
    BOOST_TEST(subspaces.left_kernel().cols() == m);
    BOOST_TEST(subspaces.range().rows() == m);
    BOOST_TEST(subspaces.row_space().rows() == n);
    BOOST_TEST(subspaces.pseudo_solve(MatrixXd::Ones(m, 2)).rows() == n);
  }
  MatrixXd A = MatrixXd::Zero(4, 5);
  A(1, 2) = 1e-200;
  A(3, 0) = 1e200;
  BOOST_TEST(decide_rank(A).rank == 2);
}

BOOST_AUTO_TEST_CASE(refuses_what_is_not_a_number) {
  MatrixXd A = MatrixXd::Identity(3, 3);
  A(2, 1) = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_THROW(decide_rank(A), std::domain_error);
  A(2, 1) = std::numeric_limits<double>::infinity();
  BOOST_CHECK_THROW(FundamentalSubspaces{A}, std::domain_error);
}

BOOST_AUTO_TEST_CASE(prints_one_line) {
  std::ostringstream text;
  text << decide_rank(MatrixXd::Identity(2, 3));
  BOOST_TEST(text.str() == "rank 2 of 2 × 3, gap 1.5e+15 (1 | 0, threshold 2.6e-08)");
}

BOOST_AUTO_TEST_CASE(fundamental_subspaces_are_those_of_the_matrix_itself) {
  Random random;
  for (int trial = 0; trial < 500; ++trial) {
    const Index m = random.below(13), n = random.below(13);
    const Index r = random.below(std::min(m, n) + 1);
    MatrixXd A = random.matrix(m, n, r);
    if (trial % 2 == 1) A = random.scales(m).asDiagonal() * A * random.scales(n).asDiagonal();
    const FundamentalSubspaces subspaces(A);
    BOOST_TEST(subspaces.rank() == r);
    BOOST_TEST(subspaces.kernel().cols() == n - r);
    BOOST_TEST(subspaces.left_kernel().cols() == m - r);
    BOOST_TEST(relative_product(A, subspaces.kernel()) < 1e-13);
    BOOST_TEST(relative_product(subspaces.left_kernel().transpose(), A) < 1e-13);
    MatrixXd rows(n, n), columns(m, m);
    rows << subspaces.row_space(), subspaces.kernel();
    columns << subspaces.range(), subspaces.left_kernel();
    BOOST_TEST(orthogonality_defect(rows) < 1e-13);
    BOOST_TEST(orthogonality_defect(columns) < 1e-13);
    BOOST_TEST((kernel(A) - subspaces.kernel()).norm() == 0.0);
    BOOST_TEST((range(A) - subspaces.range()).norm() == 0.0);
  }
}

// The four equations of Penrose, and that a wrong inverse fails them.
BOOST_AUTO_TEST_CASE(pseudo_inverse) {
  Random random;
  for (int trial = 0; trial < 200; ++trial) {
    const Index m = 1 + random.below(8), n = 1 + random.below(8);
    const Index r = random.below(std::min(m, n) + 1);
    const MatrixXd A = random.matrix(m, n, r);
    const MatrixXd X = FundamentalSubspaces(A).pseudo_solve(MatrixXd::Identity(m, m));
    const double scale = 1.0 + A.norm() * X.norm();
    BOOST_TEST((A * X * A - A).norm() < 1e-12 * scale * scale);
    BOOST_TEST((X * A * X - X).norm() <= 1e-12 * scale * scale * X.norm());
    BOOST_TEST((A * X - (A * X).transpose()).norm() < 1e-12 * scale);
    BOOST_TEST((X * A - (X * A).transpose()).norm() < 1e-12 * scale);
    if (r > 0) BOOST_TEST((A * (2.0 * X) * A - A).norm() > 0.1 * A.norm());
  }
  BOOST_CHECK_THROW(FundamentalSubspaces(MatrixXd::Ones(3, 2)).pseudo_solve(MatrixXd::Ones(2, 1)),
                    std::invalid_argument);
}

// [Q 0; noise N], [Q N] orthogonal, N with a small entry: next to it rounding of 3e-17 is above
// what counts as zero. Equilibrated like a number it leaves 2 digits of the range.
BOOST_AUTO_TEST_CASE(noise_beside_a_small_number_does_not_spoil_the_subspaces) {
  Random random;
  const VectorXd N = VectorXd{{-2e-3, -0.6, 0.6, -0.5}}.normalized();
  const MatrixXd Q = FundamentalSubspaces(N).left_kernel();
  MatrixXd A = MatrixXd::Zero(8, 4);
  A << Q, VectorXd::Zero(4), 4e-17 * random.matrix(4, 3), N;
  for (const MatrixXd& B : {A, MatrixXd(A.transpose())}) {
    const FundamentalSubspaces subspaces(B);
    BOOST_TEST(subspaces.rank() == 4);
    BOOST_TEST((subspaces.left_kernel().transpose() * B).norm() < 1e-13);
    BOOST_TEST((B * subspaces.kernel()).norm() < 1e-13);
    BOOST_TEST(orthogonality_defect(subspaces.range()) < 1e-14);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
