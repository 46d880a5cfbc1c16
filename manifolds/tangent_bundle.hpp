// The tangent bundle of any manifold.
#pragma once

#include "courant/manifolds/vector_bundle.hpp"

namespace courant {

// TM = {(x, u) : x ∈ M, u ∈ T_xM}, of dimension 2n: points, tangent vectors, frames, retraction and
// its domain as in VectorBundle, with the fibre projector F = Π of M. u is in the tangent
// representation of M.
class TangentBundle final : public VectorBundle {
 public:
  explicit TangentBundle(std::shared_ptr<const Manifold> base)
      : VectorBundle("TangentBundle", std::move(base)) {}

 private:
  LinearMap<Expr> fibre_projector(const ExprVector& x) const override {
    return base()->tangent_projector(x);
  }
};

}  // namespace courant
