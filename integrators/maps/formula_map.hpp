// A discretization map by formulas.
#pragma once

#include <functional>

#include "courant/integrators/maps/discretization_map.hpp"

namespace courant {

// R_d(x, v) = (R⁻(x, v), R⁺(x, v)) by two functions, and if it has one its inverse (x, v)(x₀, x₁).
//
// Whether it is a discretization map is measured on construction, at random points: it leads to M, D1,
// D2, and D3 for the inverse that is given. What it claims is measured there too: it is symmetric, and of order 2, if
// R⁺(x, v) = R⁻(x, -v), else of order 1 (which may be too modest); it evaluates systems at θ with
// R⁻(x, s v) = x - s θ v + O(s²).
class FormulaMap final : public DiscretizationMap {
 public:
  using Map = std::function<ExprVector(const ExprVector& x, const ExprVector& v)>;
  // R⁻ and R⁺, and the inverse.
  struct Formulas {
    Map minus, plus;              // (x, v) ↦ x⁻, x⁺
    Map point = {}, vector = {};  // (x₀, x₁) ↦ x, v; both or none
  };

  // Throws std::domain_error where a law fails, std::invalid_argument on wrong sizes.
  FormulaMap(std::shared_ptr<const Manifold> manifold, Formulas formulas);

  bool has_inverse() const override { return static_cast<bool>(formulas_.point); }
  int order() const override { return is_symmetric_ ? 2 : 1; }
  bool is_symmetric() const override { return is_symmetric_; }
  double stage_time() const override { return stage_time_; }

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override;
  TangentVector<Expr> do_inverse(const ExprVector& x0, const ExprVector& x1) const override;
  // Throws std::domain_error where a law does not hold at x.
  void measure(const VectorXd& x, std::mt19937& generator);

  Formulas formulas_;
  bool is_symmetric_ = true;
  double stage_time_ = 0.5;
};

}  // namespace courant
