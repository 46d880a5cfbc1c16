// A Dirac structure transformed by a two-form.
#pragma once

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/matrix_field.hpp"

namespace courant {

// τ_B D = {(v, α + B♭(v)) : (v, α) ∈ D}: F_D stays, ω_D becomes ω_D + B on F_D. Dirac (coisotropic)
// if D is. It keeps integrability if and only if dB vanishes on F_D.
//
// B(x): Ñ × Ñ, B_ij = B(e_i, e_j), skew, restricted to T_xM where n < Ñ.
class GaugeTransformed final : public DiracStructure {
 public:
  GaugeTransformed(std::shared_ptr<const DiracStructure> structure, MatrixField form);
  bool is_dirac() const override { return structure_->is_dirac(); }
  Index tangent_blocks() const override { return structure_->tangent_blocks(); }

 private:
  ExprVector do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  std::shared_ptr<const DiracStructure> structure_;
  MatrixField form_;
};

}  // namespace courant
