#include "courant/manifolds/product.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "courant/core/words/word_list.hpp"

namespace courant {
namespace {

using Factors = std::vector<std::shared_ptr<const Manifold>>;

const Factors& checked(const Factors& factors) {
  for (std::size_t i = 0; i < factors.size(); ++i)
    if (!factors[i])
      throw std::invalid_argument("Product::Product: factor " + std::to_string(i) +
                                  " is null; expected a manifold.");
  return factors;
}

std::string product_name(const Factors& factors) {
  return "Product(" +
         word_list(checked(factors), [](const auto& factor) { return factor->name(); }) + ")";
}

using Size = Index (Manifold::*)() const;

std::vector<Index> offsets(const Factors& factors, Size size) {
  std::vector<Index> result{0};
  for (const auto& factor : factors) result.push_back(result.back() + (*factor.*size)());
  return result;
}

Index total(const Factors& factors, Size size) { return offsets(factors, size).back(); }

}  // namespace

Product::Product(Factors factors)
    : Manifold(product_name(factors), total(checked(factors), &Manifold::dimension),
               total(checked(factors), &Manifold::ambient_dimension),
               total(checked(factors), &Manifold::tangent_dimension)),
      factors_(std::move(factors)),
      point_offset_(offsets(factors_, &Manifold::ambient_dimension)),
      tangent_offset_(offsets(factors_, &Manifold::tangent_dimension)) {}

bool Product::has_inverse() const {
  return std::ranges::all_of(factors_, [](const auto& factor) { return factor->has_inverse(); });
}

bool Product::is_geodesic() const {
  return std::ranges::all_of(factors_, [](const auto& factor) { return factor->is_geodesic(); });
}

ExprVector Product::do_retract(const ExprVector& x, const ExprVector& v) const {
  ExprVector y(x.size());
  for (std::size_t i = 0; i < factors_.size(); ++i)
    point_part(y, i) = factors_[i]->retract(point_part(x, i), tangent_part(v, i));
  return y;
}

ExprVector Product::do_inverse_retract(const ExprVector& x, const ExprVector& y) const {
  ExprVector v(tangent_dimension());
  for (std::size_t i = 0; i < factors_.size(); ++i)
    tangent_part(v, i) = factors_[i]->inverse_retract(point_part(x, i), point_part(y, i));
  return v;
}

bool Product::do_equals(const Manifold& other) const {
  return std::ranges::equal(factors_, static_cast<const Product&>(other).factors_,
                            [](const auto& a, const auto& b) { return *a == *b; });
}

std::optional<VectorXd> Product::do_unit() const {
  VectorXd result(ambient_dimension());
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    const auto unit = factors_[i]->unit();
    if (!unit) return std::nullopt;
    point_part(result, i) = *unit;
  }
  return result;
}

bool Product::do_has_identity_frame() const {
  return std::all_of(factors_.begin(), factors_.end(),
                     [](const auto& factor) { return factor->has_identity_frame(); });
}

ExprMatrix Product::do_frame(const ExprVector& x) const {
  ExprMatrix result = ExprMatrix::Zero(ambient_dimension(), tangent_dimension());
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    const ExprMatrix E = factors_[i]->frame(point_part(x, i));
    result.block(point_offset_[i], tangent_offset_[i], E.rows(), E.cols()) = E;
  }
  return result;
}

ExprMatrix Product::do_tangent_projector(const ExprVector& x) const {
  ExprMatrix result = ExprMatrix::Zero(tangent_dimension(), tangent_dimension());
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    const ExprMatrix P = factors_[i]->tangent_projector(point_part(x, i)).matrix();
    result.block(tangent_offset_[i], tangent_offset_[i], P.rows(), P.cols()) = P;
  }
  return result;
}

ExprMatrix Product::do_coframe(const ExprVector& x) const {
  ExprMatrix result = ExprMatrix::Zero(tangent_dimension(), ambient_dimension());
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    const ExprMatrix C = factors_[i]->coframe(point_part(x, i));
    result.block(tangent_offset_[i], point_offset_[i], C.rows(), C.cols()) = C;
  }
  return result;
}

ExprVector Product::do_constraint(const ExprVector& x) const {
  ExprVector result;
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    const ExprVector c = factors_[i]->constraint(point_part(x, i));
    result.conservativeResize(result.size() + c.size());
    result.tail(c.size()) = c;
  }
  return result;
}

double Product::do_point_defect(const VectorXd& x) const {
  double result = 0.0;
  for (std::size_t i = 0; i < factors_.size(); ++i)
    result = std::max(result, factors_[i]->point_defect(point_part(x, i)));
  return result;
}

double Product::do_separation(const VectorXd& x, const VectorXd& y) const {
  double result = 0.0;
  for (std::size_t i = 0; i < factors_.size(); ++i)
    result = std::hypot(result, factors_[i]->separation(point_part(x, i), point_part(y, i)));
  return result;
}

double Product::do_injectivity_radius(const VectorXd& x) const {
  double result = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < factors_.size(); ++i)
    result = std::min(result, factors_[i]->injectivity_radius(point_part(x, i)));
  return result;
}

Manifold::Extent Product::do_extent_at(const VectorXd& x) const {
  std::vector<Extent> extents;
  for (std::size_t i = 0; i < factors_.size(); ++i)
    extents.push_back(factors_[i]->extent_at(point_part(x, i)));
  return [this, extents](const VectorXd& v) {
    double result = 0.0;
    for (std::size_t i = 0; i < extents.size(); ++i)
      result = std::max(result, extents[i](tangent_part(v, i)));
    return result;
  };
}

VectorXd Product::do_project(const VectorXd& x) const {
  VectorXd result(x.size());
  for (std::size_t i = 0; i < factors_.size(); ++i)
    point_part(result, i) = factors_[i]->project(point_part(x, i));
  return result;
}

VectorXd Product::do_random_point(std::mt19937& generator) const {
  VectorXd result(ambient_dimension());
  for (std::size_t i = 0; i < factors_.size(); ++i)
    point_part(result, i) = factors_[i]->random_point(generator);
  return result;
}

Manifold::ScalingSymmetries Product::do_scaling_symmetries() const {
  ScalingSymmetries all;
  Index units = 0, fibre_units = 0;
  for (const auto& factor : factors_) {
    const ScalingSymmetries of = factor->scaling_symmetries();
    ScalingSymmetries::append(of.point, units, all.point);
    ScalingSymmetries::append(of.tangent, units, all.tangent);
    ScalingSymmetries::append(of.fibre, fibre_units, all.fibre);
    units = ScalingSymmetries::after(all.point);
    fibre_units = ScalingSymmetries::after(all.fibre);
  }
  return all;
}

}  // namespace courant
