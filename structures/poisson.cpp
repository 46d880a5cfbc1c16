#include "courant/structures/poisson.hpp"

#include "courant/structures/matrix_at.hpp"

namespace courant {

namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

}  // namespace

Poisson::Poisson(ManifoldPointer manifold, Bivector bivector)
    : DiracStructure("Poisson", manifold, 0, tangent_size(manifold)),
      bivector_(std::move(bivector)) {}

ExprVector Poisson::do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                                  const ExprVector&) const {
  const Index n = manifold()->tangent_dimension();
  return v - matrix_at(bivector_, x, n, n, name(), "the bivector") * alpha;
}

}  // namespace courant
