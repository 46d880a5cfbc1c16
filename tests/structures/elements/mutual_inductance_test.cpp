#include "courant/structures/elements/mutual_inductance.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace courant::elements {
// Mistakes that these cases have to notice:
//  * a second coupling of two inductors takes the place of the first
//  * couplings of three inductors that cannot be are taken
BOOST_AUTO_TEST_SUITE(mutual_inductance_test)

// (2 2; 2 8)⁻¹ = (8 -2; -2 2)/12, in two parts of the coupling.
BOOST_AUTO_TEST_CASE(the_inverse_is_that_of_the_inductances) {
  MutualInductance coupled;
  BOOST_TEST(coupled.add(2.0) == 0);
  BOOST_TEST(coupled.add(8.0) == 1);
  BOOST_TEST(coupled.add(0, 1, 0.2));
  BOOST_TEST(coupled.add(1, 0, 0.3));
  BOOST_TEST((coupled.inverse() - MatrixXd{{8, -2}, {-2, 2}} / 12.0).norm() < 1e-15);
}

BOOST_AUTO_TEST_CASE(couplings_that_cannot_be_are_told) {
  MutualInductance coupled(VectorXd{{1.0, 1e-6, 1e6}});
  BOOST_TEST(coupled.is_definite());
  BOOST_TEST(!coupled.add(0, 1, 1.0));
  BOOST_TEST(coupled.add(0, 1, 0.9));
  BOOST_TEST(!coupled.add(0, 1, 0.2));
  BOOST_TEST(coupled.add(1, 2, 0.4));
  BOOST_TEST(coupled.is_definite());
  BOOST_TEST(coupled.add(2, 0, -0.9));
  BOOST_TEST(!coupled.is_definite());
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant::elements
