#include "courant/structures/elements/mos_channel.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

namespace courant::elements {
BOOST_AUTO_TEST_SUITE(mos_channel_test)

namespace {

const MosChannel channel{
    .threshold = 0.8, .transconductance = 3e-4, .modulation = 0.05, .body = 0.6, .surface = 0.7};

double current(double v_gs, double v_ds, double v_bs) {
  return channel.current(v_gs, v_ds, v_bs).value();
}

}  // namespace

BOOST_AUTO_TEST_CASE(three_regions) {
  const double onset = 0.8 + 0.6 * (std::sqrt(0.7 + 2.0) - std::sqrt(0.7)), a = 3.0 - onset;
  BOOST_TEST(current(onset - 0.01, 2.0, -2.0) == 0.0);
  BOOST_TEST(std::abs(current(3.0, 4.0, -2.0) / (1.5e-4 * a * a * 1.2) - 1.0) < 1e-13);
  BOOST_TEST(std::abs(current(3.0, 0.5, -2.0) / (3e-4 * 0.5 * (a - 0.25) * 1.025) - 1.0) < 1e-13);
}

// The two ends of a channel are alike: with drain and source exchanged the current turns round.
BOOST_AUTO_TEST_CASE(ends_change_places) {
  for (const double v_ds : {-3.0, -0.4, 0.2, 2.5})
    BOOST_TEST(std::abs(current(2.5, v_ds, -1.0) + current(2.5 - v_ds, -v_ds, -1.0 - v_ds)) <
               1e-18);
}

// Without a jump of the current or of its slope where regions meet.
BOOST_AUTO_TEST_CASE(regions_meet_smoothly) {
  constexpr double h = 1e-6;
  const auto is_smooth = [&](const auto& f, double at) {
    const double left = (f(at) - f(at - h)) / h, right = (f(at + h) - f(at)) / h;
    return std::abs(f(at + 1e-12) - f(at - 1e-12)) < 1e-14 && std::abs(left - right) < 1e-8;
  };
  const double onset = 0.8 + 0.6 * (std::sqrt(0.7 + 1.0) - std::sqrt(0.7));
  BOOST_TEST(is_smooth([](double v) { return current(2.0, v, -1.0); }, 2.0 - onset));
  BOOST_TEST(is_smooth([](double v) { return current(2.0, v, -1.0); }, 0.0));
  BOOST_TEST(is_smooth([](double v) { return current(v, 3.0, -1.0); }, onset));
  BOOST_TEST(is_smooth([](double v) { return current(2.0, 3.0, v); }, 0.0));
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::elements
