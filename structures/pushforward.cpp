#include "courant/structures/pushforward.hpp"

#include <stdexcept>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/structures/structure_checks.hpp"

namespace courant {

namespace {

using StructurePointer = std::shared_ptr<const DiracStructure>;

}  // namespace

Pushforward::Pushforward(SmoothMap phi, SmoothMap section, StructurePointer structure)
    : DiracStructure{"Pushforward(" + not_null(structure, "Pushforward").name() + ")", phi.target(),
                     structure->port_size() + phi.source()->tangent_dimension(),
                     structure->equation_count() + phi.target()->tangent_dimension()},
      phi_(std::move(phi)),
      section_(std::move(section)),
      structure_(std::move(structure)) {
  if (*phi_.source() != *structure_->manifold() || *section_.target() != *phi_.source() ||
      *section_.source() != *phi_.target())
    throw std::invalid_argument(
        name() +
        "::Pushforward: phi and section do not fit the structure; expected phi from the "
        "manifold of the structure, and section back to it.");
}

ExprVector Pushforward::do_membership(const ExprVector& y, const ExprVector& v,
                                      const ExprVector& alpha, const ExprVector& u) const {
  const ExprVector x = section_(y);
  const ExprMatrix tangent = phi_.tangent(x);
  const ExprVector w =
      phi_.source()->tangent_projector(x) * ExprVector(u.tail(phi_.source()->tangent_dimension()));
  return joined(structure_->membership(x, w, tangent.transpose().eval() * alpha,
                                       u.head(structure_->port_size())),
                v - tangent * w);
}

}  // namespace courant
