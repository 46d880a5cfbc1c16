#include "courant/integrators/step/field_projector.hpp"

#include <stdexcept>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/words/message.hpp"

namespace courant {

FieldProjector::FieldProjector(const Manifold& manifold, Index count, const MatrixFormula& fields,
                               VectorXd units)
    : Projector("directions", std::move(units)), count_(count) {
  Graph graph;
  const ExprVector x = graph.variables("x", manifold.ambient_dimension());
  const ExprMatrix V = fields(x);
  if (V.rows() != manifold.tangent_dimension() || V.cols() != count)
    throw std::invalid_argument("FieldProjector::FieldProjector: fields is " +
                                size_text(V.rows(), V.cols()) + "; expected " +
                                size_text(manifold.tangent_dimension(), count) +
                                ", a tangent vector of " + manifold.name() + " a column.");
  is_constant_ = !depends(ExprVector(V.reshaped()), x);
  fields_ = fields;
}

ExprMatrix FieldProjector::do_directions(const ExprVector& x, const Expr&,
                                         const LinearMap<Expr>& tangents, const ExprMatrix&) const {
  return tangents * fields_(x);
}

}  // namespace courant
