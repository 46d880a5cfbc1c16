#include "courant/reading/element_parts.hpp"
#include "courant/structures/elements/mechanical.hpp"

namespace courant {
namespace {

using namespace element_parts;

Key one_end() { return element_parts::from("the node at one end"); }
Key other_end() { return element_parts::to("the node at the other end"); }
Key body() { return required_key("at", takes::text(), "the node that moves with it"); }

Read read_mass(Element (*make)(double)) {
  return [make](ObjectReader& object, const NetworkSite& site) {
    ElementReader reader(object, site);
    return reader.result(make(reader.positive("value")), {"at"});
  };
}

Read read_spring(Element (*make)(elements::StateLaw), const char* law) {
  return [make, law](ObjectReader& object, const NetworkSite& site) {
    ElementReader reader(object, site);
    Element spring = make({});
    read_energy(reader, spring, law, true);
    return reader.result(std::move(spring), between);
  };
}

Read read_damper(const Domain& domain, const char* law) {
  return [&domain, law](ObjectReader& object, const NetworkSite& site) {
    ElementReader reader(object, site);
    const std::string key = reader.one_of({"value", law});
    const elements::Law value = reader.law(key);
    return reader.result(key == "value" ? elements::damper(domain, value)
                                        : elements::damper_of_velocity(domain, value),
                         between);
  };
}

std::optional<NetworkElement> read_friction(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const double force = reader.positive("value"), width = reader.positive("width");
  return reader.result(elements::friction(domains::translation, force, width), between);
}

std::optional<NetworkElement> read_gear(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  const double ratio = reader.nonzero("ratio");
  return reader.result(elements::gear(ratio), between);
}

Read force_source(const Domain& domain) {
  return of_value(
      [&domain](elements::Law f) { return elements::force_source(domain, std::move(f)); });
}
Read velocity_source(const Domain& domain) {
  return of_value(
      [&domain](elements::Law v) { return elements::velocity_source(domain, std::move(v)); });
}

Key optional_value(const char* summary) { return optional_key("value", takes::formula(), summary); }

}  // namespace

ElementKinds mechanical_elements() {
  using namespace domains;
  return {
      {{"mass", "a momentum p_<name> in kg·m/s", {name(), body(), value("in kg, a constant")}},
       read_mass(elements::mass)},
      {{"spring",
        "an elongation x_<name> in m; its rate is the velocity of from less that of to",
        {name(), one_end(), other_end(), optional_value("in N/m, a constant"),
         optional_key("energy", takes::formula(), "in J, as a function of the elongation"),
         optional_key("force", takes::formula(), "in N, as a function of the elongation")},
        {{"value", "energy", "force"}}},
       read_spring(elements::spring, "force")},
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
       read_friction},
      {{"force-source",
        "a force on to, and its reaction on from",
        {name(), one_end(), other_end(), value("in N; may depend on t and anything else")}},
       force_source(translation)},
      {{"velocity-source",
        "holds the velocity of from less that of to",
        {name(), one_end(), other_end(), value("in m/s; may depend on t and anything else")}},
       velocity_source(translation)},
      {{"inertia",
        "an angular momentum l_<name> in kg·m²/s",
        {name(), body(), value("in kg·m², a constant")}},
       read_mass(elements::inertia)},
      {{"torsion-spring",
        "an angle theta_<name> in rad; its rate is the angular velocity of from less that of to",
        {name(), one_end(), other_end(), optional_value("in N·m/rad, a constant"),
         optional_key("energy", takes::formula(), "in J, as a function of the angle"),
         optional_key("torque", takes::formula(), "in N·m, as a function of the angle")},
        {{"value", "energy", "torque"}}},
       read_spring(elements::torsion_spring, "torque")},
      {{"rotational-damper",
        "a torque against the angular velocity of from less that of to",
        {name(), one_end(), other_end(), optional_value("in N·m·s/rad; may depend on anything"),
         optional_key("torque", takes::formula(), "in N·m, as a function of omega_<name>")},
        {{"value", "torque"}}},
       read_damper(rotation, "torque")},
      {{"torque-source",
        "a torque on to, and its reaction on from",
        {name(), one_end(), other_end(), value("in N·m; may depend on t and anything else")}},
       force_source(rotation)},
      {{"speed-source",
        "holds the angular velocity of from less that of to",
        {name(), one_end(), other_end(), value("in rad/s; may depend on t and anything else")}},
       velocity_source(rotation)},
      {{"gear",
        "two shafts, against the ground: omega₁ = ratio omega₂, tau₂ = -ratio tau₁",
        {name(), one_end(), other_end(), required_key("ratio", takes::formula(), "a constant")}},
       read_gear},
  };
}

}  // namespace courant
