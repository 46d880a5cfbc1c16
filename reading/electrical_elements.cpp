#include "courant/reading/element_parts.hpp"
#include "courant/structures/elements/electrical.hpp"

namespace courant {
namespace {

using namespace element_parts;

Key secondary() {
  return required_key("secondary", takes::array_of(takes::text(), 2, 2),
                      "the two nodes of the other side, from and to");
}

// The nodes of two sides.
std::vector<NetworkTerminal> with_secondary(ElementReader& reader) {
  const NetworkTerminal from = reader.node("from"), to = reader.node("to");
  const auto [other_from, other_to] = reader.pair("secondary");
  return {from, to, other_from, other_to};
}

std::optional<NetworkElement> read_resistor(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const std::string key = reader.one_of({"value", "voltage", "current"});
  const elements::Law law = reader.law(key);
  const Element resistor = key == "value"     ? elements::resistor(law)
                           : key == "voltage" ? elements::resistor_of_current(law)
                                              : elements::resistor_of_voltage(law);
  if (!reader.has("heat")) return reader.result(resistor, between);
  return reader.result(elements::heating(resistor), {"from", "to", "heat"});
}

std::optional<NetworkElement> read_capacitor(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  Element capacitor = elements::capacitor(elements::StateLaw());
  read_energy(reader, capacitor, "voltage");
  return reader.result(std::move(capacitor), between);
}

std::optional<NetworkElement> read_inductor(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  Element inductor = elements::inductor(elements::StateLaw());
  inductor.inductance = read_energy(reader, inductor, "current");
  return reader.result(std::move(inductor), between);
}

std::optional<NetworkElement> read_mutual_inductance(ObjectReader& object,
                                                     const NetworkSite& site) {
  ElementReader reader(object, site);
  const auto [first, second] = reader.pair("inductors");
  const std::string key = reader.one_of({"value", "coupling"});
  const double value = reader.constant(key);
  return reader.result({{first.node, second.node}, second.pointer, value, key == "coupling"});
}

std::optional<NetworkElement> read_diode(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  elements::JunctionCurrent law;
  law.saturation = reader.constant("saturation");
  const double emission = reader.positive("emission");
  law.scale = emission * reader.positive("thermal_voltage");
  law.leak = reader.constant("leak");
  law.breakdown = reader.constant("breakdown");
  law.breakdown_current = reader.constant("breakdown_current");
  const elements::JunctionCharge junction{.capacitance = reader.constant("capacitance"),
                                          .junction = reader.positive("junction"),
                                          .grading = reader.constant("grading"),
                                          .forward = reader.constant("forward"),
                                          .transit = reader.constant("transit"),
                                          .saturation = law.saturation,
                                          .scale = law.scale,
                                          .leak = law.leak};
  return reader.result(elements::diode(law, junction), between);
}

std::optional<NetworkElement> read_transformer(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const double ratio = reader.nonzero("ratio");
  return reader.result(elements::ideal_transformer(ratio), with_secondary(reader));
}

std::optional<NetworkElement> read_gyrator(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const double resistance = reader.constant("value");
  return reader.result(elements::gyrator(resistance), with_secondary(reader));
}

std::optional<NetworkElement> read_switch(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const double on = reader.positive("on"), off = reader.positive("off");
  auto closed = reader.formula("closed");
  if (!closed) return std::nullopt;
  // A condition is no number: `if` makes it one.
  closed->text = "if(" + closed->text + ", 1, 0)";
  return reader.result(elements::electrical_switch(reader.law_of(*closed), on, off), between);
}

}  // namespace

ElementKinds electrical_elements() {
  return {
      {{"resistor",
        "v = R i, or a law of its own",
        {name(), current_from(), current_to(),
         optional_key("value", takes::formula(), "R in Ω; may depend on anything"),
         optional_key("voltage", takes::formula(), "v in V as a function of the current i_<name>"),
         optional_key("current", takes::formula(), "i in A as a function of the voltage v_<name>"),
         optional_key("heat", takes::text(), "a thermal node that gets the entropy v i / T")},
        {{"value", "voltage", "current"}}},
       read_resistor},
      {{"capacitor",
        "a charge q_<name> in C",
        {name(), current_from(), current_to(),
         optional_key("value", takes::formula(), "C in F, a constant"),
         optional_key("energy", takes::formula(), "in J, as a function of the charge"),
         optional_key("voltage", takes::formula(), "in V, as a function of the charge")},
        {{"value", "energy", "voltage"}}},
       read_capacitor},
      {{"inductor",
        "a flux linkage phi_<name> in Wb",
        {name(), current_from(), current_to(),
         optional_key("value", takes::formula(), "L in H, a constant"),
         optional_key("energy", takes::formula(), "in J, as a function of the flux"),
         optional_key("current", takes::formula(), "in A, as a function of the flux")},
        {{"value", "energy", "current"}}},
       read_inductor},
      {{"mutual-inductance",
        "of two inductors that are given by their value",
        {name(),
         required_key("inductors", takes::array_of(takes::text(), 2, 2), "the names of both"),
         optional_key("value", takes::formula(), "M in H, a constant"),
         optional_key("coupling", takes::formula(), "M/√(L₁ L₂), between -1 and 1")},
        {{"value", "coupling"}}},
       read_mutual_inductance},
      {{"diode",
        "i = saturation (exp(v/(emission thermal_voltage)) - 1) + leak v, with a breakdown and a "
        "charge",
        {name(), current_from(), current_to(),
         default_key("saturation", takes::formula(), 1e-14, "in A; 0: it conducts nothing"),
         default_key("emission", takes::formula(), 1.0, "the emission coefficient"),
         default_key("thermal_voltage", takes::formula(), 0.025852, "k T/e in V"),
         default_key("leak", takes::formula(), 0.0, "a conductance beside it, in S"),
         default_key("breakdown", takes::formula(), 0.0,
                     "the reverse voltage of breakdown in V; 0: none"),
         default_key("breakdown_current", takes::formula(), 1e-3, "the current there, in A"),
         default_key("capacitance", takes::formula(), 0.0,
                     "C₀ of C₀/(1 - v/junction)^grading in F; with it or with transit there is a "
                     "charge q_<name>"),
         default_key("junction", takes::formula(), 1.0, "in V"),
         default_key("grading", takes::formula(), 0.5, "less than 1"),
         default_key("forward", takes::formula(), 0.5,
                     "the part of junction from which on the capacitance goes on as its tangent"),
         default_key("transit", takes::formula(), 0.0,
                     "the time whose product with i is a charge, in s")}},
       read_diode},
      {{"ideal-transformer",
        "v₁ = ratio v₂, i₂ = -ratio i₁",
        {name(), current_from(), current_to(), secondary(),
         required_key("ratio", takes::formula(), "the ratio of turns, a constant other than 0")}},
       read_transformer},
      {{"gyrator",
        "v₁ = r i₂, v₂ = -r i₁",
        {name(), current_from(), current_to(), secondary(), value("r in Ω, a constant")}},
       read_gyrator},
      {{"voltage-source",
        "holds the voltage from from to to",
        {name(), current_from(), current_to(), value("in V; may depend on t and anything else")}},
       of_value([](elements::Law v) { return elements::voltage_source(std::move(v)); })},
      {{"current-source",
        "holds the current through it from from to to",
        {name(), current_from(), current_to(), value("in A; may depend on t and anything else")}},
       of_value([](elements::Law i) { return elements::current_source(std::move(i)); })},
      {{"switch",
        "a small resistance while a condition holds, else a large one",
        {name(), current_from(), current_to(),
         required_key("closed", takes::formula(), "the condition, such as t > 1e-3"),
         default_key("on", takes::formula(), 1e-3, "in Ω"),
         default_key("off", takes::formula(), 1e9, "in Ω")}},
       read_switch},
  };
}

}  // namespace courant
