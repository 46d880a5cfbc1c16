#include "courant/structures/elements/mechanical.hpp"

#include <utility>

namespace courant::elements {
namespace {

using Kind = NetworkBranch::Kind;

Element momentum(const Domain& domain, const std::string& letters, double inertia) {
  Element element = storage(domain, Kind::charge, letters, quadratic(inertia));
  element.branches[0].to = Element::ground;
  return element;
}

}  // namespace

Element mass(double mass) { return momentum(domains::translation, "p_", mass); }
Element inertia(double inertia) { return momentum(domains::rotation, "l_", inertia); }

Element spring(double stiffness) { return spring(quadratic(1.0 / stiffness)); }
Element spring(StateLaw energy) {
  return storage(domains::translation, Kind::flux, "x_", std::move(energy));
}
Element torsion_spring(double stiffness) { return torsion_spring(quadratic(1.0 / stiffness)); }
Element torsion_spring(StateLaw energy) {
  return storage(domains::rotation, Kind::flux, "theta_", std::move(energy));
}

Element damper(const Domain& domain, Law coefficient) {
  return damper_of_velocity(domain, [coefficient = std::move(coefficient)](const Variables& own) {
    return coefficient(own) * own.voltage(0);
  });
}
Element damper_of_velocity(const Domain& domain, Law force) {
  return resistive(domain, Kind::voltage, std::move(force));
}

Element friction(const Domain& domain, double force, double width) {
  return resistive(domain, Kind::voltage, [force, width](const Variables& own) {
    return force * tanh(own.voltage(0) / width);
  });
}

Element force_source(const Domain& domain, Law force) {
  return source(domain, Kind::voltage, std::move(force));
}
Element velocity_source(const Domain& domain, Law velocity) {
  return source(domain, Kind::current, std::move(velocity));
}

Element gear(double ratio) {
  return transformer(
      ratio, {.domain = &domains::rotation, .to = Element::ground, .suffix = "_1"},
      {.domain = &domains::rotation, .from = 1, .to = Element::ground, .suffix = "_2"});
}

}  // namespace courant::elements
