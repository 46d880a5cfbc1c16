#include "courant/structures/product_structure.hpp"

#include <algorithm>

#include "courant/structures/structure_checks.hpp"

namespace courant {

namespace {

using ManifoldPointer = std::shared_ptr<const Manifold>;
using StructurePointer = std::shared_ptr<const DiracStructure>;
using StructurePointers = std::vector<StructurePointer>;

Index sum(const StructurePointers& factors, Index (DiracStructure::*size)() const) {
  Index total = 0;
  for (const StructurePointer& factor : factors)
    total += (not_null(factor, "ProductStructure").*size)();
  return total;
}

std::shared_ptr<const Product> product_of(const StructurePointers& factors) {
  std::vector<ManifoldPointer> manifolds;
  for (const StructurePointer& factor : factors)
    manifolds.push_back(not_null(factor, "ProductStructure").manifold());
  return std::make_shared<Product>(manifolds);
}

}  // namespace

ProductStructure::ProductStructure(StructurePointers factors)
    : ProductStructure(factors, product_of(factors)) {}

ProductStructure::ProductStructure(StructurePointers factors,
                                   std::shared_ptr<const Product> manifold)
    : DiracStructure("ProductStructure", manifold, sum(factors, &DiracStructure::port_size),
                     sum(factors, &DiracStructure::equation_count)),
      factors_(std::move(factors)),
      product_(std::move(manifold)) {
  const std::string where = "ProductStructure::ProductStructure";
  require_equal(where, "the number of factors of the manifold",
                static_cast<Index>(product_->factors().size()),
                static_cast<Index>(factors_.size()));
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    const Manifold &given = *product_->factors()[i], &own = *factors_[i]->manifold();
    require_equal(where, "the ambient dimension of a factor", given.ambient_dimension(),
                  own.ambient_dimension());
    require_equal(where, "the tangent dimension of a factor", given.tangent_dimension(),
                  own.tangent_dimension());
  }
}

bool ProductStructure::is_dirac() const {
  return std::ranges::all_of(factors_, [](const auto& factor) { return factor->is_dirac(); });
}

ExprVector ProductStructure::do_membership(const ExprVector& x, const ExprVector& v,
                                           const ExprVector& alpha, const ExprVector& u) const {
  ExprVector residual(equation_count());
  Index equation = 0, port = 0;
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    const DiracStructure& factor = *factors_[i];
    residual.segment(equation, factor.equation_count()) =
        factor.membership(product_->point_part(x, i), product_->tangent_part(v, i),
                          product_->tangent_part(alpha, i), u.segment(port, factor.port_size()));
    equation += factor.equation_count();
    port += factor.port_size();
  }
  return residual;
}

}  // namespace courant
