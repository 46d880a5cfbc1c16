#include "courant/structures/elements/junction_charge.hpp"

#include <cmath>

namespace courant::elements {
namespace {

constexpr double kLargestExponent = 60.0;

}  // namespace

Expr bounded_exp(const Expr& exponent) {
  const double top = std::exp(kLargestExponent);
  return select(exponent < Expr(kLargestExponent), exp(exponent),
                top * (1.0 + exponent - kLargestExponent));
}

Expr JunctionCurrent::current(const Expr& v) const {
  Expr i = saturation == 0.0 ? Expr(0.0) : saturation * (bounded_exp(v / scale) - 1.0);
  if (leak != 0.0) i += leak * v;
  if (breakdown > 0.0) i -= breakdown_current * bounded_exp(-(v + breakdown) / scale);
  return i;
}

Expr JunctionCurrent::integral(const Expr& v) const {
  return saturation * (scale * (bounded_exp(v / scale) - 1.0) - v) + leak / 2.0 * square(v);
}

Expr JunctionCharge::charge(const Expr& v) const {
  Expr q = transit * saturation * (bounded_exp(v / scale) - 1.0);
  if (leak != 0.0) q += transit * leak * v;
  if (capacitance == 0.0) return q;
  const double m = grading, top = forward * junction;
  const auto depletion = [&](const Expr& at) {
    return capacitance * junction / (1.0 - m) * (1.0 - pow(1.0 - at / junction, Expr(1.0 - m)));
  };
  const double slope = capacitance / std::pow(1.0 - forward, 1.0 + m);
  const Expr beyond = depletion(top) + slope * ((1.0 - forward * (1.0 + m)) * (v - top) +
                                                m / (2.0 * junction) * (square(v) - top * top));
  return q + select(v < Expr(top), depletion(min(v, Expr(top))), beyond);
}

Expr JunctionCharge::energy(const Expr& v) const {
  const Expr power = bounded_exp(v / scale);
  // τ (v i - ∫ i dv)
  Expr stored = transit * saturation * (v * power - scale * (power - 1.0));
  if (leak != 0.0) stored += transit * leak / 2.0 * square(v);
  if (capacitance == 0.0) return stored;
  const double m = grading, top = forward * junction;
  const auto depletion = [&](const Expr& at) {
    const Expr a = 1.0 - at / junction;
    return capacitance * junction * junction *
           ((1.0 - pow(a, Expr(1.0 - m))) / (1.0 - m) - (1.0 - pow(a, Expr(2.0 - m))) / (2.0 - m));
  };
  const double slope = capacitance / std::pow(1.0 - forward, 1.0 + m);
  const Expr beyond =
      depletion(top) + slope * ((1.0 - forward * (1.0 + m)) * (square(v) - top * top) / 2.0 +
                                m / (3.0 * junction) * (v * square(v) - top * top * top));
  return stored + select(v < Expr(top), depletion(min(v, Expr(top))), beyond);
}

Expr JunctionCharge::about_voltage(const Expr& q) const {
  const double diffused = transit * saturation, m = grading;
  const double straight = capacitance == 0.0 ? transit * leak : capacitance;
  Expr linear = q;  // straight times the voltage of a junction without the diffusion of charge
  if (capacitance != 0.0) {
    // The inverse of the depletion up to a tenth of v_j, and its tangent beyond.
    const double last = std::pow(0.9, m);
    const double top = capacitance * junction / (1.0 - m) * (1.0 - 0.9 / last);
    const Expr below = min(q, Expr(top));
    const Expr root = 1.0 - below * (1.0 - m) / (capacitance * junction);
    linear = capacitance * junction * (1.0 - pow(root, Expr(1.0 / (1.0 - m)))) + last * (q - below);
  }
  if (diffused == 0.0) return linear / straight;
  // Diffused charge beside it: v = q/straight and v = scale log (1 + q/diffused) side by side, where q > 0. The rounded
  // part of `linear` above 0 has no edge at 0, where many a junction starts, and its logarithm no zero.
  const double width = 2.0 * (straight * scale + diffused);
  const Expr above = (linear + sqrt(square(linear) + width * width)) / 2.0;
  const Expr part = 1.0 + above / diffused;
  return linear / (straight + diffused / scale * part / log(1.0 + part));
}

}  // namespace courant::elements
