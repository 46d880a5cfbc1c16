#include "courant/structures/elements/bipolar_transistor.hpp"

namespace courant::elements {

Expr BipolarTransistor::transport(const Expr& v_e, const Expr& v_c) const {
  // Far from all that a transistor stands Newton's method may ask for the other side of the pole of q₁.
  constexpr double least = 1e-2;
  const Expr forward = JunctionCurrent{saturation, forward_scale}.current(v_e),
             reverse = JunctionCurrent{saturation, reverse_scale}.current(v_c);
  Expr through = forward - reverse;
  if (early_forward != 0.0 || early_reverse != 0.0) {
    Expr inverse = 1.0;
    if (early_forward != 0.0) inverse -= v_c / early_forward;
    if (early_reverse != 0.0) inverse -= v_e / early_reverse;
    through *= max(inverse, Expr(least));
  }
  if (knee_forward != 0.0 || knee_reverse != 0.0) {
    Expr q = 0.0;
    if (knee_forward != 0.0) q += forward / knee_forward;
    if (knee_reverse != 0.0) q += reverse / knee_reverse;
    through = 2.0 * through / (1.0 + sqrt(1.0 + 4.0 * max(q, Expr(-0.2))));
  }
  return through;
}

BipolarTransistor::Widening BipolarTransistor::widening(double transit, const Expr& v_e,
                                                        const Expr& v_c) const {
  if (transit == 0.0 || early_forward == 0.0) return {0.0, 0.0, 0.0};
  constexpr double bend = 0.2;  // V
  const JunctionCurrent forward{saturation, forward_scale, leak};
  const Expr current = forward.current(v_e), integral = forward.integral(v_e);
  const Expr within = min(max(v_c, Expr(-bend)), Expr(0.0)), beyond = min(v_c + bend, Expr(0.0));
  const Expr g = (square(within) / (2.0 * bend) - beyond) / early_forward;
  const Expr slope = within / (bend * early_forward);
  // v_e q_e + v_c q_c less what both are slopes of, τ g ∫ i_f dv_e.
  return {transit * current * g, transit * integral * slope,
          transit * (v_e * current * g + v_c * integral * slope - integral * g)};
}

Expr BipolarTransistor::emitter_current(const Expr& v_e) const {
  return JunctionCurrent{saturation / forward_gain, forward_scale, leak}.current(v_e) +
         emitter_leak.current(v_e);
}

Expr BipolarTransistor::collector_current(const Expr& v_c) const {
  return JunctionCurrent{saturation / reverse_gain, reverse_scale, leak}.current(v_c) +
         collector_leak.current(v_c);
}

}  // namespace courant::elements
