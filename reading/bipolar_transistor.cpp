#include "courant/reading/bipolar_transistor.hpp"

namespace courant {

Expr BipolarTransistor::Junction::current(const Expr& v) const {
  return saturation == 0.0 ? Expr(0.0) : saturation * (bounded_exp(v / scale) - 1.0);
}

Expr BipolarTransistor::transport(const Expr& v_e, const Expr& v_c) const {
  // Far from all that a transistor stands Newton's method may ask for the other side of the pole of q₁.
  constexpr double least = 1e-2;
  const Expr forward = Junction{saturation, forward_scale}.current(v_e),
             reverse = Junction{saturation, reverse_scale}.current(v_c);
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

Expr BipolarTransistor::emitter_current(const Expr& v_e) const {
  return Junction{saturation / forward_gain, forward_scale}.current(v_e) +
         emitter_leak.current(v_e) + leak * v_e;
}

Expr BipolarTransistor::collector_current(const Expr& v_c) const {
  return Junction{saturation / reverse_gain, reverse_scale}.current(v_c) +
         collector_leak.current(v_c) + leak * v_c;
}

}  // namespace courant
