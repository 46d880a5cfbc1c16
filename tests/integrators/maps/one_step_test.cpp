#include "courant/integrators/maps/one_step.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(one_step_test)

// The error of one step of a map of order p is of order p + 1, forward and back, and there is none
// for h = 0.
BOOST_AUTO_TEST_CASE(errors_show_the_order_of_the_map) {
  for (const auto& [M, x0] : {std::pair<std::shared_ptr<const Manifold>, VectorXd>(
                                  std::make_shared<Euclidean>(2), VectorXd{{0.3, -0.7}}),
                              std::pair<std::shared_ptr<const Manifold>, VectorXd>(
                                  std::make_shared<Sphere>(2), VectorXd{{0.6, 0.0, 0.8}})})
    for (const auto& [theta, order] :
         {std::pair(0.5, 2.0), std::pair(0.0, 1.0), std::pair(1.0, 1.0)}) {
      std::mt19937 generator(3);
      const Theta map(M, theta);
      const OneStep step(map, x0, generator);
      BOOST_TEST(step.error(0.0) < 1e-15);
      BOOST_TEST(std::abs(std::log2(step.error(0.01) / step.error(0.005)) - order - 1.0) < 0.1);
      BOOST_TEST(step.error(-0.01) < 2.0 * step.error(0.01));
    }
}

// Fields are drawn one after the other.
BOOST_AUTO_TEST_CASE(fields_differ) {
  std::mt19937 generator(3);
  const Theta map(std::make_shared<Euclidean>(2), 0.5);
  const VectorXd x0{{0.3, -0.7}};
  const OneStep first(map, x0, generator), second(map, x0, generator);
  BOOST_TEST(first.error(0.1) != second.error(0.1));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
