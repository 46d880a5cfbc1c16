// The Stiefel manifold of orthonormal k-frames.
#pragma once

#include "courant/manifolds/manifold.hpp"

namespace courant {

// St(n, k) = {X ∈ R^{n×k} : XᵀX = 1}, 1 ≤ k ≤ n, of dimension nk - k(k+1)/2. Points and vectors are
// n × k matrices, row after row.
//
//   tangent V with XᵀV + VᵀX = 0,   covector likewise;   E(X) V = C(X) V = Π(X) V = V - X sym(XᵀV)
//
// Cayley retraction: R_X(V) = (1 - W/2)⁻¹(1 + W/2) X with the skew n × n matrix
//   W = P V Xᵀ - X (P V)ᵀ,  P = 1 - XXᵀ/2,  so that W X = V:
// defined for all V, rational. Injective for all V; with M = 1 + XᵀY the inverse is
//   R_X⁻¹(Y) = 2 X M⁻ᵀ(XᵀY - YᵀX) M⁻¹ + 2 (Y - X XᵀY) M⁻¹,  where det M ≠ 0 (elsewhere not finite).
// Reference: Wen, Yin, A feasible method for optimization with orthogonality constraints (2013),
// for the retraction.
class Stiefel final : public Manifold {
 public:
  // Throws std::invalid_argument unless 1 ≤ k ≤ n.
  Stiefel(Index n, Index k);

 private:
  bool do_equals(const Manifold& other) const override { return other.name() == name(); }
  ExprVector do_retract(const ExprVector& x, const ExprVector& v) const override;
  ExprVector do_inverse_retract(const ExprVector& x, const ExprVector& y) const override;
  ExprMatrix do_frame(const ExprVector& x) const override;
  ExprMatrix do_coframe(const ExprVector& x) const override { return do_frame(x); }
  ExprVector do_constraint(const ExprVector& x) const override;
  VectorXd do_project(const VectorXd& x) const override;  // the polar factor

  Index n_, k_;
};

}  // namespace courant
