#include "courant/manifolds/product.hpp"

#include <boost/test/unit_test.hpp>
#include <numbers>

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"
#include "courant/manifolds/sphere.hpp"
#include "courant/manifolds/torus.hpp"

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

BOOST_AUTO_TEST_CASE(a_null_factor_is_an_error) {
  BOOST_CHECK_THROW(Product({std::make_shared<Sphere>(2), nullptr}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
