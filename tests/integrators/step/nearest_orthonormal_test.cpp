#include "courant/integrators/step/nearest_orthonormal.hpp"

#include <boost/test/unit_test.hpp>
#include <limits>
#include <random>

#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"

// Mistakes that these cases have to notice:
//  * what is far from orthonormal is given up
//  * what is far from orthonormal is not measured by its own size first
//  * steps to the nearest orthonormal matrix end too early
//  * steps to the nearest orthonormal matrix are of second order where they have to be of third
BOOST_AUTO_TEST_SUITE(nearest_orthonormal)

using namespace courant;

namespace {

MatrixXd random_matrix(Index rows, Index columns, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(generator); });
}

}  // namespace

// The polar factor U Vᵀ of the singular value decomposition, for all sizes with code of their own
// and larger ones, at distances from round-off to where it gives up.
BOOST_AUTO_TEST_CASE(is_the_polar_factor) {
  std::mt19937 generator(1);
  const auto random = [&](Index rows, Index columns) {
    return random_matrix(rows, columns, generator);
  };
  for (Index columns = 1; columns <= 12; ++columns)
    for (const Index rows : {columns, columns + 3})
      for (const double distance : {1e-15, 1e-8, 2e-6, 1e-4, 1e-2, 0.2}) {
        const MatrixXd Q = orthonormalized(random(rows, columns));
        MatrixXd change = random(rows, columns);
        change *= distance / change.norm();
        const MatrixXd P = Q + change;
        MatrixXd B = MatrixXd::Zero(rows, columns);
        NearestOrthonormal nearest(columns);
        BOOST_TEST_REQUIRE(nearest(P, B));
        const auto [values, U, V] = singular_value_decomposition(P);
        BOOST_TEST((B - U.leftCols(columns) * V.transpose()).norm() < 2e-14,
                   columns << " columns at " << distance);
      }
}

// From afar too, whatever the size of P, but not where a direction is lost.
BOOST_AUTO_TEST_CASE(is_the_polar_factor_from_afar) {
  std::mt19937 generator(2);
  const auto random = [&](Index rows, Index columns) {
    return random_matrix(rows, columns, generator);
  };
  for (const Index columns : {1, 2, 3, 10})
    for (const Index rows : {columns, columns + 2})
      for (const double least : {1e-3, 0.1, 0.9})
        for (const double size : {1e-6, 1.0, 1e8}) {
          VectorXd values = VectorXd::LinSpaced(columns, 1.0, least);
          const MatrixXd U = orthonormalized(random(rows, columns)),
                         V = orthonormalized(random(columns, columns));
          MatrixXd B = MatrixXd::Zero(rows, columns);
          NearestOrthonormal nearest(columns);
          BOOST_TEST_REQUIRE(nearest.from_afar(size * U * values.asDiagonal() * V.transpose(), B));
          BOOST_TEST((B - U * V.transpose()).norm() < 1e-13 / least,
                     rows << " × " << columns << ", " << least << ", " << size);
        }
  NearestOrthonormal nearest(2);
  MatrixXd P = MatrixXd::Identity(3, 2), B = P;
  P(1, 1) = 1e-7;
  BOOST_TEST(!nearest.from_afar(P, B));
  P(1, 1) = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(!nearest.from_afar(P, B));
  BOOST_TEST(!nearest.from_afar(MatrixXd::Zero(3, 2), B));
}

BOOST_AUTO_TEST_CASE(gives_up_far_away) {
  for (const Index columns : {2, 10}) {
    NearestOrthonormal nearest(columns);
    MatrixXd P = MatrixXd::Identity(columns, columns), B = P;
    P(0, 0) = 0.5;
    BOOST_TEST(!nearest(P, B));
    P(0, 0) = std::numeric_limits<double>::quiet_NaN();
    BOOST_TEST(!nearest(P, B));
    BOOST_TEST((B - MatrixXd::Identity(columns, columns)).norm() == 0.0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
