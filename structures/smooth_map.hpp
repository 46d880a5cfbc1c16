// SmoothMap: a map between manifolds with its tangent map.
#pragma once

#include <functional>
#include <memory>

#include "courant/manifolds/manifold.hpp"

namespace courant {

// φ: M → N by a formula on ambient coordinates, x ∈ R^{N_M} ↦ φ(x) ∈ R^{N_N}. Immutable.
class SmoothMap {
 public:
  using Formula = std::function<ExprVector(const ExprVector& x)>;
  // Throws std::invalid_argument if a manifold is null.
  SmoothMap(std::shared_ptr<const Manifold> source, std::shared_ptr<const Manifold> target,
            Formula formula);

  const std::shared_ptr<const Manifold>& source() const { return source_; }
  const std::shared_ptr<const Manifold>& target() const { return target_; }

  // φ(x). Throws std::invalid_argument on wrong sizes.
  ExprVector operator()(const ExprVector& x) const;
  // T_xφ in the tangent representations, C_N(φ(x)) ∂φ/∂x E_M(x): Ñ_N × Ñ_M. For any expressions x.
  ExprMatrix tangent(const ExprVector& x) const;

 private:
  std::shared_ptr<const Manifold> source_, target_;
  Formula formula_;
};

}  // namespace courant
