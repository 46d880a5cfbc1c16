#include "courant/structures/restricted_bivector.hpp"

#include "courant/structures/matrix_at.hpp"

namespace courant {

namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

}  // namespace

RestrictedBivector::RestrictedBivector(ManifoldPointer manifold, MatrixField bivector, Index k,
                                       MatrixField fields)
    : DiracStructure("RestrictedBivector", manifold, k, tangent_size(manifold) + k),
      bivector_(std::move(bivector)),
      fields_(std::move(fields)) {}

ExprVector RestrictedBivector::do_membership(const ExprVector& x, const ExprVector& v,
                                             const ExprVector& alpha, const ExprVector& u) const {
  const Index n = manifold()->tangent_dimension();
  return restricted_residual(
      matrix_at(bivector_, x, n, n, name(), "the bivector"),
      matrix_at(fields_, x, n, port_size(), name(), "the matrix of the fields"), v, alpha, u);
}

}  // namespace courant
