#include "courant/structures/elements/junction_charge.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/function.hpp"

namespace courant::elements {
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
                                .scale = 0.026,
                                .leak = 1e-5};
  const auto capacitance = [&](double v) {
    const double depletion = v < 0.4
                                 ? 4e-12 * std::pow(1.0 - v / 0.8, -0.4)
                                 : 4e-12 / std::pow(0.5, 1.4) * (1.0 - 0.5 * 1.4 + 0.4 * v / 0.8);
    return depletion + 5e-9 * (1e-14 / 0.026 * std::exp(v / 0.026) + 1e-5);
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

// What equations of charges are written in: where the charge grows like an exponential it still grows like the voltage,
// by a factor near 1 from -30 V to 1 V.
BOOST_AUTO_TEST_CASE(charges_as_voltages) {
  constexpr double h = 1e-5;
  for (const double capacitance : {0.0, 3e-12})
    for (const auto& [transit, leak] : {std::pair(0.0, 0.0), {2e-8, 0.0}, {2e-8, 1e-12}}) {
      if (capacitance == 0.0 && transit == 0.0) continue;
      const JunctionCharge junction{.capacitance = capacitance,
                                    .junction = 0.7,
                                    .grading = 0.35,
                                    .transit = transit,
                                    .leak = leak};
      const auto at = [&](double v) { return junction.about_voltage(junction.charge(v)).value(); };
      for (const double v : {-30.0, -2.0, -0.1, 0.0, 0.2, 0.5, 0.65, 0.8, 1.0}) {
        if (capacitance == 0.0 && leak == 0.0 && v < 0.0) continue;  // nothing is stored there
        const double slope = (at(v + h) - at(v - h)) / (2.0 * h);
        BOOST_TEST((slope > 0.2 && slope < 4.0),
                   capacitance << ", " << transit << ", " << leak << ", " << v << ": " << slope);
        if (transit == 0.0 && v <= 0.0) BOOST_TEST(std::abs(at(v) - v) < 1e-12 * (1.0 - v));
      }
    }
}

// A junction without charge is at no edge, and derivatives are numbers for charges of any size.
BOOST_AUTO_TEST_CASE(no_charge_is_no_edge) {
  for (const double transit : {0.0, 2e-8}) {
    const JunctionCharge junction{
        .capacitance = 3e-12, .junction = 0.7, .grading = 0.35, .transit = transit};
    Graph graph;
    const ExprVector q = graph.variables("q", 1);
    ExprVector formulas(3);
    formulas[0] = junction.about_voltage(q[0]);
    for (Index k = 1; k < 3; ++k) formulas[k] = gradient(formulas[k - 1], q)[0];
    const Function function("about", {{"q", q}}, formulas);
    const auto at = [&](double charge) {
      VectorXd result(3);
      const double* in = &charge;
      function.value(&in, result.data());
      return result;
    };
    for (const double size : {1e-300, 1e-162, 1e-40, 1e-20, 1e-12, 1e-6, 1e3})
      for (const double charge : {-size, size}) BOOST_TEST(at(charge).allFinite(), charge);
    constexpr double little = 1e-20;
    BOOST_TEST(at(0.0).allFinite());
    for (Index k = 1; k < 3; ++k)
      BOOST_TEST(at(-little)[k] == at(little)[k], boost::test_tools::tolerance(1e-5));
  }
}

// Far below 0, where exp is less than the round-off of 1, the charge of a leak tells the voltage all the same.
BOOST_AUTO_TEST_CASE(a_charge_tells_the_voltage_of_a_junction_that_blocks) {
  const JunctionCharge with{.transit = 1e-9, .leak = 1e-12}, without{.transit = 1e-9};
  BOOST_TEST(with.charge(-2.0).value() < 1.9 * with.charge(-1.0).value() * (1.0 - 1e-3));
  BOOST_TEST(without.charge(-2.0).value() == without.charge(-1.0).value());
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant::elements
