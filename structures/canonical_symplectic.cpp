#include "courant/structures/canonical_symplectic.hpp"

namespace courant {

CanonicalSymplectic::CanonicalSymplectic(std::shared_ptr<const CotangentBundle> phase_space)
    : DiracStructure("CanonicalSymplectic", phase_space, 0,
                     phase_space ? phase_space->tangent_dimension() : 0),
      phase_space_(std::move(phase_space)) {}

ExprVector CanonicalSymplectic::do_membership(const ExprVector& x, const ExprVector& v,
                                              const ExprVector& alpha, const ExprVector&) const {
  const ExprVector velocity = phase_space_->horizontal(v);
  const ExprVector torsion =
      phase_space_->torsion(phase_space_->position(x), phase_space_->momentum(x), velocity);
  ExprVector residual(equation_count());
  residual << velocity - phase_space_->vertical(alpha),
      phase_space_->vertical(v) + torsion + phase_space_->horizontal(alpha);
  return residual;
}

}  // namespace courant
