#include "courant/manifolds/product.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <numbers>

#include "courant/manifolds/cotangent_bundle.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/laws.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/manifolds/torus.hpp"

// Mistakes that these cases have to notice:
//  * the largest radius of the factors
//  * one factor off its manifold hides behind the next
//  * separations of the factors do not add up
//  * factors share their units
//  * angles have units (manifolds/torus.cpp)
//  * momenta have the units of positions (manifolds/vector_bundle.cpp)
BOOST_AUTO_TEST_SUITE(product)

using namespace courant;

BOOST_AUTO_TEST_CASE(every_map_is_that_of_the_factors) {
  const auto sphere = std::make_shared<Sphere>(2, Sphere::projective());
  const auto rotations = std::make_shared<SpecialOrthogonal3>();
  const Product M({sphere, rotations});
  BOOST_TEST(M.name() == "Product(Sphere(2, projective), SpecialOrthogonal3(exponential))");
  BOOST_TEST(M.dimension() == 5);
  BOOST_TEST(M.ambient_dimension() == 12);
  BOOST_TEST(M.tangent_dimension() == 6);
  BOOST_TEST(!M.is_geodesic());
  std::mt19937 generator(1);
  const VectorXd x = M.random_point(generator);
  const VectorXd v = M.random_tangent(x, 1.0, generator);
  BOOST_TEST(M.injectivity_radius(x) == std::numbers::pi);
  const VectorXd y = M.retract(x, v);
  BOOST_TEST((M.point_part(y, 0) - sphere->retract(x.head(3), v.head(3))).norm() == 0.0);
  BOOST_TEST((M.point_part(y, 1) - rotations->retract(x.tail(9), v.tail(3))).norm() == 0.0);
  BOOST_TEST((M.tangent_part(v, 1) - v.tail(3)).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(separation_is_that_of_the_factors) {
  const Product M({std::make_shared<Torus>(1), std::make_shared<Euclidean>(1)});
  const Eigen::Vector2d x(0.0, 0.0);
  BOOST_TEST(M.separation(x, Eigen::Vector2d(2.0 * std::numbers::pi + 3.0, 4.0)) == 5.0,
             boost::test_tools::tolerance(1e-14));
}

// A point of a sphere has no unit, its momenta share one; angles have none, their momenta one each; positions in
// the plane have one each, and so have their momenta. Bundles of bundles go on counting.
BOOST_AUTO_TEST_CASE(units_are_those_of_the_factors) {
  const auto M = std::make_shared<Product>(std::vector<std::shared_ptr<const Manifold>>{
      std::make_shared<Sphere>(2), std::make_shared<Torus>(1), std::make_shared<Euclidean>(2)});
  using Numbers = std::vector<Index>;
  BOOST_TEST((M->scaling_symmetries().point == Numbers{-1, -1, -1, -1, 0, 1}));
  BOOST_TEST((M->scaling_symmetries().tangent == Numbers{-1, -1, -1, -1, 0, 1}));
  BOOST_TEST((M->scaling_symmetries().fibre == Numbers{0, 0, 0, 1, 2, 3}));
  const auto phase_space = std::make_shared<CotangentBundle>(M);
  const Numbers units = {-1, -1, -1, -1, 0, 1, 2, 2, 2, 3, 4, 5};
  BOOST_TEST((phase_space->scaling_symmetries().point == units));
  BOOST_TEST((phase_space->scaling_symmetries().tangent == units));
  BOOST_TEST(
      (phase_space->scaling_symmetries().fibre == Numbers{0, 0, 0, 1, 2, 3, 4, 4, 4, 5, 6, 7}));
  BOOST_TEST((CotangentBundle(std::make_shared<SpecialOrthogonal3>()).scaling_symmetries().point ==
              Numbers{-1, -1, -1, -1, -1, -1, -1, -1, -1, 0, 0, 0}));
  BOOST_TEST(std::ranges::all_of(check_manifold(*phase_space),
                                 [](const LawResult& result) { return result.passed(); }));
}

// A sphere's three components, angles and positions one by one; of a group none are mixed.
BOOST_AUTO_TEST_CASE(components_are_mixed_within_factors) {
  using Numbers = std::vector<Index>;
  const auto sphere = std::make_shared<Sphere>(2);
  const Product M({std::make_shared<Torus>(1), sphere, std::make_shared<Euclidean>(2)});
  BOOST_TEST((M.mixed_components() == Numbers{0, 1, 1, 1, 4, 5}));
  BOOST_TEST((CotangentBundle(sphere).mixed_components() == Numbers{0, 0, 0, 3, 3, 3}));
  BOOST_TEST((SpecialOrthogonal3().mixed_components() == Numbers{0, 1, 2}));
}

BOOST_AUTO_TEST_CASE(a_null_factor_is_an_error) {
  BOOST_CHECK_THROW(Product({std::make_shared<Sphere>(2), nullptr}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
