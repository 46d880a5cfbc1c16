#include "courant/integrators/step/projector_in_units.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/manifolds/euclidean.hpp"

BOOST_AUTO_TEST_SUITE(projector_in_units)

using namespace courant;

// W̃ = W/u, for a metric that depends on the point: the moves of the projector, measured.
BOOST_AUTO_TEST_CASE(the_same_moves_in_other_units) {
  const Euclidean space(4);
  const Units units{.coordinates = Eigen::Vector4d(0.25, 8.0, 1024.0, 0.5),
                    .tangent = Eigen::Vector4d(0.25, 8.0, 1024.0, 0.5),
                    .auxiliary = VectorXd(0),
                    .equations = VectorXd(0),
                    .time = 2.0};
  const auto metric = [](const ExprVector& x) {
    ExprMatrix G = ExprMatrix::Identity(4, 4);
    G(0, 0) = 2.0 + square(x[1]);
    G(0, 1) = G(1, 0) = 0.3;
    return G;
  };
  const std::vector<std::shared_ptr<const Projector>> projectors = {
      std::make_shared<OrthogonalProjector>(), std::make_shared<OrthogonalProjector>(space, metric),
      std::make_shared<MomentumProjector>(space, std::vector<Index>{2, 3})};
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  const LinearMap<double> one = LinearMap<double>::identity(4);
  for (const auto& projector : projectors) {
    const ProjectorInUnits measured(projector, units);
    const VectorXd x = VectorXd::NullaryExpr(4, [&] { return normal(generator); });
    const MatrixXd C =
        orthonormalized(MatrixXd::NullaryExpr(4, 2, [&] { return normal(generator); }));
    const MatrixXd W = projector->directions(x, one, C);
    const MatrixXd expected = orthonormalized(units.tangent.cwiseInverse().asDiagonal() * W);
    const MatrixXd found = measured.directions(x.cwiseQuotient(units.coordinates), one,
                                               orthonormalized(units.tangent.asDiagonal() * C));
    BOOST_TEST((found - expected * (expected.transpose() * found)).norm() < 1e-11,
               projector->name());
  }
  BOOST_CHECK_THROW(ProjectorInUnits(nullptr, units), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
