#include "courant/integrators/methods/order_measurement.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../step/integrator_catalogue.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * no errors are round-off but those below 1e-12
//  * errors of any size that stay are round-off
BOOST_AUTO_TEST_SUITE(order_measurement_test)

namespace {

const test::IntegratorEntry& entry(const std::string& name) {
  static const auto table = test::integrator_catalogue();
  const auto found = std::ranges::find_if(table, [&](const auto& e) { return e.name == name; });
  BOOST_REQUIRE(found != table.end());
  return *found;
}

double distance(const State& a, const State& b) { return (a.x - b.x).norm(); }

}  // namespace

BOOST_AUTO_TEST_CASE(forward_and_back) {
  const auto& midpoint = entry("discretize-first, midpoint: driven pendulum");
  OrderMeasurement second(*midpoint.integrator, midpoint.setting.initial, distance);
  const auto& euler = entry("discretize-first, theta = 0: driven pendulum");
  OrderMeasurement first(*euler.integrator, euler.setting.initial, distance);
  for (const double h : {0.1, -0.1}) {
    BOOST_TEST(std::abs(second.errors(h).order - 2.0) < 0.05);
    BOOST_TEST(std::abs(first.errors(h).order - 1.0) < 0.05);
    BOOST_TEST(!second.errors(h).are_round_off);
    BOOST_TEST(!first.errors(h).are_round_off);
  }
}

// Each time is measured once.
BOOST_AUTO_TEST_CASE(once) {
  const auto& midpoint = entry("discretize-first, midpoint: driven pendulum");
  int count = 0;
  OrderMeasurement orders(*midpoint.integrator, midpoint.setting.initial,
                          [&](const State& a, const State& b) {
                            ++count;
                            return distance(a, b);
                          });
  orders.errors(0.1);
  const int once = count;
  BOOST_TEST(once == 5);
  orders.errors(0.1);
  BOOST_TEST(count == once);
  orders.errors(0.2);
  BOOST_TEST(count == 2 * once);
}

// Errors of 1e-9 that do not become smaller are round-off, though they are above 1e-12; as large as 1e-5 they are
// errors, and below 1e-12 there are none.
BOOST_AUTO_TEST_CASE(what_round_off_is) {
  const auto& midpoint = entry("discretize-first, midpoint: driven pendulum");
  const auto with = [&](double noise) {
    int calls = 0;
    OrderMeasurement orders(
        *midpoint.integrator, midpoint.setting.initial,
        [&](const State&, const State&) { return noise * (++calls % 2 == 0 ? 1.0 : 1.2); });
    return orders.errors(0.1);
  };
  BOOST_TEST(with(1e-9).are_round_off);
  BOOST_TEST(std::abs(with(1e-9).order) < 0.2);
  BOOST_TEST(!with(1e-5).are_round_off);
  BOOST_TEST(std::isinf(with(1e-13).order));
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
