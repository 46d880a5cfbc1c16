#include "courant/extensions/spice/netlist_operating_point.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <random>

namespace courant {
// Mistakes that these cases have to notice:
//  * capacitors carry the current of a source
//  * inductors side by side have equal currents
BOOST_AUTO_TEST_SUITE(netlist_operating_point_test)

namespace {

using namespace netlist;
using Of = StaticElement::Kind;

StaticElement element(Of kind, std::size_t from, std::size_t to, double value) {
  return {.kind = kind, .from = from, .to = to, .value = value};
}
StaticElement diode(std::size_t from, std::size_t to, double saturation = 1e-14) {
  StaticElement result = element(Of::diode, from, to, saturation);
  result.scale = 0.02586492;
  result.leak = 1e-12;
  return result;
}

OperatingPoint found(const StaticCircuit& circuit) {
  const auto result = operating_point(circuit);
  BOOST_REQUIRE(std::holds_alternative<OperatingPoint>(result));
  return std::get<OperatingPoint>(result);
}
NoOperatingPoint none(const StaticCircuit& circuit) {
  const auto result = operating_point(circuit);
  BOOST_REQUIRE(std::holds_alternative<NoOperatingPoint>(result));
  return std::get<NoOperatingPoint>(result);
}

bool is_near(double value, double expected, double bound = 1e-12) {
  return std::abs(value - expected) <= bound * std::max(1e-12, std::abs(expected));
}

// The largest sum of currents at a node, of those of R, D, V, L and I, and the largest error of a law,
// both relative.
double defect(const StaticCircuit& circuit, const OperatingPoint& point) {
  VectorXd sum = VectorXd::Zero(point.potential.size());
  double law = 0.0;
  for (std::size_t k = 0; k < circuit.elements.size(); ++k) {
    const StaticElement& each = circuit.elements[k];
    const auto from = static_cast<Index>(each.from), to = static_cast<Index>(each.to);
    const double i = point.current[static_cast<Index>(k)];
    const double v = point.potential[from] - point.potential[to];
    sum[from] += i;
    sum[to] -= i;
    if (each.kind == Of::voltage) law = std::max(law, std::abs(v - each.value));
    if (each.kind == Of::inductor) law = std::max(law, std::abs(v));
    if (each.kind == Of::resistor) law = std::max(law, std::abs(v - each.value * i));
  }
  return std::max(
      law / point.potential.cwiseAbs().maxCoeff(),
      sum.tail(sum.size() - 1).cwiseAbs().maxCoeff() / point.current.cwiseAbs().maxCoeff());
}

}  // namespace

BOOST_AUTO_TEST_CASE(linear_circuits) {
  // 6 V over 1 kΩ and 2 kΩ, a capacitor beside the latter, an inductor before it.
  const OperatingPoint divider =
      found({.nodes = 4,
             .elements = {element(Of::voltage, 1, 0, 6.0), element(Of::resistor, 1, 2, 1e3),
                          element(Of::inductor, 2, 3, 1e-3), element(Of::resistor, 3, 0, 2e3),
                          element(Of::capacitor, 3, 0, 1e-6)}});
  BOOST_TEST(is_near(divider.potential[2], 4.0));
  BOOST_TEST(is_near(divider.potential[3], 4.0));
  BOOST_TEST(is_near(divider.current[2], 2e-3));
  BOOST_TEST(is_near(divider.current[0], -2e-3));
  BOOST_TEST(divider.current[4] == 0.0);

  // E: an inverting amplifier of gain A = 1e5: -R₂/R₁ / (1 + (1 + R₂/R₁)/A) for 1 V.
  StaticElement amplifier = element(Of::voltage, 3, 0, 0.0);
  amplifier.gain = 1e5;
  amplifier.control_to = 2;
  const OperatingPoint inverted =
      found({.nodes = 4,
             .elements = {element(Of::voltage, 1, 0, 1.0), element(Of::resistor, 1, 2, 1e3),
                          element(Of::resistor, 2, 3, 1e4), amplifier}});
  BOOST_TEST(is_near(inverted.potential[3], -10.0 / (1.0 + 11.0 / 1e5)));

  // F: 3 times the current of a source, through 100 Ω; that current is -1/50 A.
  StaticElement mirror = element(Of::current, 0, 2, 0.0);
  mirror.gain = 3.0;
  mirror.control = 0;
  const OperatingPoint mirrored =
      found({.nodes = 3,
             .elements = {element(Of::voltage, 1, 0, 1.0), element(Of::resistor, 1, 0, 50.0),
                          element(Of::resistor, 2, 0, 100.0), mirror}});
  BOOST_TEST(is_near(mirrored.potential[2], -6.0));
  BOOST_TEST(is_near(mirrored.current[3], -0.06));
}

// Capacitors in series divide a voltage, inductors side by side a current, as from rest.
BOOST_AUTO_TEST_CASE(what_direct_currents_leave_open) {
  const OperatingPoint series =
      found({.nodes = 3,
             .elements = {element(Of::voltage, 1, 0, 5.0), element(Of::capacitor, 1, 2, 1e-6),
                          element(Of::capacitor, 2, 0, 4e-6)}});
  BOOST_TEST(is_near(series.potential[2], 1.0));
  StaticCircuit parallel{
      .nodes = 3,
      .elements = {element(Of::voltage, 1, 0, 5.0), element(Of::resistor, 1, 2, 1e3),
                   element(Of::inductor, 2, 0, 1e-3), element(Of::inductor, 2, 0, 4e-3)}};
  BOOST_TEST(is_near(found(parallel).current[2], 4e-3));
  BOOST_TEST(is_near(found(parallel).current[3], 1e-3));
  // M = 0.5 mH: equal fluxes L₁ i₁ + M i₂ = M i₁ + L₂ i₂.
  parallel.couplings = {{2, 3, 0.5e-3}};
  BOOST_TEST(is_near(found(parallel).current[2], 5e-3 * 3.5 / 4.0));

  const NoOperatingPoint loop =
      none({.nodes = 2,
            .elements = {element(Of::voltage, 1, 0, 5.0), element(Of::inductor, 1, 0, 1e-3)}});
  BOOST_TEST(loop.elements == (std::vector<std::size_t>{0, 1}));
  const NoOperatingPoint cut =
      none({.nodes = 2,
            .elements = {element(Of::current, 0, 1, 1e-3), element(Of::capacitor, 1, 0, 1e-6)}});
  BOOST_TEST(cut.elements == (std::vector<std::size_t>{0, 1}));
}

BOOST_AUTO_TEST_CASE(held_nodes) {
  StaticCircuit circuit{
      .nodes = 3,
      .elements = {element(Of::voltage, 1, 0, 5.0), element(Of::resistor, 1, 2, 1e3),
                   element(Of::resistor, 2, 0, 1e3)},
      .held = {{2, 1.0}}};
  BOOST_TEST(is_near(found(circuit).potential[2], 1.0));
  circuit.held[0].node = 1;  // at a source, which is stronger
  BOOST_TEST(is_near(found(circuit).potential[2], 2.5));
}

// The voltage and the current of a diode from their closed form: v = s ln(1 + i/I) with i from the
// resistor.
BOOST_AUTO_TEST_CASE(diodes) {
  for (const double source : {0.3, 1.0, 12.0, 1e3, -5.0}) {
    const StaticCircuit circuit{.nodes = 3,
                                .elements = {element(Of::voltage, 1, 0, source),
                                             element(Of::resistor, 1, 2, 1e3), diode(2, 0)}};
    const OperatingPoint point = found(circuit);
    const double v = point.potential[2], i = (source - v) / 1e3;
    BOOST_TEST(std::abs(1e-14 * std::expm1(v / 0.02586492) + 1e-12 * v - i) <=
               1e-9 * std::abs(i) + 1e-18);
    BOOST_TEST(defect(circuit, point) < 1e-6);
  }
}

// A bridge over 325 V, stacks of diodes across a source, and ladders of diodes in both directions of
// every size, which full steps of Newton's method miss.
BOOST_AUTO_TEST_CASE(circuits_that_newton_misses) {
  StaticCircuit bridge{.nodes = 5,
                       .elements = {element(Of::voltage, 1, 2, 325.0), diode(1, 3), diode(2, 3),
                                    diode(4, 1), diode(4, 2), element(Of::resistor, 3, 4, 100.0),
                                    element(Of::resistor, 4, 0, 1e3)}};
  const OperatingPoint rectified = found(bridge);
  BOOST_TEST(defect(bridge, rectified) < 1e-9);
  BOOST_TEST(std::abs(rectified.potential[3] - rectified.potential[4] - 323.3) < 0.2);

  for (const int count : {1, 3, 30, 200}) {
    StaticCircuit stack{.nodes = static_cast<std::size_t>(count) + 1,
                        .elements = {element(Of::voltage, 1, 0, 0.9 * count)}};
    for (int k = 0; k < count; ++k)
      stack.elements.push_back(diode(static_cast<std::size_t>(k) + 1,
                                     k + 1 == count ? 0 : static_cast<std::size_t>(k) + 2));
    const OperatingPoint point = found(stack);
    BOOST_TEST(is_near(point.current[1], 1e-14 * std::expm1(0.9 / 0.02586492), 1e-6));
  }

  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-1.0, 5.0), voltage(-100.0, 100.0);
  for (int trial = 0; trial < 50; ++trial) {
    StaticCircuit ladder{.nodes = 22, .elements = {element(Of::voltage, 1, 0, voltage(random))}};
    for (std::size_t k = 1; k < 21; ++k) {
      ladder.elements.push_back(element(Of::resistor, k, k + 1, std::pow(10.0, exponent(random))));
      const bool forward = voltage(random) > 0.0;
      const std::size_t other = voltage(random) > 0.0 ? 0 : k;
      if (other != 0 || k > 1)
        ladder.elements.push_back(diode(forward ? k + 1 : other, forward ? other : k + 1,
                                        std::pow(10.0, -8.0 - exponent(random))));
    }
    BOOST_TEST(defect(ladder, found(ladder)) < 1e-7);
  }
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
