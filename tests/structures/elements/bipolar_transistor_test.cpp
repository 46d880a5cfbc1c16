#include "courant/structures/elements/bipolar_transistor.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace courant::elements {
BOOST_AUTO_TEST_SUITE(bipolar_transistor_test)

// Where one junction blocks, currents have the ratio of the gain of the other, and the Early voltage is where the tangents of the
// characteristics meet.
BOOST_AUTO_TEST_CASE(gains_and_early_voltage) {
  BipolarTransistor law;
  law.saturation = 2e-15;
  law.forward_gain = 150.0;
  law.reverse_gain = 3.0;
  const double through = law.transport(0.65, -5.0).value();
  const double expected = 2e-15 * (std::exp(0.65 / 0.025852) - std::exp(-5.0 / 0.025852));
  BOOST_TEST(std::abs(through / expected - 1.0) < 1e-12);
  // But for the 1 in exp (v/s) - 1.
  BOOST_TEST(std::abs(through / law.emitter_current(0.65).value() / 150.0 - 1.0) < 2e-11);
  BOOST_TEST(std::abs(-law.transport(-5.0, 0.6).value() / law.collector_current(0.6).value() / 3.0 -
                      1.0) < 1e-9);
  law.early_forward = 60.0;
  const double near = law.transport(0.65, -1.0).value(), far = law.transport(0.65, -11.0).value();
  // The line through both is 0 where v_c = early_forward.
  BOOST_TEST(std::abs(near - (far - near) / 10.0 * 61.0) < 1e-12 * near);
}

// Far above the knee the current grows like the root of what it was without: i = √(i_f knee).
BOOST_AUTO_TEST_CASE(high_injection) {
  BipolarTransistor law;
  law.saturation = 1e-14;
  law.knee_forward = 1e-3;
  const double without = 1e-14 * std::exp(0.95 / 0.025852),
               with = law.transport(0.95, -5.0).value();
  BOOST_TEST(std::abs(with / std::sqrt(without * 1e-3) - 1.0) < 0.02);
  BOOST_TEST(law.transport(0.3, -5.0).value() < 1e-14 * std::exp(0.3 / 0.025852));
}

// What goes in by the terminals is never given back: v_e i_e + v_c i_c ≥ 0 with the currents of the branches.
BOOST_AUTO_TEST_CASE(power_is_lost) {
  BipolarTransistor law;
  law.early_forward = 50.0;
  law.early_reverse = 10.0;
  law.knee_forward = 1e-2;
  law.emitter_leak = {1e-13, 0.04};
  law.leak = 1e-12;
  for (double v_e = -5.0; v_e < 0.8; v_e += 0.11)
    for (double v_c = -5.0; v_c < 0.8; v_c += 0.11) {
      const double through = law.transport(v_e, v_c).value();
      const double power = v_e * (law.emitter_current(v_e).value() + through) +
                           v_c * (law.collector_current(v_c).value() - through);
      BOOST_TEST(power >= 0.0, v_e << ", " << v_c);
    }
}

// Both charges are slopes of one function of both voltages, and the energy is what they take: dE = v_e dq_e + v_c dq_c. At the
// emitter it is what τ i_f/q_b is more than τ i_f, but for the bend.
BOOST_AUTO_TEST_CASE(the_base_that_widens_stores_an_energy) {
  BipolarTransistor law;
  law.saturation = 1e-14;
  law.early_forward = 50.0;
  law.leak = 1e-3;  // that it is seen
  constexpr double transit = 3e-10, h = 1e-4;
  const auto at = [&](double v_e, double v_c) { return law.widening(transit, v_e, v_c); };
  const auto e = [&](double v_e, double v_c) { return at(v_e, v_c).at_emitter.value(); };
  const auto c = [&](double v_e, double v_c) { return at(v_e, v_c).at_collector.value(); };
  const auto energy = [&](double v_e, double v_c) { return at(v_e, v_c).energy.value(); };
  const auto is_near = [](double a, double b) { return std::abs(a - b) <= 1e-4 * std::abs(b); };
  for (const double v_e : {-2.0, 0.4, 0.7})
    for (const double v_c : {-10.0, -0.5, -0.07, 0.3}) {
      const auto by = [&](auto&& f, int which) {
        return which == 0 ? (f(v_e + h, v_c) - f(v_e - h, v_c)) / (2 * h)
                          : (f(v_e, v_c + h) - f(v_e, v_c - h)) / (2 * h);
      };
      BOOST_TEST(is_near(by(e, 1), by(c, 0)), v_e << ", " << v_c);
      for (const int which : {0, 1})
        BOOST_TEST(is_near(by(energy, which), v_e * by(e, which) + v_c * by(c, which)),
                   v_e << ", " << v_c);
      const double forward = 1e-14 * (std::exp(v_e / 0.025852) - 1.0) + 1e-3 * v_e;
      const double g = v_c > 0.0 ? 0.0 : v_c > -0.2 ? v_c * v_c / 20.0 : -(v_c + 0.1) / 50.0;
      BOOST_TEST(is_near(e(v_e, v_c), transit * forward * g), v_e << ", " << v_c);
    }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::elements
