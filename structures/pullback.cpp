#include "courant/structures/pullback.hpp"

#include <stdexcept>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/structures/structure_checks.hpp"

namespace courant {

namespace {

using StructurePointer = std::shared_ptr<const DiracStructure>;

}  // namespace

Pullback::Pullback(SmoothMap phi, StructurePointer structure)
    : DiracStructure{"Pullback(" + not_null(structure, "Pullback").name() + ")", phi.source(),
                     structure->port_size() + phi.target()->tangent_dimension(),
                     structure->equation_count() + phi.source()->tangent_dimension()},
      phi_(std::move(phi)),
      structure_(std::move(structure)) {
  if (*phi_.target() != *structure_->manifold())
    throw std::invalid_argument(name() + "::Pullback: phi leads to " + phi_.target()->name() +
                                "; expected the manifold of the structure, " +
                                structure_->manifold()->name() + ".");
}

ExprVector Pullback::do_membership(const ExprVector& y, const ExprVector& v,
                                   const ExprVector& alpha, const ExprVector& u) const {
  const ExprMatrix tangent = phi_.tangent(y);
  const ExprVector image = phi_(y);
  const ExprVector beta = phi_.target()->tangent_projector(image).transpose() *
                          ExprVector(u.tail(phi_.target()->tangent_dimension()));
  return joined(structure_->membership(image, tangent * v, beta, u.head(structure_->port_size())),
                alpha - tangent.transpose().eval() * beta);
}

}  // namespace courant
