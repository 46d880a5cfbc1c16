#include "courant/integrators/maps/product_map.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/integrators/maps/chordal.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/euclidean.hpp"

BOOST_AUTO_TEST_SUITE(product_map)

using namespace courant;

BOOST_AUTO_TEST_CASE(every_factor_moves_by_its_own_map) {
  const auto sphere = std::make_shared<Sphere>(2);
  const auto line = std::make_shared<Euclidean>(1);
  const auto pair =
      std::make_shared<Product>(std::vector<std::shared_ptr<const Manifold>>{sphere, line});
  const auto chordal = std::make_shared<Chordal>(sphere);
  const ProductMap map(pair, {chordal, std::make_shared<Theta>(line, 0.0)});
  BOOST_TEST(map.order() == 1);
  BOOST_TEST(!map.is_symmetric());
  BOOST_TEST(map.name() == "ProductMap(Chordal, Theta(0))");
  std::mt19937 generator(1);
  const VectorXd x = pair->random_point(generator);
  const VectorXd v = pair->random_tangent(x, 1.0, generator);
  const auto [x0, x1] = map.forward(x, v);
  const auto [s0, s1] = chordal->forward(VectorXd(x.head(3)), VectorXd(v.head(3)));
  BOOST_TEST((x0.head(3) - s0).norm() + (x1.head(3) - s1).norm() == 0.0);
  BOOST_TEST(x0[3] == x[3]);
  BOOST_TEST(x1[3] == x[3] + v[3]);
}

BOOST_AUTO_TEST_CASE(errors) {
  const auto sphere = std::make_shared<Sphere>(2);
  const auto pair =
      std::make_shared<Product>(std::vector<std::shared_ptr<const Manifold>>{sphere, sphere});
  const auto chordal = std::make_shared<Chordal>(sphere);
  const auto elsewhere = std::make_shared<Chordal>(std::make_shared<Sphere>(3));
  BOOST_CHECK_NO_THROW(ProductMap(pair, {chordal, chordal}));
  BOOST_CHECK_NO_THROW(
      ProductMap(pair, {chordal, std::make_shared<Chordal>(std::make_shared<Sphere>(2))}));
  BOOST_CHECK_THROW(ProductMap(pair, {chordal}), std::invalid_argument);
  BOOST_CHECK_THROW(ProductMap(pair, {chordal, nullptr}), std::invalid_argument);
  BOOST_CHECK_THROW(ProductMap(pair, {chordal, elsewhere}), std::invalid_argument);
  BOOST_CHECK_THROW(ProductMap(nullptr, {}), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
