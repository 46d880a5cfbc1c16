#include "courant/integrators/methods/claimed_order.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "../step/integrator_catalogue.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the order of a stiff system is measured in long steps
//  * steps that are exact up to round-off have any order
//  * where round-off hides an order, longer steps are not asked
//  * an order may be that of any longer step
//  * the order of other steps than that of the setting may be any
BOOST_AUTO_TEST_SUITE(claimed_order_test)

namespace {

test::IntegratorEntry entry(const std::string& name) {
  static const auto table = test::integrator_catalogue();
  const auto found = std::ranges::find_if(table, [&](const auto& e) { return e.name == name; });
  BOOST_REQUIRE(found != table.end());
  return *found;
}

// The order of one integrator as another one, or what is left of it, might claim it.
struct Claim {
  explicit Claim(test::IntegratorEntry of, bool both_ways = true)
      : measured(std::move(of)), options{.both_ways = both_ways} {}
  ClaimedOrder operator()() const {
    return {*measured.integrator, measured.setting, options, separation};
  }

  test::IntegratorEntry measured;
  IntegratorLawOptions options;
  StateSeparation separation =
      StateSeparation(*measured.setting.system->manifold(), nullptr, measured.setting.initial.x);
};

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_claimed_is_measured_forward_and_back) {
  for (const char* name : {"discretize-first, midpoint: driven pendulum",
                           "discretize-first, theta = 0: driven pendulum"}) {
    const Claim claim(entry(name));
    ClaimedOrder order = claim();
    BOOST_TEST(std::abs(order.order() - claim.measured.integrator->order()) < 0.1);
    const ClaimedOrder::Defect defect = order.defect();
    BOOST_TEST(defect.value < 0.1);
    BOOST_TEST(!defect.order);
    BOOST_TEST(order.backward_defect() < 0.1);
  }
}

// The longest steps that are short next to a pendulum's swing show its order, and longer ones do not; parts of
// these do.
BOOST_AUTO_TEST_CASE(a_step_that_is_too_long_is_divided) {
  Claim claim(entry("discretize-first, midpoint: driven pendulum"));
  const auto is_off = [&](double step) {
    claim.measured.setting.step = step;
    return std::abs(claim().order() - 2.0) > ClaimedOrder::kTolerance;
  };
  double step = 0.1;
  while (step < 10.0 && !is_off(step)) step *= 1.25;
  BOOST_TEST_REQUIRE(step < 10.0);
  const ClaimedOrder::Defect defect = claim().defect();
  BOOST_TEST(defect.value <= ClaimedOrder::kTolerance);
  BOOST_TEST_REQUIRE(defect.order.has_value());
  BOOST_TEST(std::abs(*defect.order - 2.0) <= ClaimedOrder::kTolerance);
  BOOST_TEST(claim().backward_defect() <= ClaimedOrder::kTolerance);
}

// Steps of 1e-9 of the usual ones are exact up to round-off, and say nothing of an order.
BOOST_AUTO_TEST_CASE(steps_that_look_exact_have_any_order_but_the_one_to_be_seen) {
  Claim both(entry("discretize-first, midpoint: driven pendulum"));
  both.measured.setting.step *= 1e-9;
  BOOST_TEST(std::isinf(both().order()));
  BOOST_TEST(std::isinf(both().defect().value));
  Claim one(entry("discretize-first, midpoint: driven pendulum"), false);
  one.measured.setting.step *= 1e-9;
  BOOST_TEST(one().defect().value == 0.0);
}

BOOST_AUTO_TEST_CASE(gauge_has_no_order) {
  Claim claim(entry("discretize-first, midpoint: driven pendulum"));
  claim.measured.setting.step *= 1e-9;
  claim.measured.setting.is_gauge = true;
  BOOST_TEST(claim().defect().value == 0.0);
  BOOST_TEST(claim().backward_defect() == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
}  // namespace courant
