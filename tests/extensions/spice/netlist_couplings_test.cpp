#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "netlist_bodies.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a coil on one core keeps its storage beside the transformer
//  * the element that a source is controlled by is the next one in the netlist
BOOST_AUTO_TEST_SUITE(netlist_couplings_test)

namespace {

using namespace netlist;

const std::string kCoils = "V1 a 0 1\nL1 a 0 4m\nL2 b 0 1m\nL3 c 0 9m\nR2 b 0 1\nR3 c 0 1\n";

std::string ratio(const NetlistCircuit& circuit, std::size_t element) {
  return circuit.elements.at(element).at("ratio").get<std::string>();
}

}  // namespace

// M = k √(L₁ L₂) for the operating point; what the network has is the coupling.
BOOST_AUTO_TEST_CASE(coils_that_are_coupled_in_part_keep_their_fluxes) {
  const NetlistCircuit circuit = circuit_of(kCoils + "K1 L1 L2 0.5\nK2 L2 L3 -0.25");
  BOOST_TEST(circuit.storages.size() == 3u);
  BOOST_TEST_REQUIRE(circuit.fixed.couplings.size() == 2u);
  BOOST_TEST(std::abs(circuit.fixed.couplings[0].mutual - 1e-3) < 1e-18);
  BOOST_TEST(std::abs(circuit.fixed.couplings[1].mutual + 0.75e-3) < 1e-18);
  BOOST_TEST(circuit.elements.back().at("type") == "mutual-inductance");
  BOOST_TEST(circuit.elements.back().at("inductors") == Json({"L2", "L3"}));
  BOOST_TEST(circuit.elements.back().at("coupling") == -0.25);
}

// One flux: √(4/1) = 2 and √(4/9) = 2/3 windings of the first for one of the others.
BOOST_AUTO_TEST_CASE(coils_on_one_core_are_one_beside_transformers) {
  const NetlistCircuit circuit = circuit_of(kCoils + "K1 L1 L2 L3 1");
  BOOST_TEST_REQUIRE(circuit.storages.size() == 1u);
  BOOST_TEST(circuit.storages[0].state == "phi_L1");
  BOOST_TEST_REQUIRE(circuit.elements.size() == 6u);
  BOOST_TEST(circuit.element_lines.size() == 6u);
  BOOST_TEST(std::abs(circuit.value_of(ratio(circuit, 4), 1) - 2.0) < 1e-15);
  BOOST_TEST(std::abs(circuit.value_of(ratio(circuit, 5), 1) - 2.0 / 3.0) < 1e-15);
  BOOST_TEST(circuit.elements[5].at("secondary") == Json({"c", "0"}));
  const NetlistCircuit turned = circuit_of(kCoils + "K1 L1 L2 -1\nK2 L1 L3 1\nK3 L2 L3 -1");
  BOOST_TEST(std::abs(turned.value_of(ratio(turned, 4), 1) + 2.0) < 1e-15);
}

BOOST_AUTO_TEST_CASE(sources_find_the_elements_that_control_them) {
  const NetlistCircuit circuit = circuit_of(
      "F1 b 0 V2 3\nV1 a 0 1\nR1 a 0 1\nV2 a c 0\nR2 c 0 1\nR3 b 0 1\n"
      "B1 d 0 V=2*I(V2) + V(a)\nR4 d 0 1");
  BOOST_TEST(circuit.fixed.elements[0].control.value() == 3u);
  const auto& controls = circuit.fixed.elements[6].law->controls;
  BOOST_TEST_REQUIRE(controls.size() == 2u);
  std::size_t currents = 0;
  for (const auto& control : controls)
    if (control.element) {
      ++currents;
      BOOST_TEST(*control.element == 3u);
    }
  BOOST_TEST(currents == 1u);
}

BOOST_AUTO_TEST_CASE(couplings_that_no_core_has_are_refused) {
  BOOST_TEST(refusal(kCoils + "K1 L1 L2 1\nK2 L2 L3 0.1")
                 .starts_with("line 9: the inductors are coupled wholly"));
  BOOST_TEST(refusal(kCoils + "K1 L1 L2 1\nK2 L1 L3 1\nK3 L2 L3 -1") ==
             "line 10: the signs of the couplings on one core contradict each other");
  BOOST_TEST(refusal(kCoils + "K1 L1 L2 1\nK2 L2 L3 1")
                 .starts_with("line 5: the inductor L3 shares a core with L1"));
  BOOST_TEST(refusal("K1 L1 L9 0.5\nL1 a 0 1\nR1 a 0 1") ==
             "line 2: needs the inductor l9, which is not there");
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
