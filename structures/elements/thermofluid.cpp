#include "courant/structures/elements/thermofluid.hpp"

#include <utility>

namespace courant::elements {
namespace {

using domains::hydraulic;
using domains::thermal;
using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

Element on_one_terminal(Element element) {
  element.branches[0].to = Element::ground;
  return element;
}

}  // namespace

Element tank(double area, double density, double gravity) {
  return tank(quadratic(area / (density * gravity)));
}
Element tank(StateLaw energy) {
  return on_one_terminal(storage(hydraulic, Kind::charge, "V_", std::move(energy)));
}

Element inertance(double inertance) {
  return storage(hydraulic, Kind::flux, "gamma_", quadratic(inertance));
}

Element pipe(Law resistance) {
  return resistive(hydraulic, Kind::current, times_current(std::move(resistance)));
}
Element pipe_of_pressure(Law flow) { return resistive(hydraulic, Kind::voltage, std::move(flow)); }

Element pressure_source(Law pressure) {
  return source(hydraulic, Kind::current, std::move(pressure));
}
Element flow_source(Law flow) { return source(hydraulic, Kind::voltage, std::move(flow)); }

Element heat_capacity(double capacity, double reference) {
  return on_one_terminal(
      storage(thermal, Kind::charge, "S_",
              [capacity, reference](const ExprVector& own, const ExprVector&, const Expr&) {
                return capacity * reference * exp(own[0] / capacity);
              }));
}

Element thermal_conductor(Law conductance) {
  Element element;
  for (const Index side : {0, 1})
    element.branches.push_back({.domain = &thermal,
                                .from = side,
                                .to = Element::ground,
                                .kind = Kind::voltage,
                                .role = Role::coupler,
                                .law =
                                    [conductance, side](const Variables& variables) {
                                      const Expr own = variables.voltage(side);
                                      const Expr other = variables.voltage(1 - side);
                                      return conductance(variables) * (own - other) / own;
                                    },
                                .suffix = side == 0 ? "_1" : "_2"});
  return element;
}

Element temperature_source(Law temperature) {
  return source(thermal, Kind::current, std::move(temperature));
}

Element heat_source(Law power) {
  return on_one_terminal(source(
      thermal, Kind::voltage,
      [power = std::move(power)](const Variables& own) { return -power(own) / own.voltage(0); }));
}

}  // namespace courant::elements
