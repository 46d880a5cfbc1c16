#include "courant/structures/distribution.hpp"

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/structures/matrix_at.hpp"

namespace courant {

namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

}  // namespace

Distribution::Distribution(std::string name, ManifoldPointer manifold, Index count,
                           MatrixField columns, By by)
    : DiracStructure(std::move(name), manifold, count, tangent_size(manifold) + count),
      columns_(std::move(columns)),
      by_(by) {}

Distribution Distribution::annihilated_by(ManifoldPointer manifold, Index m,
                                          MatrixField one_forms) {
  return {"Distribution", std::move(manifold), m, std::move(one_forms), By::one_forms};
}

Distribution Distribution::spanned_by(ManifoldPointer manifold, Index k, MatrixField fields) {
  return {"Distribution", std::move(manifold), k, std::move(fields), By::fields};
}

ExprVector Distribution::do_membership(const ExprVector& x, const ExprVector& v,
                                       const ExprVector& alpha, const ExprVector& u) const {
  const ExprMatrix A =
      matrix_at(columns_, x, manifold()->tangent_dimension(), port_size(), name(),
                by_ == By::fields ? "the matrix of the fields" : "the matrix of the one-forms");
  const LinearMap<Expr> projector = manifold()->tangent_projector(x);
  const ExprMatrix transposed = A.transpose();
  if (by_ == By::fields) return joined(v - projector * (A * u), transposed * alpha);
  return joined(alpha - projector.transpose() * ExprVector(A * u), transposed * v);
}

}  // namespace courant
