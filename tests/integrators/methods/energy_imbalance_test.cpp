#include "courant/integrators/methods/energy_imbalance.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

#include "../step/integrator_catalogue.hpp"

namespace courant {
BOOST_AUTO_TEST_SUITE(energy_imbalance_test)

namespace {

const test::IntegratorEntry& entry(const std::string& name) {
  static const auto table = test::integrator_catalogue();
  const auto found = std::ranges::find_if(table, [&](const auto& e) { return e.name == name; });
  BOOST_REQUIRE(found != table.end());
  return *found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(discrete_gradients_balance_and_the_midpoint_rule_does_not) {
  const auto& exact = entry("discrete-gradient, gonzalez, midpoint: open port");
  for (const double factor : {1.0, -0.1})
    BOOST_TEST(energy_imbalance(*exact.integrator, exact.setting, factor * exact.setting.step) <
               1e-12);
  const auto& midpoint = entry("discretize-first, midpoint: driven pendulum");
  const double once = energy_imbalance(*midpoint.integrator, midpoint.setting, 0.02);
  BOOST_TEST(once > 1e-9);
  // Of a step it is of order 3.
  const double half = energy_imbalance(*midpoint.integrator, midpoint.setting, 0.01);
  BOOST_TEST(half < 0.2 * once);
}

BOOST_AUTO_TEST_CASE(systems_without_energy_have_no_balance) {
  const auto& rod = entry("constrain-first, midpoint: Cartesian pendulum");
  BOOST_CHECK_THROW(energy_imbalance(*rod.integrator, rod.setting, rod.setting.step),
                    std::domain_error);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
