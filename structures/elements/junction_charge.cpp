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
  const double diffused = transit * saturation, leaking = transit * leak, m = grading;
  const Expr positive = max(q, Expr(0.0));
  const Expr curved = diffused == 0.0 ? Expr(0.0) : Expr(scale * log(1.0 + positive / diffused));
  // Beside exp the leak is straight, alone below 0 and side by side above it.
  const auto beside_curved = [&](const Expr& straight) {
    constexpr double least = 1e-300;  // V, for 0/0
    return diffused == 0.0 ? straight : straight * curved / (straight + curved + least);
  };
  if (capacitance == 0.0)
    return select(q <= Expr(0.0), q / (diffused / scale + leaking),
                  leaking == 0.0 ? curved : beside_curved(positive / leaking));
  // Below 0 by (1 - v/v_j)^(1-m); above it, side by side, by v = q/C₀ and v = scale log (1 + q/(τ saturation)).
  const double part = capacitance / (capacitance + diffused / scale);
  const Expr root = 1.0 - min(q, Expr(0.0)) * (1.0 - m) / (capacitance * junction);
  const Expr below = part * junction * (1.0 - pow(root, Expr(1.0 / (1.0 - m))));
  return select(q <= Expr(0.0), below, beside_curved(positive / capacitance));
}

}  // namespace courant::elements
