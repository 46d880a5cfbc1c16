// The laws of a bipolar transistor.
#pragma once

#include "courant/core/expressions/expr.hpp"
#include "courant/structures/elements/junction_charge.hpp"

namespace courant::elements {

// The transport model of Ebers and Moll with the base charge of Gummel and Poon, as in SPICE. With v_e and v_c the
// voltages of the junctions, positive where they conduct (from the base of an npn, to that of a pnp), and
//
//   i_f = saturation (exp(v_e/s_f) - 1),   i_r = saturation (exp(v_c/s_r) - 1)
//   1/q₁ = 1 - v_c/early_forward - v_e/early_reverse
//   q_b = q₁/2 (1 + √(1 + 4 (i_f/knee_forward + i_r/knee_reverse)))
//
// the current (i_f - i_r)/q_b goes through from the collector to the emitter of an npn, and i_f/β_f and i_r/β_r with
// those of two leaking junctions go through the base. Currents in A, voltages in V. With early and knee values of 0,
// which stand for infinite ones, that is the model of Ebers and Moll (1954).
// Source: Gummel, Poon, An integral charge control model of bipolar transistors (1970).
struct BipolarTransistor {
  double saturation = 1e-16;
  double forward_gain = 100.0, reverse_gain = 1.0;            // β
  double forward_scale = 0.025852, reverse_scale = 0.025852;  // s
  JunctionCurrent emitter_leak, collector_leak;
  double early_forward = 0.0, early_reverse = 0.0;  // V; 0: infinite
  double knee_forward = 0.0, knee_reverse = 0.0;    // A; 0: infinite
  double leak = 0.0;                                // a conductance beside each junction, S

  // The Early voltage widens the base of a transistor whose collector blocks, and what is stored in it: the charge τ
  // i_f at the emitter becomes τ i_f (1 + g), g = -v_c/early_forward, as τ i_f/q_b of SPICE without knee and
  // early_reverse. With ∫ i_f dv_e g' at the collector, which is as small as 25 mV is beside early_forward, both
  // charges are slopes of one function, and there is an energy. g is 0 for v_c > 0, and a parabola on the way, from
  // -0.2 V on, so that charges tell both voltages.
  struct Widening {
    Expr at_emitter, at_collector, energy;
  };
  Widening widening(double transit, const Expr& v_e, const Expr& v_c) const;
  // From the collector of an npn to its emitter.
  Expr transport(const Expr& v_e, const Expr& v_c) const;
  // What a junction takes through the base.
  Expr emitter_current(const Expr& v_e) const;
  Expr collector_current(const Expr& v_c) const;
};

}  // namespace courant::elements
