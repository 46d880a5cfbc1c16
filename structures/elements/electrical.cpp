#include "courant/structures/elements/electrical.hpp"

#include <utility>

namespace courant::elements {
namespace {

using domains::electrical;
using Kind = NetworkBranch::Kind;
using Role = NetworkBranch::Role;

}  // namespace

Element resistor(double resistance) { return resistor(constant(resistance)); }
Element resistor(Law resistance) {
  return resistor_of_current(times_current(std::move(resistance)));
}
Element resistor_of_current(Law v) { return resistive(electrical, Kind::current, std::move(v)); }
Element resistor_of_voltage(Law i) { return resistive(electrical, Kind::voltage, std::move(i)); }

Element heating(Element resistor) {
  resistor.branches[0].role = Role::coupler;
  resistor.branches.push_back({.domain = &domains::thermal,
                               .from = 2,
                               .to = Element::ground,
                               .kind = Kind::voltage,
                               .role = Role::coupler,
                               .law = [](const Variables& own) {
                                 return -own.current(0) * own.voltage(0) / own.voltage(1);
                               }});
  return resistor;
}

Element capacitor(double capacitance) { return capacitor(quadratic(capacitance)); }
Element capacitor(StateLaw energy) {
  return storage(electrical, Kind::charge, "q_", std::move(energy));
}
Element inductor(double inductance) {
  Element element = inductor(quadratic(inductance));
  element.inductance = inductance;
  return element;
}
Element inductor(StateLaw energy) {
  return storage(electrical, Kind::flux, "phi_", std::move(energy));
}

Element diode(const JunctionCurrent& current, const JunctionCharge& charge) {
  Element element = resistor_of_voltage(
      [current](const Variables& own) { return current.current(own.voltage(0)); });
  if (charge.capacitance > 0.0 || charge.transit > 0.0) store_in_junction(element, charge, 0, 0, 1);
  return element;
}

Element ideal_transformer(double ratio) {
  return transformer(ratio, {.suffix = "_1"}, {.from = 2, .to = 3, .suffix = "_2"});
}

Element gyrator(double resistance) {
  return {.branches = {
              {.role = Role::coupler,
               .law = [resistance](const Variables& own) { return resistance * own.current(1); },
               .suffix = "_1"},
              {.from = 2,
               .to = 3,
               .role = Role::coupler,
               .law = [resistance](const Variables& own) { return -resistance * own.current(0); },
               .suffix = "_2"}}};
}

Element voltage_source(double voltage) { return voltage_source(constant(voltage)); }
Element voltage_source(Law voltage) {
  return source(electrical, Kind::current, std::move(voltage));
}
Element current_source(double current) { return current_source(constant(current)); }
Element current_source(Law current) {
  return source(electrical, Kind::voltage, std::move(current));
}

Element electrical_switch(Law closed, double on, double off) {
  return resistor_of_current([closed = std::move(closed), on, off](const Variables& own) {
    const Expr current = own.current(0);
    return select(closed(own), on * current, off * current);
  });
}

void store_in_junction(Element& element, const JunctionCharge& junction, Index beside, Index from,
                       Index to, const std::string& part, const MoreCharge& more) {
  const std::string between = part.empty() ? "_" : "_" + part + "_";
  element.branches.push_back({.from = from,
                              .to = to,
                              .kind = Kind::charge,
                              .role = Role::storage,
                              .law =
                                  [junction, beside, state = element.state_count(),
                                   also = more.charge](const Variables& own) {
                                    const Expr v = own.voltage(beside);
                                    Expr whole = junction.charge(v);
                                    if (also) whole += also(own);
                                    return v + junction.about_voltage(own.state(state)) -
                                           junction.about_voltage(whole);
                                  },
                              .energy =
                                  [junction, beside, also = more.energy](const Variables& own) {
                                    const Expr stored = junction.energy(own.voltage(beside));
                                    return also ? stored + also(own) : stored;
                                  },
                              .suffix = between + "charge",
                              .letters = "q" + between});
}

}  // namespace courant::elements
