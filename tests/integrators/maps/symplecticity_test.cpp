#include "courant/integrators/maps/symplecticity.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/sphere.hpp"

// Mistakes that these cases have to notice:
//  * d_Tω without its second part
BOOST_AUTO_TEST_SUITE(symplecticity)

using namespace courant;

// T*R = R²: of the maps (x - θ v, x + (1-θ) v) the midpoint rule pulls Ω₁₂ back to d_Tω, and for
// the others Ω₁₂ - d_Tω = (1-2θ) dq̇ ∧ dṗ. On unit vectors that is at most |1-2θ|.
BOOST_AUTO_TEST_CASE(of_theta_on_the_plane) {
  const auto phase_space = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(1));
  const Eigen::Vector2d x(0.3, 1.0), v(-0.4, 0.8);
  std::mt19937 generator(1);
  for (const double theta : {0.5, 0.4, 0.0}) {
    const Symplecticity measure(Theta(phase_space, theta));
    double largest = 0.0;
    for (int i = 0; i < 50; ++i) largest = std::max(largest, measure.defect(x, v, generator));
    BOOST_TEST(largest <= 1.0 - 2.0 * theta + 1e-15);
    BOOST_TEST(largest >= 0.3 * (1.0 - 2.0 * theta));
  }
}

BOOST_AUTO_TEST_CASE(needs_a_cotangent_bundle) {
  BOOST_CHECK_THROW(Symplecticity(Theta(std::make_shared<Sphere>(2))), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
