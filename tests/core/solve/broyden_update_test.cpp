#include "courant/core/solve/broyden_update.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>

#include "../random_matrix.hpp"
#include "courant/core/linear/lu_decomposition.hpp"

// Mistakes that these cases have to notice:
//  * an update forgets the units of the unknowns
//  * the secant equation does not hold
//  * an inverse of little use is made worse
//  * an update goes the other way
BOOST_AUTO_TEST_SUITE(broyden_update)

using namespace courant;

namespace {

// Two changes of simplified Newton for F(y) = J y, by an inverse that belongs to another matrix.
struct Changes {
  explicit Changes(Index n)
      : J(2.0 * MatrixXd::Identity(n, n) + 0.1 * random_matrix(n, n, 1)),
        A(0.5 * MatrixXd::Identity(n, n) + 0.01 * random_matrix(n, n, 2)),
        weights(random_matrix(n, 1, 3).cwiseAbs()) {
    const VectorXd y = random_matrix(n, 1, 4);
    s = A * J * y;
    r = A * J * (y - s);
  }
  bool update() {
    const VectorXd weighted = weights.cwiseProduct(s);
    return courant::broyden_update(A.data(), s.data(), r.data(), weighted.data(), s.size());
  }

  MatrixXd J, A;
  VectorXd weights, s, r;
};

MatrixXd inverse(const MatrixXd& A) { return LuDecomposition(A).inverse(); }

}  // namespace

// What A makes of the difference of the two residuals is the change that led from one to the other.
BOOST_AUTO_TEST_CASE(secant_equation_holds) {
  for (const Index n : {1, 2, 5, 8, 13}) {
    Changes changes(n);
    const VectorXd difference = changes.J * changes.s;
    BOOST_TEST((changes.A * difference - changes.s).norm() > 1e-3);
    BOOST_TEST_REQUIRE(changes.update());
    BOOST_TEST((changes.A * difference - changes.s).norm() < 1e-14);
  }
}

// Of vectors across s, in the units of W, A⁻¹ makes what it made before.
BOOST_AUTO_TEST_CASE(least_change_in_units_of_the_weights) {
  Changes changes(6);
  const MatrixXd before = inverse(changes.A);
  BOOST_TEST_REQUIRE(changes.update());
  VectorXd across = random_matrix(6, 1, 5);
  const VectorXd weighted = changes.weights.cwiseProduct(changes.s);
  across -= changes.s * (weighted.dot(across) / weighted.dot(changes.s));
  BOOST_TEST(((inverse(changes.A) - before) * across).norm() < 1e-13);
  BOOST_TEST(((inverse(changes.A) - before) * changes.s).norm() > 1e-3);
}

BOOST_AUTO_TEST_CASE(useless_and_infinite_changes_teach_nothing) {
  Changes changes(4);
  const MatrixXd before = changes.A;
  changes.r = 0.6 * changes.s;
  BOOST_TEST(!changes.update());
  changes.r = -0.6 * changes.s;
  BOOST_TEST(!changes.update());
  changes.r[1] = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(!changes.update());
  changes.s.setZero();
  changes.r.setZero();
  BOOST_TEST(!changes.update());
  BOOST_TEST((changes.A == before));
}

BOOST_AUTO_TEST_SUITE_END()
