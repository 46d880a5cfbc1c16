// Hydraulic and thermal elements.
#pragma once

#include "courant/structures/elements/element.hpp"

namespace courant::elements {

// Terminals: from, to, or one. In SI units.

// An open tank on one terminal: a volume V_<name> in m³, of the energy density gravity V²/(2 area).
Element tank(double area, double density, double gravity);
Element tank(StateLaw energy);  // in J, of the volume
// The momentum gamma_<name> in Pa·s of the fluid in a pipe.
Element inertance(double inertance);    // kg/m⁴
Element pipe(Law resistance);           // loss of pressure = resistance flow, Pa·s/m³
Element pipe_of_pressure(Law flow);     // of the loss, voltage(0)
Element pressure_source(Law pressure);  // Pa
Element flow_source(Law flow);          // m³/s

// One terminal. An entropy S_<name> in J/K, 0 at the temperature T₀: U(S) = C T₀ exp(S/C), so that T = T₀ exp(S/C) and
// dU = C dT.
Element heat_capacity(double capacity, double reference);
// The heat G (T₁ - T₂) takes the entropy G (T₁ - T₂)/T₁ from one side and gives G (T₁ - T₂)/T₂ to the other, which is
// more; no energy is lost.
Element thermal_conductor(Law conductance);   // W/K
Element temperature_source(Law temperature);  // K
// One terminal. Heat at the rate P is the entropy flow P/T.
Element heat_source(Law power);  // W

}  // namespace courant::elements
