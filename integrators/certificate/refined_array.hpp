// RefinedArray: a derivative array beside a zero that is known to 113 bits.
#pragma once

#include <optional>
#include <vector>

#include "courant/core/numbers/quadruple.hpp"
#include "courant/integrators/certificate/derivative_array.hpp"
#include "courant/integrators/certificate/nearest_zero.hpp"

namespace courant {

// F^[k] at y + δ, where δ corrects a zero of F^[k] that doubles round: F, its Jacobian and δ are computed with 113
// bits. Bounds of errors grow with the unit of rounding, so that they are those of the derivative array at y,
// divided by 2⁶⁰, and the rounding of each result. What cancels, and what the rounding of y makes of F, is then told
// from numbers. All that is given, constants of formulas as well, is the double that it is.
class RefinedArray final : public Prolongation {
 public:
  // Newton's method for δ from 0, of least norm in comparable units. Nothing where it does not converge, where an
  // operation has no 113 bits, and for more than 200 unknowns. `array` must live as long.
  static std::optional<RefinedArray> at(const DerivativeArray& array, const Zero& zero);

  VectorXd correction() const;  // δ, rounded

  bool has_constant_jacobian() const override { return array_->has_constant_jacobian(); }

 private:
  RefinedArray(const DerivativeArray& array, Index size);

  std::vector<Quadruple> refined(const VectorXd& y) const;  // y + δ
  Linearization do_linearize(const VectorXd& y, const VectorXd& uncertainty,
                             Index k) const override;
  VectorXd do_residual(const VectorXd& y, Index k) const override;

  const DerivativeArray* array_;
  std::vector<Quadruple> correction_;  // δ
  // Errors of y whose parts by 2⁶⁰ are those of y + δ: |δ|, its rounding, and 2⁶⁰ times the step of Newton's method
  // that was not made.
  VectorXd rounded_;
};

}  // namespace courant
