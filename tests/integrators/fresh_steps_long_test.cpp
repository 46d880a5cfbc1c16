// Law P5 along 2500 steps, of compositions along 1000 of those that they are made of: a step is that of
// a fresh stepper, whatever was done before. Some methods are unstable at these steps: once a state has
// grown to four times its size, steps are too long, and the curve begins again. At eight times Method 2
// with theta = 0.3 turns a pendulum by more than a radian a step, and lands elsewhere than a fresh
// stepper does.
#include <boost/test/unit_test.hpp>

#include "courant/integrators/methods/composition.hpp"
#include "courant/manifolds/manifold.hpp"
#include "step/integrator_catalogue.hpp"

BOOST_AUTO_TEST_SUITE(fresh_steps_long_test)

using namespace courant;

BOOST_AUTO_TEST_CASE(of_every_integrator_of_the_catalogue) {
  for (const auto& [name, integrator, setting, both_ways] : test::integrator_catalogue()) {
    if (setting.is_gauge) continue;
    const Manifold& M = *integrator->system()->manifold();
    const auto stepper = integrator->stepper();
    const auto* composed = dynamic_cast<const Composition*>(integrator.get());
    const auto parts = composed ? std::ssize(Composition::coefficients(composed->order())) : 1;
    const long steps = composed ? 1000 / parts : 2500;
    State state = setting.initial;
    double worst = 0.0;
    long made = 0;
    try {
      for (; made < steps; ++made) {
        const State fresh = integrator->advance(state, setting.step);
        stepper->step(state, setting.step);
        worst = std::max(worst, M.separation(fresh.x, state.x) / (1.0 + state.x.norm()));
        if (state.x.norm() > 4.0 * (1.0 + setting.initial.x.norm())) state = setting.initial;
      }
    } catch (const SolveError& error) {
      BOOST_TEST(false, name << ": " << error.what());
    }
    BOOST_TEST(made == steps, name);
    BOOST_TEST(worst < 1e-10 * static_cast<double>(parts), name << ": " << worst);
  }
}

BOOST_AUTO_TEST_SUITE_END()
