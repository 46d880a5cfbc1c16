#include "courant/structures/matrix_at.hpp"

#include <stdexcept>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/words/message.hpp"

namespace courant {

Index tangent_size(const std::shared_ptr<const Manifold>& manifold) {
  return manifold ? manifold->tangent_dimension() : 0;
}

ExprMatrix matrix_at(const MatrixField& field, const ExprVector& x, Index rows, Index columns,
                     const std::string& name, const char* matrix) {
  ExprMatrix value = field(x);
  if (value.rows() == rows && value.cols() == columns) return value;
  throw std::invalid_argument(name + "::membership: " + matrix + " is " +
                              size_text(value.rows(), value.cols()) + "; expected " +
                              size_text(rows, columns) + ".");
}

ExprVector restricted_residual(const ExprMatrix& lambda, const ExprMatrix& X, const ExprVector& v,
                               const ExprVector& alpha, const ExprVector& u) {
  return joined(v - lambda * alpha - X * u, X.transpose().eval() * alpha);
}

}  // namespace courant
