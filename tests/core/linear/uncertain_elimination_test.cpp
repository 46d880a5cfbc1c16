#include "courant/core/linear/uncertain_elimination.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "courant/core/linear/uncertain_rank.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * errors of other entries hide a small pivot (core/linear/uncertain_rank.cpp)
//  * a pivot that may be zero counts
//  * elimination forgets errors of entries that are zero within them
BOOST_AUTO_TEST_SUITE(uncertain_elimination_test)

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

UncertainMatrix within(const MatrixXd& A, const MatrixXd& E) {
  const auto is_number = (A.array().abs() > E.array()).eval();
  return {SparseMatrixXd(MatrixXd(is_number.select(A, 0.0)).sparseView()),
          SparseMatrixXd(MatrixXd(is_number.select(E, E + A.cwiseAbs())).sparseView())};
}

// [P B; 0 Q] with P = [1 1; 1 1+η], Q = [1 1; 1 -1] exact, and B of ones that are known to δ.
UncertainMatrix coupled(double eta, double delta) {
  MatrixXd A = MatrixXd::Zero(4, 4), E = A;
  A << 1, 1, 1, 1,       //
      1, 1 + eta, 1, 1,  //
      0, 0, 1, 1,        //
      0, 0, 1, -1;
  E.topRightCorner(2, 2).setConstant(delta);
  return within(A, E);
}

}  // namespace

// That of products with r columns and r rows between, whose entries are as uncertain as their sums make
// them.
BOOST_AUTO_TEST_CASE(rank_of_products) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    const auto size = [&](Index least) { return least + static_cast<Index>(generator() % 9); };
    const Index m = size(1), n = size(1), r = std::min({size(0), m, n});
    const MatrixXd B = MatrixXd::NullaryExpr(m, r, [&] { return normal(generator); });
    const MatrixXd C = MatrixXd::NullaryExpr(r, n, [&] { return normal(generator); });
    const MatrixXd E = static_cast<double>(r) * eps * (B.cwiseAbs() * C.cwiseAbs());
    const UncertainElimination elimination(within(B * C, E));
    BOOST_TEST(elimination.rank == r);
    BOOST_TEST(std::ssize(elimination.margins) == r);
    for (const double margin : elimination.margins) BOOST_TEST(margin > 1e3);
    BOOST_TEST(elimination.left <= 1.0);
  }
}

// The errors of B are a thousand times η; they are no matter, since B does not meet it.
BOOST_AUTO_TEST_CASE(errors_elsewhere_hide_no_pivot) {
  const UncertainMatrix A = coupled(1e-9, 1e-6);
  const UncertainElimination elimination(A);
  BOOST_TEST(elimination.rank == 4);
  const RankDecision decision = decide_rank(A);
  BOOST_TEST(decision.rank == 4);
  BOOST_TEST(!decision.ambiguous());
}

// A last pivot that may be zero is none: of [1 1; 1 1+η] with an entry that is known to δ > η.
BOOST_AUTO_TEST_CASE(a_pivot_within_its_error_is_none) {
  MatrixXd A(2, 2), E = MatrixXd::Zero(2, 2);
  A << 1, 1, 1, 1 + 1e-9;
  E(0, 1) = 1e-8;
  const UncertainElimination elimination(within(A, E));
  BOOST_TEST(elimination.rank == 1);
  BOOST_TEST(elimination.left > 0.05);
  BOOST_TEST(elimination.left <= 1.0);
}

BOOST_AUTO_TEST_CASE(empty_and_zero_matrices_have_no_pivots) {
  for (const Index n : {Index{0}, Index{3}}) {
    const UncertainElimination elimination({SparseMatrixXd(n, 2), SparseMatrixXd(n, 2)});
    BOOST_TEST(elimination.rank == 0);
    BOOST_TEST(elimination.left == 0.0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
