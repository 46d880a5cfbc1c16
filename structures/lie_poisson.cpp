#include "courant/structures/lie_poisson.hpp"

#include <stdexcept>

#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/structures/lie_group.hpp"

namespace courant {

namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;

LieAlgebra whole(const LieAlgebra& g, const std::vector<MatrixXd>& rho) {
  return rho.empty() ? g : LieAlgebra::semidirect(g, rho);
}
ManifoldPointer with_attitude(Index size, const ManifoldPointer& group) {
  const auto flat = std::make_shared<Euclidean>(size);
  if (!group) return flat;
  return std::make_shared<Product>(std::vector<ManifoldPointer>{flat, group});
}

}  // namespace

LiePoisson::LiePoisson(const LieAlgebra& algebra, Sign sign)
    : LiePoisson(algebra, std::make_shared<Euclidean>(algebra.dimension()), sign) {}

LiePoisson::LiePoisson(const LieAlgebra& algebra, ManifoldPointer manifold, Sign sign)
    : DiracStructure("LiePoisson(" + algebra.name() + ")", manifold, 0, algebra.dimension()),
      algebra_(algebra),
      acting_(algebra),
      sign_(sign) {
  const Index n = algebra.dimension();
  if (manifold->dimension() != n || manifold->ambient_dimension() != n)
    throw std::invalid_argument(name() + "::LiePoisson: manifold is " + manifold->name() +
                                "; expected an open subset of R^" + std::to_string(n) + ".");
}

LiePoisson::LiePoisson(const LieAlgebra& g, std::vector<MatrixXd> rho, Sign sign,
                       ManifoldPointer group)
    : DiracStructure(
          "LiePoisson(" + whole(g, rho).name() + (group ? ", " + group->name() : "") + ")",
          with_attitude(whole(g, rho).dimension(), group), 0,
          whole(g, rho).dimension() + (group ? group->tangent_dimension() : 0)),
      algebra_(whole(g, rho)),
      acting_(g),
      representation_(std::move(rho)),
      sign_(sign),
      group_(std::move(group)) {
  if (!group_) return;
  if (sign == Sign::plus)
    throw std::invalid_argument(name() +
                                "::LiePoisson: there is a group, and the sign is plus; expected "
                                "minus, of left-invariant systems.");
  if (!is_group_of(group_, acting_))
    throw std::domain_error(name() + "::LiePoisson: " + acting_.name() +
                            " is not the Lie algebra of " + group_->name() +
                            "; expected the brackets of its left-invariant fields.");
}

ExprMatrix LiePoisson::bivector(const ExprVector& mu) const {
  const Index n = algebra_.dimension();
  const double sign = sign_ == Sign::minus ? -1.0 : 1.0;
  const Index g = group_ ? acting_.dimension() : 0;
  ExprMatrix result = ExprMatrix::Zero(n + g, n + g);
  for (Index i = 0; i < g; ++i) {
    result(i, n + i) = -1.0;
    result(n + i, i) = 1.0;
  }
  for (Index k = 0; k < n; ++k)
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j)
        if (const double c = algebra_.constants()[static_cast<std::size_t>(k)](i, j); c != 0.0)
          result(i, j) += sign * c * mu[k];
  return result;
}

ExprVector LiePoisson::do_membership(const ExprVector& mu, const ExprVector& v,
                                     const ExprVector& alpha, const ExprVector&) const {
  return v - bivector(mu) * alpha;
}

}  // namespace courant
