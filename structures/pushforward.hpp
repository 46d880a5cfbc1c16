// The forward image of a Dirac structure along a map.
#pragma once

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/smooth_map.hpp"

namespace courant {

// φ_!D = {(Tφ w, β) : (w, φ*β) ∈ D_{σ(y)}} on N, for φ: M → N, D on M and a section σ: N → M,
// φ(σ(y)) = y. It does not depend on σ where D is the same along the fibres of φ (a diffeomorphism;
// reduction by a symmetry of D): that is for the caller to know. For the graph of Λ it is the graph
// of φ_*Λ.
//
// Port variables: those of D, then w ∈ R^Ñ_M.
class Pushforward final : public DiracStructure {
 public:
  // phi from the manifold of `structure`, section back to it; std::invalid_argument otherwise.
  Pushforward(SmoothMap phi, SmoothMap section, std::shared_ptr<const DiracStructure> structure);
  bool is_dirac() const override { return structure_->is_dirac(); }

 private:
  ExprVector do_membership(const ExprVector& y, const ExprVector& v, const ExprVector& alpha,
                           const ExprVector& u) const override;
  SmoothMap phi_;
  SmoothMap section_;
  std::shared_ptr<const DiracStructure> structure_;
};

}  // namespace courant
