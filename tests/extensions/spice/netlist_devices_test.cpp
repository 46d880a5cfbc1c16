#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "netlist_bodies.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * the series resistance of a diode is not divided by its area
//  * a switch is on where its control is below the threshold
BOOST_AUTO_TEST_SUITE(netlist_devices_test)

namespace {

using namespace netlist;

// The static law of the last element at the values of its controls, in the order of the nodes in the formula.
double law_at(const NetlistCircuit& circuit, std::size_t element,
              const std::map<std::size_t, double>& potentials) {
  const StaticLaw& law = *circuit.fixed.elements.at(element).law;
  VectorXd u(static_cast<Index>(law.controls.size()));
  for (Index k = 0; k < u.size(); ++k)
    u[k] = potentials.at(law.controls[static_cast<std::size_t>(k)].node);
  return law.value(u).first;
}

}  // namespace

// Twice by area, three times by m: six in parallel.
BOOST_AUTO_TEST_CASE(areas_of_diodes) {
  const NetlistCircuit circuit = circuit_of(
      "V1 a 0 1\nD1 a 0 dm 2 m=3\n.model dm d is=2e-14 n=1.5 rs=12 cjo=1p tt=4n bv=5 ibv=1m");
  const auto& elements = circuit.elements;
  BOOST_TEST_REQUIRE(elements.size() == 3u);
  BOOST_TEST(circuit.value_of(elements[1].at("value").get<std::string>(), 1) == 2.0);
  BOOST_TEST(elements[2].at("from") == "d1_inside");
  BOOST_TEST(elements[2].at("emission") == 1.5);
  const StaticElement& fixed = circuit.fixed.elements[2];
  BOOST_TEST(std::abs(fixed.value / 12e-14 - 1.0) < 1e-12);
  BOOST_TEST(std::abs(fixed.scale - 1.5 * kThermalVoltage) < 1e-15);
  BOOST_TEST(fixed.breakdown_voltage == 5.0);
  BOOST_TEST(std::abs(fixed.breakdown - 6e-3) < 1e-15);
  BOOST_TEST_REQUIRE(circuit.junctions.size() == 1u);
  BOOST_TEST(circuit.junctions[0].state == "q_D1");
  BOOST_TEST(circuit.junctions[0].element == 2u);
  BOOST_TEST(std::abs(circuit.junctions[0].charge.capacitance - 6e-12) < 1e-24);
  BOOST_TEST(circuit.junctions[0].charge.transit == 4e-9);
  BOOST_TEST(circuit.junctions[0].charge.leak == kLeastConductance);
  BOOST_TEST(circuit_of("V1 a 0 1\nD1 a 0 dm\n.model dm d").junctions.empty());
}

// By hand: 1 kΩ below 2 V - 1 V, 10 Ω above 2 V + 1 V, the geometric middle of both at 2 V; and so by a current.
BOOST_AUTO_TEST_CASE(switches_go_over_between_two_resistances) {
  const NetlistCircuit circuit = circuit_of(
      "V1 a 0 1\nV2 g 0 1\nS1 a 0 g 0 sm\nW1 a 0 V2 wm on\n"
      ".model sm sw vt=2 vh=1 ron=10 roff=1k\n.model wm iswitch ion=3 ioff=1 ron=10 roff=1k");
  for (const auto& [control, conductance] :
       {std::pair(-5.0, 1e-3), {0.9, 1e-3}, {2.0, 1e-2}, {3.1, 0.1}, {9.0, 0.1}})
    BOOST_TEST(
        std::abs(law_at(circuit, 2, {{1, 4.0}, {2, control}}) / (4.0 * conductance) - 1.0) < 1e-9,
        control);
  BOOST_TEST(circuit.elements[2].at("type") == "resistor");
  BOOST_TEST(circuit.elements[3].at("current").get<std::string>().find("i_V2") !=
             std::string::npos);
  BOOST_TEST_REQUIRE(circuit.notes.size() == 1u);
  BOOST_TEST(circuit.notes[0].second.starts_with("the hysteresis of the switch has no memory"));
}

BOOST_AUTO_TEST_CASE(what_a_device_does_not_have_is_refused) {
  BOOST_TEST(refusal("D1 a 0 dm\n.model dm npn") ==
             "line 2: the model dm is of the type npn; expected d");
  BOOST_TEST(refusal("D1 a 0 dm\n.model dm d is=1 zz=2") ==
             "line 3: the parameter zz of a model of the type d is not supported");
  BOOST_TEST(refusal("S1 a 0 g 0 sm\n.model sm csw").starts_with("line 2: the model sm is of"));
  BOOST_TEST(refusal("W1 a 0 V9 wm\n.model wm csw") ==
             "line 2: needs the voltage source v9, which is not there");
  // Other kinds of M have other nodes.
  BOOST_TEST(
      refusal("M1 d g s power\n.model power vdmos") ==
      "line 2: the model power is of the type vdmos; expected nmos and pmos, with four nodes");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
