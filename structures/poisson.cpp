#include "courant/structures/poisson.hpp"

namespace courant {

Poisson::Poisson(std::shared_ptr<const Manifold> manifold, Bivector bivector)
    : DiracStructure("Poisson", manifold, 0, manifold ? manifold->tangent_dimension() : 0),
      bivector_(std::move(bivector)) {}

ExprVector Poisson::do_membership(const ExprVector& x, const ExprVector& v, const ExprVector& alpha,
                                  const ExprVector&) const {
  return v - bivector_(x) * alpha;
}

}  // namespace courant
