#include "courant/structures/gauge_transformed.hpp"

#include "courant/structures/structure_checks.hpp"

namespace courant {

namespace {

using StructurePointer = std::shared_ptr<const DiracStructure>;

}  // namespace

GaugeTransformed::GaugeTransformed(StructurePointer structure, MatrixField form)
    : DiracStructure{"GaugeTransformed(" + not_null(structure, "GaugeTransformed").name() + ")",
                     structure->manifold(), structure->port_size(), structure->equation_count(),
                     structure->port_names()},
      structure_(std::move(structure)),
      form_(std::move(form)) {}

ExprVector GaugeTransformed::do_membership(const ExprVector& x, const ExprVector& v,
                                           const ExprVector& alpha, const ExprVector& u) const {
  const ExprMatrix B = form_(x);
  const Index n = manifold()->tangent_dimension();
  require_equal(name() + "::membership", "the number of rows of the form", B.rows(), n);
  require_equal(name() + "::membership", "the number of columns of the form", B.cols(), n);
  const LinearMap<Expr> projector = manifold()->tangent_projector(x);
  const ExprVector shift =
      projector.transpose() * ExprVector(B.transpose().eval() * (projector * v));
  return structure_->membership(x, v, alpha - shift, u);
}

}  // namespace courant
