// The channel of a field-effect transistor with an insulated gate.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant::elements {

// The model of Shichman and Hodges, level 1 of SPICE. With v_ds ≥ 0 and v_t = threshold + body (√(surface - v_bs) -
// √surface), a = v_gs - v_t:
//
//   i = 0                                                      a ≤ 0
//   i = transconductance/2 a² (1 + modulation v_ds)            0 < a ≤ v_ds
//   i = transconductance v_ds (a - v_ds/2) (1 + modulation v_ds)   a > v_ds
//
// from drain to source; for v_ds < 0 the two change places. For v_bs > 0 the root goes on as its tangent, down to 0. Of
// a p-channel all voltages and the current have the other sign, and so has the threshold.
// Source: Shichman, Hodges, Modeling and simulation of insulated-gate field-effect transistor switching circuits
// (1968).
struct MosChannel {
  double threshold = 0.0;          // V, that of an n-channel
  double transconductance = 2e-5;  // A/V²: that of the model times width/length
  double modulation = 0.0;         // 1/V
  double body = 0.0;               // √V
  double surface = 0.6;            // V

  // In A, of voltages from gate, drain and bulk to the source in V.
  Expr current(const Expr& v_gs, const Expr& v_ds, const Expr& v_bs) const;

 private:
  Expr forward(const Expr& v_gs, const Expr& v_ds, const Expr& v_bs) const;
};

}  // namespace courant::elements
