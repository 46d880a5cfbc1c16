#include "courant/integrators/step/round_off_projection.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/hyperbolic.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"

// Mistakes that these cases have to notice:
//  * round-off of equations that repeat others is a direction to move in
//  * what is left of an equation is not told of the movements before
BOOST_AUTO_TEST_SUITE(round_off_projection)

using namespace courant;

namespace {

RoundOffProjection projection_of(const Manifold& M) {
  return RoundOffProjection(RoundOffProjection::constraint(M, Backend::interpreter));
}

}  // namespace

// Back onto the manifold, by no more than a few times the distance from it: the equations of a
// bundle repeat each other up to round-off, and nothing may be divided by that.
BOOST_AUTO_TEST_CASE(moves_as_little_as_the_defect) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  const auto plane = std::make_shared<Hyperbolic>(2);
  const auto bundle = std::make_shared<CotangentBundle>(plane);
  const std::vector<std::shared_ptr<const Manifold>> manifolds = {
      std::make_shared<Sphere>(2), std::make_shared<SpecialOrthogonal3>(),
      std::make_shared<CotangentBundle>(std::make_shared<Sphere>(2)), bundle};
  for (const auto& M : manifolds) {
    RoundOffProjection projection = projection_of(*M);
    for (int trial = 0; trial < 50; ++trial) {
      VectorXd x = M->random_point(generator);
      if (M == bundle) {  // far out, where projectors are long
        const VectorXd q = plane->project(Eigen::Vector3d(0.0, 2.0, 2.0 * normal(generator)));
        x << q, plane->tangent_projector(q).transpose() * x.tail(3);
      }
      const double offset = 1e-12;
      const VectorXd off =
          x + offset * VectorXd::NullaryExpr(x.size(), [&] { return normal(generator); });
      VectorXd y = off;
      projection.apply(y);
      const double scale = 1.0 + x.squaredNorm();
      BOOST_TEST(M->point_defect(y) < 1e-14 * scale, M->name());
      BOOST_TEST((y - off).norm() < 10.0 * offset * scale, M->name());
    }
  }
}

BOOST_AUTO_TEST_CASE(leaves_points_alone) {
  const Sphere sphere(2);
  RoundOffProjection projection = projection_of(sphere);
  VectorXd x = Eigen::Vector3d(0.6, 0.0, 0.8 + 1e-15);
  const VectorXd before = x;
  projection.apply(x);
  BOOST_TEST((x - before).norm() == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
