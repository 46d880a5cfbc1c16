// The inverse of a discretization map by Newton's method.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "courant/core/expressions/function.hpp"
#include "courant/manifolds/manifold.hpp"

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
  // Of R_d as its formulas have it, (x, v) ↦ (x⁻, x⁺).
  using Forward =
      std::function<std::pair<ExprVector, ExprVector>(const ExprVector& x, const ExprVector& v)>;
  Inversion(std::string name, std::shared_ptr<const Manifold> manifold, const Forward& forward);
  // Of a DiscretizationMap.
  template <class Map>
  explicit Inversion(const Map& map)
      : Inversion(map.name(), map.manifold(), [&](const ExprVector& x, const ExprVector& v) {
          auto ends = map.forward(x, v);
          return std::pair(std::move(ends.first), std::move(ends.second));
        }) {}

  struct TangentVector {
    VectorXd x, v;
  };
  // Throws std::invalid_argument on wrong sizes, std::domain_error where it does not converge.
  TangentVector operator()(const VectorXd& x0, const VectorXd& x1) const;

 private:
  std::string name_;
  std::shared_ptr<const Manifold> manifold_;
  Function image_;  // (ξ, η); x₀, B ↦ R_d(x, v), x, v
};

}  // namespace courant
