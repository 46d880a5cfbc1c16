#include "courant/integrators/maps/cayley_midpoint.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/integrators/maps/theta.hpp"

BOOST_AUTO_TEST_SUITE(cayley_midpoint)

using namespace courant;

// The closed inverse against Newton's method on the same map, on both groups.
template <class Group>
void compare_with_newton() {
  const auto group = std::make_shared<Group>(Group::cayley());
  const CayleyMidpoint map(group);
  const Theta other(group, 0.5);
  std::mt19937 generator(2);
  for (const double length : {1e-8, 0.5, 2.5}) {
    const VectorXd x = group->random_point(generator);
    const VectorXd v = group->random_tangent(x, length, generator);
    const auto [a0, a1] = map.forward(x, v);
    const auto [b0, b1] = other.forward(x, v);
    BOOST_TEST((a0 - b0).norm() + (a1 - b1).norm() < 1e-14);
    const auto [c, w] = map.inverse(a0, a1);
    const auto [d, u] = other.inverse(a0, a1);
    BOOST_TEST((c - x).norm() + (w - v).norm() < 1e-13);
    BOOST_TEST((c - d).norm() + (w - u).norm() < 1e-11);
  }
}

BOOST_AUTO_TEST_CASE(rotations) { compare_with_newton<SpecialOrthogonal3>(); }
BOOST_AUTO_TEST_CASE(motions) { compare_with_newton<SpecialEuclidean3>(); }

// The point between is the half rotation, as with the exponential; v is longer, 4 tan(angle/4).
BOOST_AUTO_TEST_CASE(halves_the_rotation) {
  const auto group = std::make_shared<SpecialOrthogonal3>();
  std::mt19937 generator(3);
  const VectorXd x0 = group->random_point(generator);
  const VectorXd w = group->random_tangent(x0, 3.0, generator);
  const auto [x, v] = CayleyMidpoint(group).inverse(x0, group->retract(x0, w));
  BOOST_TEST((x - group->retract(x0, VectorXd(w / 2))).norm() < 1e-14);
  BOOST_TEST((v - 4.0 * std::tan(0.75) * w / 3.0).norm() < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()
