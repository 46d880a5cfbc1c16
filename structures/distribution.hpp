// A distribution and its annihilator.
#pragma once

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/matrix_field.hpp"

namespace courant {

// D = F ⊕ F° = {(v, α) : v ∈ F, ⟨α, w⟩ = 0 for all w ∈ F} for a regular distribution F ⊂ TM
// (Example 2.2.1, Theorem 2.4 with ω = 0). Integrable if and only if F is involutive (Frobenius).
//
// Where the fields or one-forms become dependent F is not regular: D is still Dirac at the point,
// but not a smooth bundle there (see rank_profile).
class Distribution final : public DiracStructure {
 public:
  // F = {v : ⟨μ^a, v⟩ = 0, a = 1 … m}, the one-forms μ^a the columns of an Ñ × m matrix:
  // v·μ = 0, α = μ λ with multipliers λ ∈ R^m.
  static Distribution annihilated_by(std::shared_ptr<const Manifold> manifold, Index m,
                                     MatrixField one_forms);
  // F = span of k vector fields, the columns of an Ñ × k matrix X: v = X c, Xᵀα = 0 with
  // coefficients c ∈ R^k.
  static Distribution spanned_by(std::shared_ptr<const Manifold> manifold, Index k,
                                 MatrixField fields);

  Index tangent_blocks() const override { return 1; }

 private:
  enum class By { one_forms, fields };
  Distribution(std::string name, std::shared_ptr<const Manifold> manifold, Index count,
               MatrixField columns, By by);
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  MatrixField columns_;
  By by_;
};

}  // namespace courant
