#include "courant/manifolds/vector_bundle.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/hyperbolic.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/manifolds/tangent_bundle.hpp"

// Mistakes that these cases have to notice:
//  * covectors are not made tangent after a step
//  * fibres do not turn with the point
//  * off a bundle momenta become positions
BOOST_AUTO_TEST_SUITE(vector_bundle)

using namespace courant;
using Eigen::Vector3d;

// On a group nothing turns: the fibre is simply added to.
BOOST_AUTO_TEST_CASE(trivialised_bundles_add) {
  const auto rotations = std::make_shared<SpecialOrthogonal3>();
  const TangentBundle TG(rotations);
  std::mt19937 generator(1);
  const VectorXd x = TG.random_point(generator);
  const VectorXd v = TG.random_tangent(x, 1.0, generator);
  BOOST_TEST(TG.is_geodesic());
  const VectorXd sum = TG.fibre_part(x) + TG.vertical(v);
  BOOST_TEST((TG.fibre_part(TG.retract(x, v)) - sum).norm() == 0.0);
  BOOST_TEST(TG.injectivity_radius(x) == rotations->injectivity_radius(TG.position(x)));
}

// On the sphere the fibre turns: u̇ = r - ⟨v, u⟩ x.
BOOST_AUTO_TEST_CASE(frame_of_the_tangent_bundle_of_the_sphere) {
  const TangentBundle TS(std::make_shared<Sphere>(2));
  std::mt19937 generator(2);
  const VectorXd x = TS.random_point(generator);
  const VectorXd v = TS.random_tangent(x, 1.0, generator);
  const VectorXd rate = TS.frame(x) * v;
  const VectorXd expected = TS.vertical(v) - TS.horizontal(v).dot(TS.fibre_part(x)) * x.head(3);
  BOOST_TEST((TS.fibre_part(rate) - expected).norm() < 1e-15);
}

// ‖Π⁺ - Π‖ = sin of the distance on the sphere: invertible up to π/2, and 1/κ = 1/√2 is inside.
BOOST_AUTO_TEST_CASE(the_radius_keeps_projectors_comparable) {
  const TangentBundle TS(std::make_shared<Sphere>(2));
  VectorXd x = VectorXd::Zero(6);
  x[2] = 1.0;
  x[3] = 2.0;
  BOOST_TEST(TS.injectivity_radius(x) == std::sqrt(0.5), boost::test_tools::tolerance(1e-14));
  VectorXd v = VectorXd::Zero(6);
  v[0] = 1.5;
  v[4] = 0.7;
  BOOST_TEST((TS.inverse_retract(x, TS.retract(x, v)) - v).norm() < 1e-13);  // 1.5 < π/2
}

// Along the fibre nothing is limited: extent counts the base alone, in products factor by factor,
// and the retraction is injective up to extent 1 however long the vertical part is.
BOOST_AUTO_TEST_CASE(the_fibre_is_not_limited) {
  std::mt19937 generator(5);
  const auto sphere = std::make_shared<Sphere>(2);
  const auto rotations = std::make_shared<SpecialOrthogonal3>();
  for (const auto& M :
       {std::make_shared<CotangentBundle>(sphere), std::make_shared<CotangentBundle>(rotations)}) {
    const VectorXd x = M->random_point(generator);
    const auto extent = M->extent_at(x);
    const Index size = M->base()->tangent_dimension();
    VectorXd v = M->random_tangent(x, 1.0, generator);
    v.head(size) *= 0.95 * M->injectivity_radius(x) / v.head(size).norm();
    v.tail(size) *= 100.0;
    BOOST_TEST(extent(v) == 0.95, boost::test_tools::tolerance(1e-12));
    BOOST_TEST((M->inverse_retract(x, M->retract(x, v)) - v).norm() < 1e-11 * v.norm(), M->name());
    BOOST_TEST(extent(1.1 / 0.95 * v) > 1.0);
  }
  const Product both({sphere, std::make_shared<CotangentBundle>(rotations)});
  const VectorXd x = both.random_point(generator);
  VectorXd v = VectorXd::Zero(9);
  v.tail(3).setConstant(50.0);
  BOOST_TEST(both.extent_at(x)(v) == 0.0);
  v.head(3) = sphere->random_tangent(x.head(3), 1.0, generator);
  BOOST_TEST(both.extent_at(x)(v) == 1.0 / M_PI, boost::test_tools::tolerance(1e-12));
}

// Covectors of hyperbolic space are not its vectors: the projectors are transposes.
BOOST_AUTO_TEST_CASE(tangent_and_cotangent_differ_where_the_projector_is_not_symmetric) {
  const auto plane = std::make_shared<Hyperbolic>(2);
  const Vector3d q = plane->project(Vector3d(0.0, 1.0, 0.5));
  const TangentBundle T(plane);
  const CotangentBundle dual(plane);
  VectorXd x(6);
  x << q, plane->tangent_projector(q) * Vector3d(1.0, 2.0, 3.0);
  BOOST_TEST(T.point_defect(x) < 1e-14);
  BOOST_TEST(dual.point_defect(x) > 0.1);
  x.tail(3) = plane->tangent_projector(q).transpose() * Vector3d(1.0, 2.0, 3.0);
  BOOST_TEST(T.point_defect(x) > 0.1);
  BOOST_TEST(dual.point_defect(x) < 1e-14);
}

// Π is C E on T*S². Off it, where a momentum of 10⁶ has a normal part, it still makes no positions of momenta.
BOOST_AUTO_TEST_CASE(the_projector_keeps_positions_and_momenta_apart) {
  const CotangentBundle M(std::make_shared<Sphere>(2));
  std::mt19937 generator(5);
  const VectorXd on = M.random_point(generator);
  const MatrixXd product = M.coframe(on).matrix() * M.frame(on).matrix();
  BOOST_TEST((M.tangent_projector(on).matrix() - product).norm() < 1e-14);
  VectorXd off = on;
  off.tail(3) = 1e6 * (off.tail(3) + 1e-3 * on.head(3));
  const MatrixXd projector = M.tangent_projector(off).matrix();
  BOOST_TEST(projector.bottomLeftCorner(3, 3).norm() == 0.0);
  BOOST_TEST(projector.topRightCorner(3, 3).norm() == 0.0);
  BOOST_TEST((projector * projector - projector).norm() < 1e-13);
}

BOOST_AUTO_TEST_CASE(a_null_base_is_an_error) {
  BOOST_CHECK_THROW(TangentBundle(nullptr), std::invalid_argument);
  BOOST_CHECK_THROW(CotangentBundle(nullptr), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
