#include "courant/structures/elements/thermofluid.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "element_numbers.hpp"

namespace courant::elements {
// Mistakes that these cases have to notice:
//  * a conductor gives a side the entropy that it takes from the other one
BOOST_AUTO_TEST_SUITE(elements_thermofluid_test)

BOOST_AUTO_TEST_CASE(laws) {
  check_laws(pipe(constant(7.0)), i1, v1, {14.0});
  check_laws(thermal_conductor(constant(2.0)), i2, VectorXd{{400.0, 300.0}},
             {2.0 * 100.0 / 400.0, -2.0 * 100.0 / 300.0});
  check_laws(heat_source(constant(60.0)), i1, VectorXd{{300.0}}, {-0.2});
}

BOOST_AUTO_TEST_CASE(energies) {
  BOOST_TEST(energy_of(inertance(3.0), three) == 1.5);
  BOOST_TEST(std::abs(energy_of(tank(2.0, 1000.0, 10.0), three) - 1000.0 * 10.0 * 9.0 / 4.0) <
             1e-9);
  BOOST_TEST(std::abs(energy_of(heat_capacity(2.0, 300.0), three) - 600.0 * std::exp(1.5)) < 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::elements
