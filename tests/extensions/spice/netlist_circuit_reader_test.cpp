#include <boost/test/unit_test.hpp>
#include <string>

#include "netlist_bodies.hpp"

// Mistakes that these cases have to notice:
//  * an instance has the parameters of the one before
BOOST_AUTO_TEST_SUITE(netlist_circuit_reader_test)

using namespace courant;
using namespace courant::netlist;

BOOST_AUTO_TEST_CASE(elements_of_a_network_and_of_its_operating_point) {
  const NetlistCircuit circuit = circuit_of("V1 a 0 5\nR1 a b 2k\nC1 b gnd 1u ic=3");
  BOOST_TEST(circuit.nodes == Json({"0", "a", "b"}));
  BOOST_TEST(
      circuit.elements[1] ==
      Json({{"type", "resistor"}, {"name", "R1"}, {"from", "a"}, {"to", "b"}, {"value", 2000.0}}));
  BOOST_TEST(circuit.element_lines == std::vector<int>({2, 3, 4}),
             boost::test_tools::per_element());
  BOOST_TEST(circuit.fixed.nodes == 3u);
  BOOST_TEST((circuit.fixed.elements[2].kind == StaticElement::Kind::capacitor));
  BOOST_TEST(circuit.fixed.elements[2].to == 0u);
  BOOST_TEST_REQUIRE(circuit.storages.size() == 1u);
  BOOST_TEST(circuit.storages[0].state == "q_C1");
  BOOST_TEST(circuit.storages[0].given.value() == "3");
  BOOST_TEST(!circuit.at_rest);
  BOOST_TEST(circuit.times.end == 1e-3);
  BOOST_TEST(!circuit.resting.has_value());
}

// Of a subcircuit every instance has its own nodes, names and parameters.
BOOST_AUTO_TEST_CASE(instances_stand_in_the_places_of_subcircuits) {
  const NetlistCircuit circuit = circuit_of(
      ".param top=3\n.subckt part in out size=1\nR1 in mid {size*top}\nC1 mid out 1u\n.ends\n"
      "V1 a 0 0\nX1 a 0 part\nX2 a 0 part size=7");
  BOOST_TEST(circuit.nodes == Json({"0", "a", "x1_mid", "x2_mid"}));
  BOOST_TEST(circuit.nodes_by_name.at("x2.mid") == 3u);
  BOOST_TEST(circuit.elements[1].at("name") == "x1_R1");
  BOOST_TEST(circuit.elements[3].at("value") == "(x2_size*top)");
  BOOST_TEST(circuit.fixed.elements[1].value == 3.0);
  BOOST_TEST(circuit.fixed.elements[3].value == 21.0);
  BOOST_TEST(circuit.parameters.at("x1_size") == 1.0);
  BOOST_TEST(circuit.at_rest);
  BOOST_TEST(circuit.sources.size() == 1u);
}

BOOST_AUTO_TEST_CASE(controlled_sources) {
  const NetlistCircuit circuit =
      circuit_of("V1 a 0 1\nR1 a 0 1\nE1 b 0 a 0 2\nF1 b 0 V1 3\nC1 b 0 1");
  BOOST_TEST(circuit.elements[2].at("value") == "2*potential_a");
  BOOST_TEST(circuit.elements[3].at("value") == "3*i_V1");
  BOOST_TEST(circuit.fixed.elements[2].gain == 2.0);
  BOOST_TEST(circuit.fixed.elements[2].control_from == 1u);
  BOOST_TEST(circuit.fixed.elements[3].control.value() == 0u);
}

// k = 1: one flux, an ideal transformer beside the first inductor. k = ½: a mutual inductance.
BOOST_AUTO_TEST_CASE(coupled_inductors) {
  const std::string windings = "V1 a 0 1\nL1 a 0 4m\nL2 b 0 1m\nR1 b 0 1\nK1 L1 L2 ";
  const NetlistCircuit whole = circuit_of(windings + "1"), half = circuit_of(windings + "0.5");
  BOOST_TEST(whole.storages.size() == 1u);
  BOOST_TEST(whole.elements.size() == 4u);
  BOOST_TEST(whole.elements.back().at("type") == "ideal-transformer");
  BOOST_TEST(whole.elements.back().at("ratio") == "sqrt(0.004/(0.001))");
  BOOST_TEST(half.storages.size() == 2u);
  BOOST_TEST(half.elements.back().at("type") == "mutual-inductance");
  BOOST_TEST(std::abs(half.fixed.couplings[0].mutual - 1e-3) < 1e-18);
}

// By hand: two resistances of the model over the area, a substrate at the collector, charges at both junctions.
BOOST_AUTO_TEST_CASE(bipolar_transistors) {
  const NetlistCircuit circuit = circuit_of(
      "V1 a 0 5\nQ1 a a b 0 small 2\nQ2 0 a b big off\nR1 b 0 1\n"
      ".model small npn(is=1e-15 bf=50 rb=8 re=2 cje=1p cjc=2p cjs=3p ise=1e-13)\n"
      ".model big pnp(bf=20 vaf=30)");
  const auto& elements = circuit.elements;
  BOOST_TEST_REQUIRE(elements.size() == 7u);  // V1, two resistances, Q1, its substrate, Q2, R1
  BOOST_TEST(elements[1].at("name") == "Q1_rb");
  BOOST_TEST(elements[1].at("value") == "(8)/(2)");
  BOOST_TEST(elements[3].at("type") == "bipolar-transistor");
  BOOST_TEST(elements[3].at("collector") == "a");
  BOOST_TEST(elements[3].at("base") == "q1_rb_inside");
  BOOST_TEST(elements[3].at("emitter") == "q1_re_inside");
  BOOST_TEST(elements[3].at("emitter_leak") == "1e-13*2");
  BOOST_TEST(elements[4].at("type") == "diode");
  BOOST_TEST(elements[4].at("from") == "0");
  BOOST_TEST(elements[4].at("to") == "a");
  BOOST_TEST(elements[4].at("saturation") == 0.0);
  BOOST_TEST(elements[5].at("polarity") == "pnp");
  BOOST_TEST(elements[5].at("early_forward") == 30.0);
  BOOST_TEST(!elements[5].contains("emitter_capacitance"));
  BOOST_TEST(circuit.junctions.size() == 3u);
  BOOST_TEST(circuit.junctions[0].state == "q_be_Q1");
  BOOST_TEST(circuit.junctions[0].charge.capacitance == 2e-12);
  BOOST_TEST(refusal("Q1 a b 0 q\n.model q npn level=8")
                 .starts_with("line 3: a bipolar model of level 8"));
}

// From KP and the sides, or from how the silicon is doped: mobility 600 cm²/Vs and 3.9 ε₀/tox.
BOOST_AUTO_TEST_CASE(field_effect_transistors) {
  const NetlistCircuit circuit = circuit_of(
      "V1 a 0 5\nM1 a b 0 0 n1 l=3u w=30u ad=10p\nM2 a b a a p1 m=2\nR1 b 0 1\n"
      ".model n1 nmos(vto=0.7 kp=50u ld=0.5u cgdo=1n cj=1m)\n"
      ".model p1 pmos(level=1 vto=-0.8 tox=50n)");
  const auto& elements = circuit.elements;
  BOOST_TEST(elements[1].at("type") == "mos-transistor");
  BOOST_TEST(std::abs(elements[1].at("length").get<double>() - 2e-6) < 1e-20);
  BOOST_TEST(elements[1].at("transconductance") == 5e-5);
  BOOST_TEST(elements[2].at("name") == "M1_bulk_drain");
  BOOST_TEST(std::abs(circuit.value_of(elements[2].at("capacitance").dump(), 1) - 1e-14) < 1e-28);
  BOOST_TEST(elements[3].at("name") == "M1_gate_drain");  // the bulk is the source
  BOOST_TEST(std::abs(elements[3].at("value").get<double>() - 3e-14) < 1e-28);
  BOOST_TEST(elements[4].at("polarity") == "p");
  BOOST_TEST(elements[4].at("width") == 2e-4);
  BOOST_TEST(std::abs(elements[4].at("transconductance").get<double>() /
                          (0.06 * 3.9 * 8.854214871e-12 / 50e-9) -
                      1.0) < 1e-12);
  BOOST_TEST(!circuit.notes.empty());
  BOOST_TEST(refusal("M1 a b 0 0 n\n.model n nmos level=8") ==
             "line 3: a model of level 8 is not supported; expected level 1");
  BOOST_TEST(refusal("M1 a b 0 0 n l=1u\n.model n nmos ld=0.5u")
                 .starts_with("line 2: has a channel without length"));
}

// Values by the sides of a resistor or a capacitor, behind its model, or as an expression of potentials.
BOOST_AUTO_TEST_CASE(values_of_models) {
  const NetlistCircuit circuit = circuit_of(
      "V1 a 0 5\nR1 a b sheet l=11u w=2u\nR2 b 0 sheet 7k\nR3 b 0 {1+v(a)^2} \nC1 b 0 plate l=11u "
      "w=5u\n"
      "R4 a a 1\nR5 b 0 1 tc=1m,2u\n.model sheet r rsh=1000 narrow=1u\n"
      ".model plate c cj=1m cjsw=1u narrow=1u");
  BOOST_TEST(std::abs(circuit.fixed.elements[1].value - 1e4) < 1e-9);
  BOOST_TEST(circuit.fixed.elements[2].value == 7e3);
  BOOST_TEST(circuit.elements[3].at("value") == "(1+potential_a^2)");
  BOOST_TEST(std::abs(circuit.fixed.elements[4].value - (1e-3 * 40e-12 + 2e-6 * 14e-6)) < 1e-18);
  BOOST_TEST(circuit.elements.size() == 6u);
  BOOST_TEST(circuit.notes.size() == 2u);
}

// d/dt of a potential is the current of a capacitor of 1 F that a source holds at it.
BOOST_AUTO_TEST_CASE(derivatives_of_potentials) {
  const NetlistCircuit circuit = circuit_of("V1 a 0 5\nB1 b 0 V=2*ddt(V(a))\nR1 b 0 1");
  BOOST_TEST(circuit.elements.size() == 5u);
  BOOST_TEST(circuit.elements[1].at("value") == "potential_a");
  BOOST_TEST(circuit.elements[2].at("type") == "capacitor");
  BOOST_TEST(circuit.elements[3].at("value") ==
             "2*(-i_" + circuit.elements[1].at("name").get<std::string>() + ")");
  BOOST_TEST(circuit.storages.size() == 1u);
}

// A network needs a state.
BOOST_AUTO_TEST_CASE(a_circuit_without_storage_gets_one_that_rests) {
  const NetlistCircuit circuit = circuit_of("V1 a 0 1\nR1 a 0 1");
  BOOST_TEST(circuit.resting.value() == 2u);
  BOOST_TEST(circuit.name_of(2) == "rest");
  BOOST_TEST(circuit.elements.size() == 4u);
}

// What a subcircuit stands in, it sees, and others do not.
BOOST_AUTO_TEST_CASE(subcircuits_in_subcircuits) {
  const NetlistCircuit circuit = circuit_of(
      ".subckt part a b\nR1 a b 5\n.ends\n"
      ".subckt outer in out\n.subckt part a b\nR1 a b 7\nD1 a b dm\n.ends\n.model dm d is=3e-14\n"
      "X1 in out part\n.ends\nV1 c 0 1\nX1 c 0 outer\nX2 c 0 part");
  BOOST_TEST(circuit.elements[1].at("name") == "x1_x1_R1");
  BOOST_TEST(circuit.elements[1].at("value") == 7.0);
  BOOST_TEST(circuit.elements[2].at("saturation") == 3e-14);
  BOOST_TEST(circuit.elements[3].at("value") == 5.0);
  BOOST_TEST(refusal(".subckt outer a b\n.subckt inner a b\nR1 a b 1\n.ends\nR1 a b 1\n.ends\n"
                     "X1 c 0 inner") == "line 8: unknown subcircuit \"inner\"");
}

// A parameter that a subcircuit uses without declaring it is that of the instance, else of the outside.
BOOST_AUTO_TEST_CASE(parameters_that_are_used_undeclared) {
  const NetlistCircuit circuit = circuit_of(
      ".param r=2\n.subckt part a b\nR1 a b {r*k}\n.param k=10\n.ends\n"
      "V1 a 0 1\nX1 a 0 part\nX2 a 0 part r=3\nX3 a 0 part k=4");
  BOOST_TEST(circuit.fixed.elements[1].value == 20.0);
  BOOST_TEST(circuit.fixed.elements[2].value == 30.0);
  BOOST_TEST(circuit.fixed.elements[3].value == 8.0);
}

// SPICE has the step first; Gnucap the start, which is 0, or the end before a step. Without .tran there is a time all the same.
BOOST_AUTO_TEST_CASE(times) {
  const std::string body = "V1 a 0 1\nR1 a 0 1";
  const auto is = [&](const std::string& line, double step, double end, std::size_t notes = 0) {
    const NetlistCircuit circuit = circuit_of(body, line);
    BOOST_TEST(circuit.times.step == step, line);
    BOOST_TEST(circuit.times.end == end, line);
    BOOST_TEST(circuit.notes.size() == notes, line);
  };
  is(".tran 1u 1m", 1e-6, 1e-3);
  is(".tran 0 1m 1u", 1e-6, 1e-3);
  is(".tran 0 1", 0.01, 1.0);
  is(".tran 1m 1u", 1e-6, 1e-3);
  is(".tran 1u 1m 0 trace all", 1e-6, 1e-3, 1);
  is(".tran 1u 1m 20u", 1e-6, 1e-3, 1);
  is(".tran 1u 1m\n.tran trace all", 1e-6, 1e-3);
  is(".ac dec 10 1 1k", 1e-5, 1e-3);
  is(".control\ntran $&step 1\ntran 2u 2m\n.endc", 2e-6, 2e-3);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_built_is_refused_at_its_line) {
  BOOST_TEST(refusal("R1 a 0 1\nr1 a 0 2") == "line 3: the name r1 is that of line 2 again");
  BOOST_TEST(refusal("J1 a b c jf").starts_with("line 2: the element J1 is not supported"));
  BOOST_TEST(refusal("X1 a 0 part") == "line 2: unknown subcircuit \"part\"");
  BOOST_TEST(refusal(".subckt p a b\nx1 a b p\n.ends\nx1 a 0 p") ==
             "line 3: the subcircuit p contains itself");
  BOOST_TEST(refusal(".subckt p a b\nr1 a b 1\n.ends\nx1 a 0 c p") ==
             "line 5: has 3 nodes; the subcircuit p has 2");
  BOOST_TEST(refusal(".subckt p a b\nr1 a b 1\n.ends\nx1 a 0 p k=1") ==
             "line 5: the subcircuit p has no parameter k");
  BOOST_TEST(refusal("F1 a 0 V9 1") == "line 2: needs the voltage source v9, which is not there");
  BOOST_TEST(refusal("D1 a 0 dd") == "line 2: unknown model \"dd\"");
  BOOST_TEST(refusal("R1 a 0 {1/0}").starts_with("line 2: "));
}

BOOST_AUTO_TEST_CASE(numbers_are_written_as_numbers) {
  BOOST_TEST(written_value("4.7k") == Json(4700.0));
  BOOST_TEST(written_value("2*rx") == Json("2*rx"));
}

BOOST_AUTO_TEST_SUITE_END()
