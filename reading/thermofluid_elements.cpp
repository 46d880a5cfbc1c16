#include "courant/reading/element_parts.hpp"
#include "courant/structures/elements/thermofluid.hpp"

namespace courant {
namespace {

using namespace element_parts;

Key flow_from() { return element_parts::from("the node where the flow enters"); }
Key flow_to() { return element_parts::to("the node where it leaves"); }
Key place(const char* summary) { return required_key("at", takes::text(), summary); }

std::optional<NetworkElement> read_tank(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const std::vector<std::string> at = {"at"};
  const std::string key = reader.one_of({"area", "energy"});
  const double density = reader.positive("density"), gravity = reader.positive("gravity");
  if (key == "energy") return reader.result(elements::tank(reader.state_law(key)), at);
  return reader.result(elements::tank(reader.positive(key), density, gravity), at);
}

std::optional<NetworkElement> read_inertance(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  return reader.result(elements::inertance(reader.positive("value")), between);
}

std::optional<NetworkElement> read_pipe(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const std::string key = reader.one_of({"value", "flow"});
  const elements::Law law = reader.law(key);
  return reader.result(key == "flow" ? elements::pipe_of_pressure(law) : elements::pipe(law),
                       between);
}

std::optional<NetworkElement> read_heat_capacity(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const double capacity = reader.positive("value"), reference = reader.positive("temperature");
  return reader.result(elements::heat_capacity(capacity, reference), {"at"});
}

std::optional<NetworkElement> read_heat_source(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  return reader.result(elements::heat_source(reader.law("value")), {"at"});
}

}  // namespace

ElementKinds thermofluid_elements() {
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
       of_value(elements::pressure_source)},
      {{"flow-source",
        "pumps from from to to",
        {name(), flow_from(), flow_to(), value("in m³/s; may depend on t and anything else")}},
       of_value(elements::flow_source)},
      {{"heat-capacity",
        "an entropy S_<name> in J/K, 0 at the temperature T₀; the energy is C T₀ exp(S/C)",
        {name(), place("the thermal node"), value("C in J/K, a constant"),
         default_key("temperature", takes::formula(), 300.0, "T₀ in K")}},
       read_heat_capacity},
      {{"thermal-conductor",
        "the heat G (T₁ - T₂) from from to to; it makes entropy",
        {name(), flow_from(), flow_to(), value("G in W/K; may depend on anything")}},
       of_value(elements::thermal_conductor)},
      {{"temperature-source",
        "holds the temperature of from, in K, above that of to",
        {name(), flow_from(), flow_to(), value("in K; may depend on t and anything else")}},
       of_value(elements::temperature_source)},
      {{"heat-source",
        "brings heat to a node",
        {name(), place("the thermal node"), value("in W; may depend on t and anything else")}},
       read_heat_source},
  };
}

}  // namespace courant
