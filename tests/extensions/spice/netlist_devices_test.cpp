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

// By hand: 1 kΩ below 1 V, 10 Ω above 3 V, the geometric middle of both at 2 V; and so by a current.
BOOST_AUTO_TEST_CASE(switches_go_over_between_two_resistances) {
  const NetlistCircuit circuit = circuit_of(
      "V1 a 0 1\nV2 g 0 1\nS1 a 0 g 0 sm\nW1 a 0 V2 wm on\n"
      ".model sm vswitch von=3 voff=1 ron=10 roff=1k\n.model wm iswitch ion=3 ioff=1 ron=10 "
      "roff=1k");
  for (const auto& [control, conductance] :
       {std::pair(-5.0, 1e-3), {0.9, 1e-3}, {2.0, 1e-2}, {3.1, 0.1}, {9.0, 0.1}})
    BOOST_TEST(
        std::abs(law_at(circuit, 2, {{1, 4.0}, {2, control}}) / (4.0 * conductance) - 1.0) < 1e-9,
        control);
  BOOST_TEST(circuit.elements[2].at("type") == "resistor");
  BOOST_TEST(circuit.elements[3].at("current").get<std::string>().find("i_V2") !=
             std::string::npos);
  BOOST_TEST(circuit.notes.empty());
}

// With vh a switch keeps its state between vt - vh and vt + vh.
BOOST_AUTO_TEST_CASE(switches_with_hysteresis_have_a_state) {
  const NetlistCircuit circuit = circuit_of(
      "V1 a 0 1\nV2 g 0 1\nR2 g 0 1\nS1 a 0 g 0 sm\nW1 a 0 V2 wm on\n"
      ".model sm sw vt=2 vh=1 ron=10 roff=1k\n.model wm csw it=2 ih=1 ron=10 roff=1k");
  BOOST_TEST_REQUIRE(circuit.switches.size() == 2u);
  const NetlistSwitch &by_voltage = circuit.switches[0], &by_current = circuit.switches[1];
  BOOST_TEST(by_voltage.below == 1.0);
  BOOST_TEST(by_voltage.above == 3.0);
  BOOST_TEST(!by_voltage.begins_on);
  BOOST_TEST(by_current.begins_on);
  BOOST_TEST(by_current.source.value() == 1u);
  BOOST_TEST(circuit.fixed.elements[by_voltage.element].value == 1e3);
  BOOST_TEST(circuit.fixed.elements[by_current.element].value == 10.0);
  BOOST_TEST(circuit.elements[3].at("current") == "v_S1/if(q_S1_on > 0.5, 10, 1000)");
}

// Where the control is between its thresholds the netlist says whether it is on, else they do; that of another switch may
// follow from it.
BOOST_AUTO_TEST_CASE(switches_begin_as_at_the_operating_point) {
  const auto begins = [](const std::string& control, const std::string& flag) {
    NetlistCircuit circuit =
        circuit_of("V1 a 0 10\nV2 g 0 " + control + "\nR1 a m 1k\nS1 m 0 g 0 sm " + flag +
                   "\nR2 a n 1k\nS2 n 0 m 0 sm\n.model sm sw vt=2 vh=1 ron=1 roff=1meg");
    set_switches(circuit.fixed, circuit.switches);
    return std::pair(circuit.switches[0].begins_on, circuit.switches[1].begins_on);
  };
  BOOST_TEST((begins("0.5", "on") == std::pair(false, true)));
  BOOST_TEST((begins("2", "") == std::pair(false, true)));
  BOOST_TEST((begins("2", "on") == std::pair(true, false)));
  BOOST_TEST((begins("4", "") == std::pair(true, false)));
  // A source of current charges a capacitor that its switch discharges: at rest it is neither on nor off.
  NetlistCircuit oscillator = circuit_of(
      "C1 a 0 1n\nI1 0 a 100u\nS1 a 0 a 0 sm\n.model sm sw vt=2.5 vh=2.475 ron=1 roff=10meg");
  BOOST_TEST(!set_switches(oscillator.fixed, oscillator.switches));
  BOOST_TEST(!oscillator.switches[0].begins_on);
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
