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

// The matrix of v ↦ ⟨p, T(v, ·)⟩.
ExprMatrix CanonicalSymplectic::torsion(const ExprVector& x) const {
  const Index n = phase_space_->base()->tangent_dimension();
  ExprMatrix result(n, n);
  for (Index j = 0; j < n; ++j)
    result.col(j) = phase_space_->torsion(phase_space_->position(x), phase_space_->momentum(x),
                                          ExprVector::Unit(n, j));
  return result;
}

ExprMatrix CanonicalSymplectic::form(const ExprVector& x) const {
  const Index n = phase_space_->base()->tangent_dimension();
  ExprMatrix omega = ExprMatrix::Zero(2 * n, 2 * n);
  omega.topLeftCorner(n, n) = -torsion(x).transpose();
  omega.topRightCorner(n, n).setIdentity();
  omega.bottomLeftCorner(n, n) = -ExprMatrix::Identity(n, n);
  return omega;
}

ExprMatrix CanonicalSymplectic::bivector(const ExprVector& x) const {
  const Index n = phase_space_->base()->tangent_dimension();
  ExprMatrix lambda = ExprMatrix::Zero(2 * n, 2 * n);
  lambda.topRightCorner(n, n).setIdentity();
  lambda.bottomLeftCorner(n, n) = -ExprMatrix::Identity(n, n);
  lambda.bottomRightCorner(n, n) = -torsion(x);
  return lambda;
}

}  // namespace courant
