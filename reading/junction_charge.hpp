// The charge of a junction as a function of its voltage.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant {

// q(v) = ∫ C dv with the depletion capacitance C = C₀ (1 - v/v_j)^-m up to v = f v_j, and its tangent
// beyond, and the diffusion capacitance τ di/dv of i = saturation (exp(v/scale) - 1), as in SPICE. The energy that it stores is ∫ v dq.
struct JunctionCharge {
  double capacitance = 0.0;  // C₀, F
  double junction = 1.0;     // v_j, V
  double grading = 0.5;      // m < 1
  double forward = 0.5;      // f < 1
  double transit = 0.0;      // τ, s
  double saturation = 1e-14, scale = 0.025852;

  Expr charge(const Expr& v) const;
  Expr energy(const Expr& v) const;
  // An increasing function of a charge, in V, that is about the voltage which it belongs to: the inverse of q(v) for
  // q < 0, where a depletion has one. Equations in it are nearly linear where q grows like exp (v/25 mV).
  Expr about_voltage(const Expr& q) const;
};

// exp of an argument; beyond 60 its tangent, since Newton's method may ask for more.
Expr bounded_exp(const Expr& exponent);

}  // namespace courant
