// The product of discretization maps.
#pragma once

#include <vector>

#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/manifolds/product.hpp"

namespace courant {

// R_d = R_d¹ × … × R_d^k on M₁ × … × M_k: each factor by its own map. The order is the least one;
// symmetric if every factor is. The stage time is that of the first factor: where factors differ,
// none is right for all of them.
class ProductMap final : public DiscretizationMap {
 public:
  // factors[i] on the manifold manifold->factors()[i]; throws std::invalid_argument
  // otherwise.
  ProductMap(std::shared_ptr<const Product> manifold,
             std::vector<std::shared_ptr<const DiscretizationMap>> factors);

  double domain_radius() const override;
  bool has_inverse() const override;
  int order() const override;
  double stage_time() const override;
  bool is_symmetric() const override;
  bool is_left_invariant() const override;

 private:
  PointPair<Expr> do_forward(const ExprVector& x, const ExprVector& v) const override;
  TangentVector<Expr> do_inverse(const ExprVector& x0, const ExprVector& x1) const override;
  Displacement do_from_start(const ExprVector& x0, const ExprVector& w) const override;

  std::shared_ptr<const Product> product_;
  std::vector<std::shared_ptr<const DiscretizationMap>> factors_;
};

}  // namespace courant
