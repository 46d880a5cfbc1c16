#include "courant/integrators/maps/product_map.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace courant {
namespace {

using Factors = std::vector<std::shared_ptr<const DiscretizationMap>>;

std::string product_name(const Factors& factors) {
  std::string result;
  for (const auto& factor : factors)
    result += (result.empty() ? "" : ", ") + (factor ? factor->name() : std::string("null"));
  return "ProductMap(" + result + ")";
}

}  // namespace

ProductMap::ProductMap(std::shared_ptr<const Product> manifold, Factors factors)
    : DiscretizationMap(product_name(factors), manifold),
      product_(std::move(manifold)),
      factors_(std::move(factors)) {
  if (factors_.size() != product_->factors().size())
    throw std::invalid_argument(name() + "::ProductMap: factors has " +
                                std::to_string(factors_.size()) + " entries, expected " +
                                std::to_string(product_->factors().size()) +
                                ", one for each factor of the manifold.");
  for (std::size_t i = 0; i < factors_.size(); ++i)
    if (!factors_[i] || *factors_[i]->manifold() != *product_->factors()[i])
      throw std::invalid_argument(name() + "::ProductMap: factor " + std::to_string(i) +
                                  " is not a discretization map on " +
                                  product_->factors()[i]->name() +
                                  "; expected one on that factor of the manifold.");
}

bool ProductMap::is_left_invariant() const {
  return std::ranges::all_of(factors_,
                             [](const auto& factor) { return factor->is_left_invariant(); });
}

double ProductMap::domain_radius() const {
  double radius = std::numeric_limits<double>::infinity();
  for (const auto& factor : factors_) radius = std::min(radius, factor->domain_radius());
  return radius;
}

bool ProductMap::has_inverse() const {
  return std::ranges::all_of(factors_, [](const auto& factor) { return factor->has_inverse(); });
}

int ProductMap::order() const {
  int result = std::numeric_limits<int>::max();
  for (const auto& factor : factors_) result = std::min(result, factor->order());
  return result;
}

double ProductMap::stage_time() const {
  return factors_.empty() ? DiscretizationMap::stage_time() : factors_.front()->stage_time();
}

bool ProductMap::is_symmetric() const {
  return std::ranges::all_of(factors_, [](const auto& factor) { return factor->is_symmetric(); });
}

DiscretizationMap::PointPair<Expr> ProductMap::do_forward(const ExprVector& x,
                                                          const ExprVector& v) const {
  PointPair<Expr> result{ExprVector(x.size()), ExprVector(x.size())};
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    const auto [first, second] = factors_[i]->forward(ExprVector(product_->point_part(x, i)),
                                                      ExprVector(product_->tangent_part(v, i)));
    product_->point_part(result.first, i) = first;
    product_->point_part(result.second, i) = second;
  }
  return result;
}

DiscretizationMap::TangentVector<Expr> ProductMap::do_inverse(const ExprVector& x0,
                                                              const ExprVector& x1) const {
  TangentVector<Expr> result{ExprVector(x0.size()), ExprVector(product_->tangent_dimension())};
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    const auto [x, v] = factors_[i]->inverse(ExprVector(product_->point_part(x0, i)),
                                             ExprVector(product_->point_part(x1, i)));
    product_->point_part(result.x, i) = x;
    product_->tangent_part(result.v, i) = v;
  }
  return result;
}

DiscretizationMap::Displacement ProductMap::do_from_start(const ExprVector& x0,
                                                          const ExprVector& w) const {
  Displacement result{ExprVector(x0.size()), ExprVector(w.size()), ExprVector(x0.size())};
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    const Displacement factor =
        factors_[i]->from_start(product_->point_part(x0, i), product_->tangent_part(w, i));
    product_->point_part(result.x, i) = factor.x;
    product_->tangent_part(result.v, i) = factor.v;
    product_->point_part(result.end, i) = factor.end;
  }
  return result;
}

}  // namespace courant
