#include "courant/reading/element_parts.hpp"

namespace courant {
namespace {

using namespace element_parts;
using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

Key one_end() { return element_parts::from("the node at one end"); }
Key other_end() { return element_parts::to("the node at the other end"); }
Key body() { return required_key("at", takes::text(), "the node that moves with it"); }

Read read_mass(const NetworkDomain& domain, const char* letters) {
  return [&domain, letters](ObjectReader& object, const NetworkSite& site) {
    ElementReader reader(object, site);
    reader.storage(domain, reader.node("at"), reader.ground(), Kind::charge, letters);
    reader.quadratic_energy(reader.positive("value"));
    return reader.result();
  };
}

Read read_spring(const NetworkDomain& domain, const char* letters, const char* law) {
  return [&domain, letters, law](ObjectReader& object, const NetworkSite& site) {
    ElementReader reader(object, site);
    reader.storage(domain, reader.node("from"), reader.node("to"), Kind::flux, letters);
    read_energy(reader, law, true);
    return reader.result();
  };
}

Read read_damper(const NetworkDomain& domain, const char* law) {
  return [&domain, law](ObjectReader& object,
                        const NetworkSite& site) -> std::optional<NetworkElement> {
    ElementReader reader(object, site);
    const auto from = reader.node("from"), to = reader.node("to");
    const std::string key = reader.one_of({"value", law});
    const auto formula = reader.formula(key);
    if (!formula) return std::nullopt;
    const auto value = reader.value_of(*formula);
    const bool linear = key == "value";
    reader.branch(domain, from, to, Kind::voltage, Role::resistor,
                  [value, linear](const NetworkVariables& variables, Index first) {
                    const Expr law = value(variables, first);
                    return linear ? law * variables.voltage(first) : law;
                  });
    return reader.result();
  };
}

// F tanh(v/v₀): Coulomb's law but for velocities below v₀.
Read read_friction(const NetworkDomain& domain) {
  return [&domain](ObjectReader& object, const NetworkSite& site) {
    ElementReader reader(object, site);
    const double force = reader.positive("value"), width = reader.positive("width");
    reader.branch(domain, reader.node("from"), reader.node("to"), Kind::voltage, Role::resistor,
                  [force, width](const NetworkVariables& variables, Index first) {
                    return force * tanh(variables.voltage(first) / width);
                  });
    return reader.result();
  };
}

std::optional<NetworkElement> read_gear(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const double ratio = reader.nonzero("ratio");
  transform(reader, ratio, {domains::rotation, reader.node("from"), reader.ground(), "_1"},
            {domains::rotation, reader.node("to"), reader.ground(), "_2"});
  return reader.result();
}

Key optional_value(const char* summary) { return optional_key("value", takes::formula(), summary); }

}  // namespace

ElementKinds mechanical_elements() {
  using namespace domains;
  return {
      {{"mass", "a momentum p_<name> in kg·m/s", {name(), body(), value("in kg, a constant")}},
       read_mass(translation, "p_")},
      {{"spring",
        "an elongation x_<name> in m; its rate is the velocity of from less that of to",
        {name(), one_end(), other_end(), optional_value("in N/m, a constant"),
         optional_key("energy", takes::formula(), "in J, as a function of the elongation"),
         optional_key("force", takes::formula(), "in N, as a function of the elongation")},
        {{"value", "energy", "force"}}},
       read_spring(translation, "x_", "force")},
      {{"damper",
        "a force against the velocity of from less that of to",
        {name(), one_end(), other_end(), optional_value("in N·s/m; may depend on anything"),
         optional_key("force", takes::formula(), "in N, as a function of the velocity v_<name>")},
        {{"value", "force"}}},
       read_damper(translation, "force")},
      {{"friction",
        "dry friction: value tanh(v/width)",
        {name(), one_end(), other_end(), value("in N, a constant"),
         default_key("width", takes::formula(), 1e-3, "in m/s")}},
       read_friction(translation)},
      {{"force-source",
        "a force on to, and its reaction on from",
        {name(), one_end(), other_end(), value("in N; may depend on t and anything else")}},
       source(translation, Kind::voltage)},
      {{"velocity-source",
        "holds the velocity of from less that of to",
        {name(), one_end(), other_end(), value("in m/s; may depend on t and anything else")}},
       source(translation, Kind::current)},
      {{"inertia",
        "an angular momentum l_<name> in kg·m²/s",
        {name(), body(), value("in kg·m², a constant")}},
       read_mass(rotation, "l_")},
      {{"torsion-spring",
        "an angle theta_<name> in rad; its rate is the angular velocity of from less that of to",
        {name(), one_end(), other_end(), optional_value("in N·m/rad, a constant"),
         optional_key("energy", takes::formula(), "in J, as a function of the angle"),
         optional_key("torque", takes::formula(), "in N·m, as a function of the angle")},
        {{"value", "energy", "torque"}}},
       read_spring(rotation, "theta_", "torque")},
      {{"rotational-damper",
        "a torque against the angular velocity of from less that of to",
        {name(), one_end(), other_end(), optional_value("in N·m·s/rad; may depend on anything"),
         optional_key("torque", takes::formula(), "in N·m, as a function of omega_<name>")},
        {{"value", "torque"}}},
       read_damper(rotation, "torque")},
      {{"torque-source",
        "a torque on to, and its reaction on from",
        {name(), one_end(), other_end(), value("in N·m; may depend on t and anything else")}},
       source(rotation, Kind::voltage)},
      {{"speed-source",
        "holds the angular velocity of from less that of to",
        {name(), one_end(), other_end(), value("in rad/s; may depend on t and anything else")}},
       source(rotation, Kind::current)},
      {{"gear",
        "two shafts, against the ground: omega₁ = ratio omega₂, tau₂ = -ratio tau₁",
        {name(), one_end(), other_end(), required_key("ratio", takes::formula(), "a constant")}},
       read_gear},
  };
}

}  // namespace courant
