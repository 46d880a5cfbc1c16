#include "courant/structures/elements/electrical.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "element_numbers.hpp"

namespace courant::elements {
// Mistakes that these cases have to notice:
//  * the sides of a gyrator are exchanged
//  * heat is taken from its node
BOOST_AUTO_TEST_SUITE(elements_electrical_test)

BOOST_AUTO_TEST_CASE(laws) {
  const Law at_t = [](const Variables& own) { return 4.0 * own.t(); };
  check_laws(resistor(100.0), i1, v1, {200.0});
  check_laws(resistor_of_voltage([](const Variables& own) { return square(own.voltage(0)); }), i1,
             v1, {25.0});
  check_laws(heating(resistor(100.0)), i2, v2, {200.0, -2.0 * 5.0 / 11.0});
  check_laws(ideal_transformer(0.5), i2, v2, {5.5, -1.0});
  check_laws(gyrator(10.0), i2, v2, {30.0, -20.0});
  check_laws(voltage_source(at_t), i1, v1, {1.0});
  check_laws(current_source(3.0), i1, v1, {3.0});
  check_laws(electrical_switch(constant(1.0), 0.5, 1e9), i1, v1, {1.0});
  check_laws(electrical_switch(constant(0.0), 0.5, 1e9), i1, v1, {2e9});
  check_laws(diode({.saturation = 1e-3, .scale = 2.0}, {}), i1, v1, {1e-3 * std::expm1(2.5)});
}

BOOST_AUTO_TEST_CASE(energies) {
  BOOST_TEST(energy_of(capacitor(0.5), three) == 9.0);
  BOOST_TEST(energy_of(inductor(4.0), three) == 9.0 / 8.0);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::elements
