#include <boost/test/unit_test.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "courant/reading/experiment.hpp"
#include "courant/running/consistent_start.hpp"

namespace courant {
// Mistakes that these cases have to notice:
//  * a junction without charge is taken for the edge of a switch
//  * on the way to derivatives of a start voltages of junctions move by volts, and no start is reached
//  * a transistor without voltage is looked at with one of 10⁶ V, which conductances of 10⁻¹² S would need to matter
//  * around a start, in units of what junctions conduct by elsewhere, numbers leave the range of doubles
BOOST_AUTO_TEST_SUITE(junction_starts_test)

namespace {

Json element(const char* type, const char* name, const char* from, const char* to,
             const Json& value) {
  return {{"type", type}, {"name", name}, {"from", from}, {"to", to}, {"value", value}};
}

Json transistor(const char* name, const char* collector, const char* base, const char* emitter,
                const Json& more) {
  Json made = {{"type", "bipolar-transistor"},
               {"name", name},
               {"collector", collector},
               {"base", base},
               {"emitter", emitter}};
  made.update(more);
  return made;
}

// From what is typed: no charges, or those given.
void check_starts(const Json& nodes, const Json& elements, const Json& initial = Json::object()) {
  const Json experiment = {
      {"system", {{"type", "network"}, {"nodes", nodes}, {"elements", elements}}},
      {"initial", initial}};
  const ConstraintLadder ladder = consistent_start(read_experiment(experiment.dump()));
  BOOST_TEST((ladder.verdict == Verdict::regular), ladder.reason);
  BOOST_TEST(!ladder.is_ambiguous());
  BOOST_TEST(ladder.moves.empty());
  // No charge is the round-off of a search.
  for (const double charge : ladder.point.x)
    BOOST_TEST((charge == 0.0 || std::abs(charge) > 1e-30), charge);
}

const Json charges = {{"emitter_capacitance", 1e-12},
                      {"collector_capacitance", 1e-12},
                      {"forward_transit", 1e-10},
                      {"reverse_transit", 1e-8}};

}  // namespace

BOOST_AUTO_TEST_CASE(a_diode_with_a_charge_starts_without_it) {
  Json diode = element("diode", "D", "b", "0", nullptr);
  diode.erase("value");
  diode.update({{"capacitance", 1e-12}, {"transit", 1e-10}});
  check_starts({"0", "a", "b"}, {element("voltage-source", "V", "a", "0", 5),
                                 element("resistor", "R", "a", "b", 1e3), diode});
}

BOOST_AUTO_TEST_CASE(an_inverter_starts_without_charges) {
  check_starts(
      {"0", "vcc", "in", "b", "c", "inner_c", "inner_b"},
      {element("voltage-source", "Vcc", "vcc", "0", 5),
       element("voltage-source", "Vin", "in", "0", 0), element("resistor", "Rb", "in", "b", 1e4),
       element("resistor", "Q1_rc", "c", "inner_c", 10),
       element("resistor", "Q1_rb", "b", "inner_b", 50),
       transistor("Q1", "inner_c", "inner_b", "0", charges),
       element("resistor", "Rc", "vcc", "c", 1e3)});
}

// Of a common emitter, with two capacitors in a loop with the charges of the transistor.
BOOST_AUTO_TEST_CASE(an_oscillator_of_colpitts_starts_from_nothing) {
  check_starts(
      {"0", "vcc", "b", "c", "e"},
      {element("voltage-source", "Vcc", "vcc", "0", 5), element("resistor", "R1", "vcc", "b", 1e4),
       element("resistor", "R2", "b", "0", 1e4), element("capacitor", "Cb", "b", "0", 1e-7),
       transistor("Q1", "c", "b", "e",
                  {{"emitter_capacitance", 5e-12},
                   {"collector_capacitance", 3e-12},
                   {"forward_transit", 3e-10}}),
       element("resistor", "Re", "e", "0", 1e3), element("inductor", "L1", "vcc", "c", 1e-5),
       element("capacitor", "C1", "c", "e", 1e-9), element("capacitor", "C2", "e", "0", 1e-9)});
}

BOOST_AUTO_TEST_CASE(a_differential_pair_starts_from_nothing) {
  const Json more = {{"emitter_capacitance", 3e-12},
                     {"collector_capacitance", 2e-12},
                     {"forward_transit", 3e-10},
                     {"early_forward", 50}};
  check_starts(
      {"0", "p", "n", "b1", "b2", "c1", "c2", "e"},
      {element("voltage-source", "Vp", "p", "0", 12),
       element("voltage-source", "Vn", "n", "0", -12), element("resistor", "RB1", "b1", "0", 1e3),
       element("resistor", "RB2", "b2", "0", 1e3), transistor("Q1", "c1", "b1", "e", more),
       transistor("Q2", "c2", "b2", "e", more), element("resistor", "RC1", "p", "c1", 1e4),
       element("resistor", "RC2", "p", "c2", 1e4), element("resistor", "RE", "e", "n", 1e4)});
}

// Two of the transistors are without voltage, and nodes conduct by the leaks of junctions alone.
BOOST_AUTO_TEST_CASE(a_ring_of_inverters_starts_from_its_charges) {
  Json elements = {element("voltage-source", "VDD", "vdd", "0", 3)};
  const std::vector<std::vector<const char*>> inverters = {{"N1", "P1", "a", "b", "DN1", "DP1"},
                                                           {"N2", "P2", "b", "c", "DN2", "DP2"},
                                                           {"N3", "P3", "c", "a", "DN3", "DP3"}};
  const auto channel = [&](const char* name, const char* gate, const char* drain, const char* well,
                           const char* polarity, double threshold, double conductance) {
    elements.push_back({{"type", "mos-transistor"},
                        {"name", name},
                        {"drain", drain},
                        {"gate", gate},
                        {"source", well},
                        {"bulk", well},
                        {"polarity", polarity},
                        {"threshold", threshold},
                        {"transconductance", conductance},
                        {"modulation", 0.05}});
  };
  const auto junction = [&](const char* name, const char* from, const char* to) {
    Json diode = element("diode", name, from, to, nullptr);
    diode.erase("value");
    diode.update({{"saturation", 1e-14}, {"thermal_voltage", 0.02586492}, {"leak", 1e-12}});
    elements.push_back(diode);
  };
  for (const auto& inverter : inverters) {
    channel(inverter[0], inverter[2], inverter[3], "0", "n", 0.7, 2.2e-4);
    junction(inverter[4], "0", inverter[3]);
    channel(inverter[1], inverter[2], inverter[3], "vdd", "p", -0.7, 2e-4);
    junction(inverter[5], inverter[3], "vdd");
  }
  for (const auto& [name, node] :
       std::vector<std::pair<const char*, const char*>>{{"C1", "a"}, {"C2", "b"}, {"C3", "c"}})
    elements.push_back(element("capacitor", name, node, "0", 1e-14));
  check_starts({"0", "vdd", "b", "a", "c"}, elements, {{"q_C1", 0}, {"q_C2", 3e-14}, {"q_C3", 0}});
}

BOOST_AUTO_TEST_SUITE_END()

}  // namespace courant
