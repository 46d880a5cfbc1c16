#include "courant/reading/junction_charge.hpp"

#include <algorithm>
#include <cmath>

namespace courant {
namespace {

constexpr double kLargestExponent = 60.0;

}  // namespace

Expr bounded_exp(const Expr& exponent) {
  const double top = std::exp(kLargestExponent);
  return select(exponent < Expr(kLargestExponent), exp(exponent),
                top * (1.0 + exponent - kLargestExponent));
}

Expr JunctionCharge::charge(const Expr& v) const {
  Expr q = transit * saturation * (bounded_exp(v / scale) - 1.0);
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

double JunctionCharge::size() const {
  return std::max({capacitance, transit * saturation / scale, 1e-15});
}

}  // namespace courant
