// The current and the charge of a junction as functions of its voltage.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant::elements {

// i = saturation (exp(v/scale) - 1) + leak v - breakdown_current exp(-(v + breakdown)/scale), the last only for a
// breakdown > 0.
struct JunctionCurrent {
  double saturation = 0.0, scale = 0.025852;        // A, V
  double leak = 0.0;                                // S
  double breakdown = 0.0, breakdown_current = 0.0;  // V, A

  // i in A, of v in V.
  Expr current(const Expr& v) const;
  // ∫ i dv from 0, without a breakdown; up to the largest exponent of bounded_exp.
  Expr integral(const Expr& v) const;
};

// q(v) = ∫ C dv with the depletion capacitance C = C₀ (1 - v/v_j)^-m up to v = f v_j, and its tangent beyond, and the
// diffusion capacitance τ di/dv of i = saturation (exp(v/scale) - 1) + leak v, as in SPICE 3. The energy that it stores
// is ∫ v dq. Without the leak and without C₀ a charge says nothing of a voltage that blocks: below -0.9 V exp(v/scale)
// is less than the round-off of 1.
struct JunctionCharge {
  double capacitance = 0.0;  // C₀, F
  double junction = 1.0;     // v_j, V
  double grading = 0.5;      // m < 1
  double forward = 0.5;      // f < 1
  double transit = 0.0;      // τ, s
  double saturation = 1e-14, scale = 0.025852;
  double leak = 0.0;  // S

  // q(v) in C, and the energy in J, of v in V.
  Expr charge(const Expr& v) const;
  Expr energy(const Expr& v) const;
  // An increasing function of a charge, in V, that is about the voltage which it belongs to: the inverse of q(v) for
  // q < 0, where a depletion has one. Equations in it are nearly linear where q grows like exp (v/25 mV).
  Expr about_voltage(const Expr& q) const;
};

// exp of an argument; beyond 60 its tangent, since Newton's method may ask for more.
Expr bounded_exp(const Expr& exponent);

}  // namespace courant::elements
