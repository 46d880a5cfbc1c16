#include "courant/manifolds/torus.hpp"

#include <boost/test/unit_test.hpp>
#include <numbers>

// Mistakes that these cases have to notice:
//  * points a turn apart are apart
BOOST_AUTO_TEST_SUITE(torus)

using namespace courant;
using Eigen::Vector2d;

constexpr double kTurn = 2.0 * std::numbers::pi;

BOOST_AUTO_TEST_CASE(whole_turns_make_no_difference) {
  const Torus T(2);
  const Vector2d x(0.5, -3.0);
  const Vector2d y(1.0, 3.0);
  const Vector2d turns(3 * kTurn, -2 * kTurn);
  BOOST_TEST(T.separation(x, x + turns) < 1e-14);
  BOOST_TEST(T.separation(x, y) == T.separation(x + turns, y), boost::test_tools::tolerance(1e-14));
  BOOST_TEST((T.inverse_retract(x, y) - T.inverse_retract(x, y + turns)).norm() < 1e-14);
}

BOOST_AUTO_TEST_CASE(the_inverse_goes_the_short_way) {
  const Torus T(1);
  const VectorXd v = T.inverse_retract(VectorXd::Constant(1, 3.0), VectorXd::Constant(1, -3.0));
  BOOST_TEST(v[0] == kTurn - 6.0, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(angles_count_their_turns) {
  const Torus T(1);
  const VectorXd x = VectorXd::Constant(1, 3.0);
  BOOST_TEST(T.retract(x, VectorXd::Constant(1, 10.0))[0] == 13.0);
}

BOOST_AUTO_TEST_SUITE_END()
