#include "courant/reading/element_parts.hpp"
#include "courant/reading/junction_charge.hpp"

namespace courant {
namespace {

using namespace element_parts;
using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

Key secondary() {
  return required_key("secondary", takes::array_of(takes::text(), 2, 2),
                      "the two nodes of the other side, from and to");
}

std::optional<NetworkElement> read_resistor(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const auto from = reader.node("from"), to = reader.node("to");
  const std::string key = reader.one_of({"value", "voltage", "current"});
  const auto formula = reader.formula(key);
  if (!formula) return std::nullopt;
  const bool heats = reader.has("heat");
  const NetworkTerminal heat = reader.node("heat");
  if (key == "value") {
    reader.branch(domains::electrical, from, to, Kind::current,
                  heats ? Role::coupler : Role::resistor, resistance(reader.value_of(*formula)));
  } else {
    reader.formula_branch(domains::electrical, from, to,
                          key == "voltage" ? Kind::current : Kind::voltage,
                          heats ? Role::coupler : Role::resistor, *formula);
  }
  if (heats)
    reader.branch(domains::thermal, heat, reader.ground(), Kind::voltage, Role::coupler,
                  [](const NetworkVariables& variables, Index first) {
                    return -variables.current(first) * variables.voltage(first) /
                           variables.voltage(first + 1);
                  });
  return reader.result();
}

Read storage(Kind kind, const char* letters, const char* law) {
  return [=](ObjectReader& object, const NetworkSite& site) {
    ElementReader reader(object, site);
    reader.storage(domains::electrical, reader.node("from"), reader.node("to"), kind, letters);
    const auto value = read_energy(reader, law);
    if (kind == Kind::flux) reader.element().inductance = value;
    return reader.result();
  };
}

std::optional<NetworkElement> read_mutual_inductance(ObjectReader& object,
                                                     const NetworkSite& site) {
  ElementReader reader(object, site);
  const auto [first, second] = reader.pair("inductors");
  const std::string key = reader.one_of({"value", "coupling"});
  const double value = reader.constant(key);
  reader.element().mutual = {{first.node, second.node}, second.pointer, value, key == "coupling"};
  return reader.result();
}

std::optional<NetworkElement> read_diode(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  JunctionCurrent law;
  law.saturation = reader.constant("saturation");
  const double emission = reader.positive("emission");
  law.scale = emission * reader.positive("thermal_voltage");
  law.leak = reader.constant("leak");
  law.breakdown = reader.constant("breakdown");
  law.breakdown_current = reader.constant("breakdown_current");
  const JunctionCharge junction{.capacitance = reader.constant("capacitance"),
                                .junction = reader.positive("junction"),
                                .grading = reader.constant("grading"),
                                .forward = reader.constant("forward"),
                                .transit = reader.constant("transit"),
                                .saturation = law.saturation,
                                .scale = law.scale,
                                .leak = law.leak};
  const auto from = reader.node("from"), to = reader.node("to");
  reader.branch(domains::electrical, from, to, Kind::voltage, Role::resistor,
                [law](const NetworkVariables& variables, Index first) {
                  return law.current(variables.voltage(first));
                });
  if (junction.capacitance > 0.0 || junction.transit > 0.0)
    store_in_junction(reader, junction, 0, from, to);
  return reader.result();
}

std::optional<NetworkElement> read_transformer(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const auto [from, to] = reader.pair("secondary");
  const double ratio = reader.nonzero("ratio");
  transform(reader, ratio, {domains::electrical, reader.node("from"), reader.node("to"), "_1"},
            {domains::electrical, from, to, "_2"});
  return reader.result();
}

std::optional<NetworkElement> read_gyrator(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const auto [from, to] = reader.pair("secondary");
  const double resistance = reader.constant("value");
  reader.branch(
      domains::electrical, reader.node("from"), reader.node("to"), Kind::current, Role::coupler,
      [resistance](const NetworkVariables& variables, Index first) {
        return resistance * variables.current(first + 1);
      },
      "_1");
  reader.branch(
      domains::electrical, from, to, Kind::current, Role::coupler,
      [resistance](const NetworkVariables& variables, Index first) {
        return -resistance * variables.current(first);
      },
      "_2");
  return reader.result();
}

std::optional<NetworkElement> read_switch(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const double on = reader.positive("on"), off = reader.positive("off");
  auto closed = reader.formula("closed");
  if (!closed) return std::nullopt;
  // A condition is no number: `if` makes it one.
  closed->text = "if(" + closed->text + ", 1, 0)";
  const auto is_closed = reader.value_of(*closed);
  reader.branch(domains::electrical, reader.node("from"), reader.node("to"), Kind::current,
                Role::resistor,
                [is_closed, on, off](const NetworkVariables& variables, Index first) {
                  const Expr current = variables.current(first);
                  return select(is_closed(variables, first), on * current, off * current);
                });
  return reader.result();
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
       storage(Kind::charge, "q_", "voltage")},
      {{"inductor",
        "a flux linkage phi_<name> in Wb",
        {name(), current_from(), current_to(),
         optional_key("value", takes::formula(), "L in H, a constant"),
         optional_key("energy", takes::formula(), "in J, as a function of the flux"),
         optional_key("current", takes::formula(), "in A, as a function of the flux")},
        {{"value", "energy", "current"}}},
       storage(Kind::flux, "phi_", "current")},
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
       source(domains::electrical, Kind::current)},
      {{"current-source",
        "holds the current through it from from to to",
        {name(), current_from(), current_to(), value("in A; may depend on t and anything else")}},
       source(domains::electrical, Kind::voltage)},
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
