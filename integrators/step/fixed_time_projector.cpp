#include "courant/integrators/step/fixed_time_projector.hpp"

#include <stdexcept>

namespace courant {

FixedTimeProjector::FixedTimeProjector(std::shared_ptr<const Projector> projector,
                                       std::shared_ptr<const Manifold> manifold)
    : Projector(projector ? projector->name()
                          : throw std::invalid_argument(
                                "FixedTimeProjector::FixedTimeProjector: the projector is null.")),
      projector_(std::move(projector)),
      manifold_(std::move(manifold)) {
  if (!manifold_)
    throw std::invalid_argument("FixedTimeProjector::FixedTimeProjector: the manifold is null.");
}

// Of T_(x,t)(M × R) the part of T_xM, and of covectors there what they say at the time t.
ExprMatrix FixedTimeProjector::do_directions(const ExprVector& x, const Expr&,
                                             const LinearMap<Expr>& tangents,
                                             const ExprMatrix& conormals) const {
  const Index size = manifold_->tangent_dimension();
  const LinearMap<Expr> of_point =
      tangents.is_identity() ? LinearMap<Expr>::identity(size)
                             : LinearMap<Expr>(tangents.entries().topLeftCorner(size, size));
  ExprMatrix moves = ExprMatrix::Zero(conormals.rows(), conormals.cols());
  const Index N = manifold_->ambient_dimension();
  moves.topRows(size) = projector_->span(x.head(N), x[N], of_point, conormals.topRows(size));
  return moves;
}

}  // namespace courant
