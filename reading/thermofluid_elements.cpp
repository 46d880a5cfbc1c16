#include "courant/reading/element_parts.hpp"

namespace courant {
namespace {

using namespace element_parts;
using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

Key flow_from() { return element_parts::from("the node where the flow enters"); }
Key flow_to() { return element_parts::to("the node where it leaves"); }
Key place(const char* summary) { return required_key("at", takes::text(), summary); }

std::optional<NetworkElement> read_tank(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  reader.storage(domains::hydraulic, reader.node("at"), reader.ground(), Kind::charge, "V_");
  const std::string key = reader.one_of({"area", "energy"});
  const double weight = reader.positive("density") * reader.positive("gravity");
  if (key == "area")
    reader.quadratic_energy(reader.positive("area") / weight);
  else if (const auto energy = reader.formula("energy"))
    reader.energy(*energy);
  return reader.result();
}

std::optional<NetworkElement> read_inertance(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  reader.storage(domains::hydraulic, reader.node("from"), reader.node("to"), Kind::flux, "gamma_");
  reader.quadratic_energy(reader.positive("value"));
  return reader.result();
}

std::optional<NetworkElement> read_pipe(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const auto from = reader.node("from"), to = reader.node("to");
  const std::string key = reader.one_of({"value", "flow"});
  const auto formula = reader.formula(key);
  if (!formula) return std::nullopt;
  if (key == "flow") {
    reader.formula_branch(domains::hydraulic, from, to, Kind::voltage, Role::resistor, *formula);
  } else {
    reader.branch(domains::hydraulic, from, to, Kind::current, Role::resistor,
                  resistance(reader.value_of(*formula)));
  }
  return reader.result();
}

// U(S) = C T₀ exp(S/C), so that T = T₀ exp(S/C): dU = C dT.
std::optional<NetworkElement> read_heat_capacity(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  reader.storage(domains::thermal, reader.node("at"), reader.ground(), Kind::charge, "S_");
  const double capacity = reader.positive("value"), reference = reader.positive("temperature");
  reader.energy([capacity, reference](const ExprVector& own, const ExprVector&, const Expr&) {
    return capacity * reference * exp(own[0] / capacity);
  });
  return reader.result();
}

// The heat G (T₁ - T₂) takes the entropy G (T₁ - T₂)/T₁ from one side and gives G (T₁ - T₂)/T₂ to
// the other, which is more; no energy is lost.
std::optional<NetworkElement> read_thermal_conductor(ObjectReader& object,
                                                     const NetworkSite& site) {
  ElementReader reader(object, site);
  const auto from = reader.node("from"), to = reader.node("to");
  const auto formula = reader.formula("value");
  if (!formula) return std::nullopt;
  const auto conductance = reader.value_of(*formula);
  for (const Index side : {0, 1})
    reader.branch(
        domains::thermal, side == 0 ? from : to, reader.ground(), Kind::voltage, Role::coupler,
        [conductance, side](const NetworkVariables& variables, Index first) {
          const Expr own = variables.voltage(first + side);
          const Expr other = variables.voltage(first + 1 - side);
          return conductance(variables, first) * (own - other) / own;
        },
        side == 0 ? "_1" : "_2");
  return reader.result();
}

// Heat at the rate P is the entropy flow P/T.
std::optional<NetworkElement> read_heat_source(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const auto at = reader.node("at");
  const auto formula = reader.formula("value");
  if (!formula) return std::nullopt;
  const auto power = reader.value_of(*formula);
  reader.branch(domains::thermal, at, reader.ground(), Kind::voltage, Role::source,
                [power](const NetworkVariables& variables, Index first) {
                  return -power(variables, first) / variables.voltage(first);
                });
  return reader.result();
}

}  // namespace

ElementKinds thermofluid_elements() {
  using namespace domains;
  return {
      {{"tank",
        "an open tank: a volume V_<name> in m³, of the energy density gravity V²/(2 area)",
        {name(), place("the node at its bottom"),
         optional_key("area", takes::formula(), "of the surface, in m², a constant"),
         optional_key("energy", takes::formula(), "in J, as a function of the volume"),
         default_key("density", takes::formula(), 1000.0, "in kg/m³"),
         default_key("gravity", takes::formula(), 9.81, "in m/s²")},
        {{"area", "energy"}}},
       read_tank},
      {{"inertance",
        "the momentum gamma_<name> in Pa·s of the fluid in a pipe",
        {name(), flow_from(), flow_to(), value("in kg/m⁴, a constant")}},
       read_inertance},
      {{"pipe",
        "a loss of pressure P = R Q, or a law of its own",
        {name(), flow_from(), flow_to(),
         optional_key("value", takes::formula(), "R in Pa·s/m³; may depend on anything"),
         optional_key("flow", takes::formula(), "Q in m³/s as a function of the loss P_<name>")},
        {{"value", "flow"}}},
       read_pipe},
      {{"pressure-source",
        "holds the pressure of from less that of to",
        {name(), flow_from(), flow_to(), value("in Pa; may depend on t and anything else")}},
       source(hydraulic, Kind::current)},
      {{"flow-source",
        "pumps from from to to",
        {name(), flow_from(), flow_to(), value("in m³/s; may depend on t and anything else")}},
       source(hydraulic, Kind::voltage)},
      {{"heat-capacity",
        "an entropy S_<name> in J/K, 0 at the temperature T₀; the energy is C T₀ exp(S/C)",
        {name(), place("the thermal node"), value("C in J/K, a constant"),
         default_key("temperature", takes::formula(), 300.0, "T₀ in K")}},
       read_heat_capacity},
      {{"thermal-conductor",
        "the heat G (T₁ - T₂) from from to to; it makes entropy",
        {name(), flow_from(), flow_to(), value("G in W/K; may depend on anything")}},
       read_thermal_conductor},
      {{"temperature-source",
        "holds the temperature of from, in K, above that of to",
        {name(), flow_from(), flow_to(), value("in K; may depend on t and anything else")}},
       source(thermal, Kind::current)},
      {{"heat-source",
        "brings heat to a node",
        {name(), place("the thermal node"), value("in W; may depend on t and anything else")}},
       read_heat_source},
  };
}

}  // namespace courant
