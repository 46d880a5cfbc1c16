// The inverse of a discretization map by Newton's method.
#pragma once

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/maps/discretization_map.hpp"

namespace courant {

// (x₀, x₁) ↦ (x, v) with R_d(x, v) = (x₀, x₁), for maps without a closed formula: Newton's method
// on
//
//   (ξ, η) ↦ R_d(R_{x₀}(B ξ), Π B η) - (x₀, x₁)
//
// from the tangent vector that leads from x₀ to x₁. Traced once, for any number of pairs: what
// takes the time is the Jacobian of R_d as an expression. Immutable.
class Inversion {
 public:
  // `map` has to outlive it.
  explicit Inversion(const DiscretizationMap& map);

  // Throws std::invalid_argument on wrong sizes, std::domain_error where it does not converge.
  DiscretizationMap::TangentVector<double> operator()(const VectorXd& x0, const VectorXd& x1) const;

 private:
  const DiscretizationMap& map_;
  Function image_;  // (ξ, η); x₀, B ↦ R_d(x, v), x, v
};

}  // namespace courant
