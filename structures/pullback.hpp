// The backward image of a Dirac structure along a map.
#pragma once

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/smooth_map.hpp"

namespace courant {

// φ^!D = {(v, φ*β) : (Tφ v, β) ∈ D_{φ(y)}} on N, for φ: N → M and D on M: Dirac at each point, a
// smooth bundle where ker (Tφ)* ∩ D has constant dimension; integrable there if D is.
//
// For the graph of ω it is the graph of φ*ω; for an inclusion φ it restricts D to a submanifold.
// Port variables: those of D, then β ∈ R^Ñ_M.
class Pullback final : public DiracStructure {
 public:
  Pullback(SmoothMap phi, std::shared_ptr<const DiracStructure> structure);
  bool is_dirac() const override { return structure_->is_dirac(); }

 private:
  ExprVector do_membership(const ExprVector& y, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  SmoothMap phi_;
  std::shared_ptr<const DiracStructure> structure_;
};

}  // namespace courant
