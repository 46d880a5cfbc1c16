#include "courant/reading/junction_charge.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace courant {
BOOST_AUTO_TEST_SUITE(junction_charge_test)

// dq/dv is the capacitance of SPICE, and v dq/dv the slope of the energy; both functions go over the end of the
// depletion without a corner.
BOOST_AUTO_TEST_CASE(slopes_are_capacitance_and_power) {
  const JunctionCharge junction{.capacitance = 4e-12,
                                .junction = 0.8,
                                .grading = 0.4,
                                .forward = 0.5,
                                .transit = 5e-9,
                                .saturation = 1e-14,
                                .scale = 0.026};
  const auto capacitance = [&](double v) {
    const double depletion = v < 0.4
                                 ? 4e-12 * std::pow(1.0 - v / 0.8, -0.4)
                                 : 4e-12 / std::pow(0.5, 1.4) * (1.0 - 0.5 * 1.4 + 0.4 * v / 0.8);
    return depletion + 5e-9 * 1e-14 / 0.026 * std::exp(v / 0.026);
  };
  constexpr double h = 1e-5;
  for (const double v : {-20.0, -1.0, 0.0, 0.3, 0.4, 0.5, 0.7}) {
    const auto slope = [&](auto&& f) { return (f(v + h) - f(v - h)) / (2.0 * h); };
    const double dq = slope([&](double at) { return junction.charge(at).value(); });
    const double dw = slope([&](double at) { return junction.energy(at).value(); });
    BOOST_TEST(std::abs(dq / capacitance(v) - 1.0) < 1e-5, v);
    BOOST_TEST(std::abs(dw - v * capacitance(v)) < 1e-5 * capacitance(v) * (std::abs(v) + 0.01), v);
  }
  BOOST_TEST(junction.charge(0.0).value() == 0.0);
  BOOST_TEST(junction.energy(0.0).value() == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
