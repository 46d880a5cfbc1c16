#include "courant/structures/elements/mechanical.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "element_numbers.hpp"

namespace courant::elements {
// Mistakes that these cases have to notice:
//  * the value of a spring is its compliance
BOOST_AUTO_TEST_SUITE(elements_mechanical_test)

BOOST_AUTO_TEST_CASE(laws) {
  check_laws(damper(domains::rotation, constant(4.0)), i1, v1, {20.0});
  check_laws(friction(domains::translation, 6.0, 2.0), i1, v1, {6.0 * std::tanh(2.5)});
  check_laws(gear(3.0), i2, v2, {33.0, -6.0});
}

BOOST_AUTO_TEST_CASE(energies) {
  BOOST_TEST(energy_of(spring(4.0), three) == 18.0);
  BOOST_TEST(energy_of(torsion_spring(4.0), three) == 18.0);
  BOOST_TEST(energy_of(inertia(3.0), three) == 1.5);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::elements
