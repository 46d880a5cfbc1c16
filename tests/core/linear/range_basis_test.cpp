#include "courant/core/linear/range_basis.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/core/linear/qr_decomposition.hpp"

// Mistakes that these cases have to notice:
//  * the columns that are left keep their parts along those before
//  * zeros that are round-off stay numbers
BOOST_AUTO_TEST_SUITE(range_bases)

using namespace courant;

namespace {

double defect(const MatrixXd& projector, const MatrixXd& B) {
  return (B.transpose() * B - MatrixXd::Identity(B.cols(), B.cols())).norm() +
         (projector * B - B).norm();
}

}  // namespace

// Of orthogonal projectors of all ranks, and of oblique ones.
BOOST_AUTO_TEST_CASE(spans_the_range) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  const auto random = [&](Index rows, Index columns) {
    return MatrixXd(MatrixXd::NullaryExpr(rows, columns, [&] { return normal(generator); }));
  };
  for (const Index m : {1, 2, 5, 12})
    for (Index n = 0; n <= m; ++n) {
      const MatrixXd Q = orthonormalized(random(m, n));
      const MatrixXd projector = Q * Q.transpose();
      BOOST_TEST(defect(projector, range_basis(projector, n)) < 1e-13, m << " × " << n);
      const MatrixXd other = Q + 0.1 * random(m, n);
      const MatrixXd oblique = Q * (other.transpose() * Q).inverse() * other.transpose();
      BOOST_TEST(defect(oblique, range_basis(oblique, n)) < 1e-12, m << " × " << n);
    }
}

// Along the axes it has zeros, whatever rounding leaves of the projector.
BOOST_AUTO_TEST_CASE(zeros_stay_zeros) {
  MatrixXd projector = MatrixXd::Zero(3, 3);
  projector(0, 0) = projector(2, 2) = 1.0;
  projector(0, 2) = projector(2, 0) = 1e-17;
  const MatrixXd B = range_basis(projector, 2);
  BOOST_TEST((B.array() == 0.0).count() == 4);
  BOOST_TEST(defect(projector, B) < 1e-15);
}

BOOST_AUTO_TEST_SUITE_END()
