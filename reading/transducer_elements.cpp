#include "courant/reading/element_parts.hpp"
#include "courant/structures/elements/transducers.hpp"

namespace courant {
namespace {

using namespace element_parts;

Read read_motor(const Domain& domain, const char* moving) {
  return [&domain, moving](ObjectReader& object, const NetworkSite& site) {
    ElementReader reader(object, site);
    const double constant = reader.constant("constant");
    return reader.result(elements::motor(constant, domain), {"from", "to", moving});
  };
}

std::optional<NetworkElement> read_electromagnet(ObjectReader& object, const NetworkSite& site) {
  ElementReader reader(object, site);
  return reader.result(elements::electromagnet(reader.state_law("inductance")),
                       {"from", "to", "armature"});
}

}  // namespace

ElementKinds transducer_elements() {
  return {
      {{"dc-motor",
        "v = K omega, torque K i on the shaft; winding and rotor are elements besides",
        {name(), current_from(), current_to(),
         required_key("shaft", takes::text(), "the rotational node"),
         required_key("constant", takes::formula(), "K in V·s/rad = N·m/A, a constant")}},
       read_motor(domains::rotation, "shaft")},
      {{"voice-coil",
        "v = K times the velocity of the cone, force K i on the cone",
        {name(), current_from(), current_to(),
         required_key("cone", takes::text(), "the translational node"),
         required_key("constant", takes::formula(), "K = B l in V·s/m = N/A, a constant")}},
       read_motor(domains::translation, "cone")},
      {{"electromagnet",
        "a flux phi_<name> in Wb and a position x_<name> in m, with the energy phi²/(2 L(x))",
        {name(), current_from(), current_to(),
         required_key("armature", takes::text(), "the translational node; x is its position"),
         required_key("inductance", takes::formula(), "L in H, as a function of x_<name>")}},
       read_electromagnet},
  };
}

}  // namespace courant
