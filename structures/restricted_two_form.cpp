#include "courant/structures/restricted_two_form.hpp"

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/structures/matrix_at.hpp"

namespace courant {

namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

}  // namespace

RestrictedTwoForm::RestrictedTwoForm(ManifoldPointer manifold, MatrixField form, Index m,
                                     MatrixField one_forms)
    : DiracStructure("RestrictedTwoForm", manifold, m, tangent_size(manifold) + m),
      form_(std::move(form)),
      one_forms_(std::move(one_forms)) {}

ExprVector RestrictedTwoForm::do_membership(const ExprVector& x, const ExprVector& v,
                                            const ExprVector& alpha, const ExprVector& u) const {
  const Index n = manifold()->tangent_dimension();
  const ExprMatrix omega = matrix_at(form_, x, n, n, name(), "the form").transpose();
  const ExprMatrix mu =
      matrix_at(one_forms_, x, n, port_size(), name(), "the matrix of the one-forms");
  const LinearMap<Expr> projector = manifold()->tangent_projector(x);
  const ExprVector covector = omega * (projector * v) + mu * u;
  return joined(alpha - projector.transpose() * covector, mu.transpose().eval() * v);
}

}  // namespace courant
