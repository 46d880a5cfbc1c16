#include "courant/integrators/certificate/discrete_constraint_algorithm.hpp"

#include <boost/test/unit_test.hpp>

#include "courant/integrators/maps/theta.hpp"
#include "courant/manifolds/sphere.hpp"
#include "ladder_catalogue.hpp"

BOOST_AUTO_TEST_SUITE(discrete_constraint_algorithm_test)

using namespace courant;
using namespace courant::examples;

namespace {

ConstraintLadder discrete(const SystemPointer& system, const InitialGuess& guess, double theta,
                          double h) {
  return DiscreteConstraintAlgorithm().run(
      system, std::make_shared<Theta>(system->manifold(), theta), h, guess);
}

}  // namespace

// The vortices on T*R⁸ by the midpoint rule: Method 1 is a map on all of T*Q, while S stops at S_1
// over the image of α.
BOOST_AUTO_TEST_CASE(remark_6_1) {
  const ConstraintLadder here = discrete(vortices(), vortex_guess(), 0.5, 0.1);
  BOOST_TEST((dimensions(here) == Dimensions{{16, 16}, {16, 16}}));
  BOOST_TEST(to_string(here.verdict) == "regular");
  BOOST_TEST(here.index == 0);
  BOOST_TEST(here.moved == 0.0);
  const ConstraintLadder continuous = ConstraintAlgorithm().run(vortices(), vortex_guess());
  BOOST_TEST((dimensions(continuous) == Dimensions{{16, 8}, {8, 8}, {8, 8}}));
}

// The Cartesian pendulum by explicit Euler: the constraint holds at x_0, at x_1 = x_0 + h v and at
// x_2, which is where λ appears first: level by level what S has.
BOOST_AUTO_TEST_CASE(explicit_euler_finds_what_the_system_has) {
  const SystemPointer pendulum = cartesian_pendulum();
  const InitialGuess guess = at({0.6, -0.8, 0.1, 0.3});
  const ConstraintLadder here = discrete(pendulum, guess, 0.0, 0.01);
  BOOST_TEST((dimensions(here) == Dimensions{{4, 3}, {3, 2}, {2, 2}, {2, 2}}));
  BOOST_TEST((dimensions(here) == dimensions(ConstraintAlgorithm().run(pendulum, guess))));
  BOOST_TEST(here.index == 2);
  // The same by the midpoint rule: λ puts the midpoint on the circle, the ends are free.
  BOOST_TEST((dimensions(discrete(pendulum, guess, 0.5, 0.01)) == Dimensions{{4, 4}, {4, 4}}));
}

// x' = x by the midpoint rule with h = 2: (1 - h/2) x_1 = (1 + h/2) x_0 asks for x_0 = 0, and then
// for x_1 = 0, though S is a vector field. For any other h it asks for nothing.
BOOST_AUTO_TEST_CASE(a_step_can_constrain_what_was_free) {
  const SystemPointer growth =
      flat(1, 0, 1, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return ExprVector(v - x);
      });
  BOOST_TEST(
      (dimensions(ConstraintAlgorithm().run(growth, at({0.7}))) == Dimensions{{1, 1}, {1, 1}}));
  BOOST_TEST((dimensions(discrete(growth, at({0.7}), 0.5, 1.9)) == Dimensions{{1, 1}, {1, 1}}));
  const ConstraintLadder here = discrete(growth, at({0.7}), 0.5, 2.0);
  BOOST_TEST((dimensions(here) == Dimensions{{1, 0}, {0, 0}, {0, 0}}));
  BOOST_TEST(std::abs(here.point.x[0]) < 1e-12);
}

// On S²: x' = a × x + λ ∇x_3, x_3 = ½. Implicit Euler puts x_1 on the circle from anywhere.
BOOST_AUTO_TEST_CASE(on_a_sphere) {
  for (const KnownLadder& known : catalogue()) {
    if (known.name != "constraint on S²") continue;
    const ConstraintLadder implicit =
        discrete(known.problem.system, at({0.8, 0.0, 0.6}), 1.0, 0.05);
    BOOST_TEST((dimensions(implicit) == Dimensions{{2, 2}, {2, 2}}));
    const ConstraintLadder explicit_euler =
        discrete(known.problem.system, at({std::sqrt(0.75), 0.0, 0.5}), 0.0, 0.05);
    BOOST_TEST((dimensions(explicit_euler) == Dimensions{{2, 1}, {1, 1}, {1, 1}}));
  }
}

BOOST_AUTO_TEST_CASE(contradictions_stay_contradictions) {
  const SystemPointer system =
      flat(1, 0, 2, [](const ExprVector& x, const ExprVector& v, const ExprVector&, const Expr&) {
        return equations({v[0] - 1, x[0] - 2});
      });
  const ConstraintLadder here = discrete(system, at({0.3}), 0.5, 0.1);
  BOOST_TEST(to_string(here.verdict) == "inconsistent");
  BOOST_TEST((dimensions(here) == Dimensions{{0, 0}, {-1, -1}}));
}

BOOST_AUTO_TEST_CASE(arguments_are_checked) {
  const SystemPointer pendulum = cartesian_pendulum();
  BOOST_CHECK_THROW(discrete(pendulum, at({0.6, -0.8, 0.1, 0.3}), 0.5, 0.0), std::invalid_argument);
  BOOST_CHECK_THROW(discrete(pendulum, at({0.6, -0.8}), 0.5, 0.1), std::invalid_argument);
  const auto elsewhere = std::make_shared<Theta>(std::make_shared<Sphere>(2), 0.5);
  BOOST_CHECK_THROW(
      DiscreteConstraintAlgorithm().run(pendulum, elsewhere, 0.1, at({0.6, -0.8, 0.1, 0.3})),
      std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_missing_system_or_map_is_refused) {
  const auto map = std::make_shared<Theta>(cartesian_pendulum()->manifold(), 0.5);
  const DiscreteConstraintAlgorithm algorithm;
  BOOST_CHECK_THROW(algorithm.run(nullptr, map, 0.1, at({0.6, -0.8, 0.1, 0.3})),
                    std::invalid_argument);
  BOOST_CHECK_THROW(algorithm.run(cartesian_pendulum(), nullptr, 0.1, at({0.6, -0.8, 0.1, 0.3})),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
