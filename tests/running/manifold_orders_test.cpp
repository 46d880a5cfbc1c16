// Order 2 of every symmetric map in both methods on every nonlinear space, measured on motions in a
// potential against Dormand and Prince on the vector field in the space around.
#include <boost/test/unit_test.hpp>

#include "motions.hpp"
#include "problems.hpp"

namespace courant {

BOOST_AUTO_TEST_SUITE(manifold_orders_long)

using test::method_1, test::method_2;

BOOST_AUTO_TEST_CASE(all_are_two) {
  const double time = 1.0;
  for (const test::Motion& motion : test::motions()) {
    const auto system = test::problem(motion.experiment);
    const VectorXd exact = system.end("dopri5", time, 200);
    for (const char* map : motion.maps)
      for (const Json& method : {method_1(map), method_2(map)}) {
        const double order = system.order(method, time, exact);
        BOOST_TEST(std::abs(order - 2.0) < 0.15,
                   motion.space << ", " << method.dump() << ": " << order);
      }
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
