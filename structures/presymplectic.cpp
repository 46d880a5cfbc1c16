#include "courant/structures/presymplectic.hpp"

#include "courant/structures/matrix_at.hpp"

namespace courant {

namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

}  // namespace

Presymplectic::Presymplectic(ManifoldPointer manifold, MatrixField form)
    : DiracStructure("Presymplectic", manifold, 0, tangent_size(manifold)),
      form_(std::move(form)) {}

ExprVector Presymplectic::do_membership(const ExprVector& x, const ExprVector& v,
                                        const ExprVector& alpha, const ExprVector&) const {
  const Index n = manifold()->tangent_dimension();
  const ExprMatrix omega = matrix_at(form_, x, n, n, name(), "the form").transpose();
  const LinearMap<Expr> projector = manifold()->tangent_projector(x);
  return alpha - projector.transpose() * ExprVector(omega * (projector * v));
}

}  // namespace courant
