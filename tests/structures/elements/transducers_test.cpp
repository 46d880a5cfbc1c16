#include "courant/structures/elements/transducers.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "element_numbers.hpp"

namespace courant::elements {
// Mistakes that these cases have to notice:
//  * a motor pushes back
BOOST_AUTO_TEST_SUITE(elements_transducers_test)

BOOST_AUTO_TEST_CASE(laws_and_energies) {
  check_laws(motor(0.1, domains::rotation), i2, v2, {1.1, -0.2});
  const Element magnet = electromagnet(
      [](const ExprVector& own, const ExprVector&, const Expr&) { return 1.0 + own[1]; });
  BOOST_TEST(energy_of(magnet, VectorXd{{3.0, 1.0}}) == 9.0 / 4.0);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::elements
