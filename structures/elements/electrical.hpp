// Electrical elements.
#pragma once

#include "courant/structures/elements/element.hpp"
#include "courant/structures/elements/junction_charge.hpp"

namespace courant::elements {

// Terminals: from, to; the current counts positive from the first to the second. In SI units.

Element resistor(double resistance);  // Ω
Element resistor(Law resistance);     // in Ω, of anything
Element resistor_of_current(Law v);   // the voltage, as a function of the current(0)
Element resistor_of_voltage(Law i);   // the current, as a function of the voltage(0)
// The same with a third terminal, a thermal node that gets the entropy v i/T of its loss.
Element heating(Element resistor);

// States q_<name> and phi_<name>.
Element capacitor(double capacitance);  // F
Element capacitor(StateLaw energy);     // in J, of the charge
Element inductor(double inductance);    // H
Element inductor(StateLaw energy);      // in J, of the flux linkage

// A junction, and beside it, if it has any capacitance or transit time, its charge q_<name>.
Element diode(const JunctionCurrent& current, const JunctionCharge& charge);

// Terminals: from, to, and those of the other side. v₁ = ratio v₂, i₂ = -ratio i₁.
Element ideal_transformer(double ratio);
// v₁ = r i₂, v₂ = -r i₁.
Element gyrator(double resistance);

Element voltage_source(double voltage);
Element voltage_source(Law voltage);
Element current_source(double current);
Element current_source(Law current);

// `on` Ω where `closed` is not 0, else `off` Ω.
Element electrical_switch(Law closed, double on, double off);

// The charge of a junction beside branch `beside` of an element, between its terminals `from` and `to`: a state
// q_<name>, or q_<part>_<name>, which q = q(v) ties to the voltage of that branch. Where it is tied, the voltage of the
// charge is that of the branch, as it is side by side. `more` is added to q(v), and `more_energy` to what is stored.
struct MoreCharge {
  Law charge = {}, energy = {};
};
void store_in_junction(Element& element, const JunctionCharge& junction, Index beside, Index from,
                       Index to, const std::string& part = "", const MoreCharge& more = {});

}  // namespace courant::elements
