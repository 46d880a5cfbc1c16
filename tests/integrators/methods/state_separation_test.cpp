#include "courant/integrators/methods/state_separation.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/system_in_units.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * states are compared in the units of the experiment
BOOST_AUTO_TEST_SUITE(state_separation_test)

BOOST_AUTO_TEST_CASE(distances_are_next_to_the_size_of_the_first_state) {
  const Euclidean M(2);
  const StateSeparation separation(M, nullptr, VectorXd{{3.0, 4.0}});
  const State a = {.x = VectorXd{{1.0, 1.0}}}, b = {.x = VectorXd{{1.0, 1.5}}};
  BOOST_TEST(separation.scale() == 5.0);
  BOOST_TEST(separation(a, b) == 0.1);
  BOOST_TEST(separation(a, a) == 0.0);
}

// A position of 4e-10 m in units of 2^-32 m and a momentum in units of 2^-80: both count.
BOOST_AUTO_TEST_CASE(numbers_are_compared_in_units) {
  const Euclidean M(2);
  const double length = 0x1p-32, momentum = 0x1p-80;
  Units units;
  units.coordinates = VectorXd{{length, momentum}};
  const StateSeparation separation(M, &units, VectorXd{{3.0 * length, 4.0 * momentum}});
  BOOST_TEST(separation.scale() == 5.0);
  const State a = {.x = VectorXd{{length, momentum}}},
              b = {.x = VectorXd{{length, 2.0 * momentum}}};
  BOOST_TEST(separation(a, b) == 0.2);
}

BOOST_AUTO_TEST_CASE(a_start_at_zero_has_the_size_of_where_it_goes) {
  const Euclidean M(1);
  StateSeparation separation(M, nullptr, VectorXd{{0.0}});
  BOOST_TEST(separation.scale() == 1e-300);
  separation.include(VectorXd{{-2.0}});
  separation.include(VectorXd{{1.0}});
  BOOST_TEST(separation.scale() == 2.0);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
