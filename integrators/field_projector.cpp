#include "courant/integrators/field_projector.hpp"

#include <stdexcept>

#include "courant/core/expr_vectors.hpp"
#include "courant/core/message.hpp"

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
  const ExprVector entries = V.reshaped();
  is_constant_ = !depends(entries, x);
  fields_ = Function("fields", {{"x", x}}, entries);
}

MatrixXd FieldProjector::do_directions(const VectorXd& x, const LinearMap<double>& basis,
                                       const MatrixXd&) const {
  return basis.transpose() * MatrixXd(fields_({x}).reshaped(basis.rows(), count_));
}

}  // namespace courant
