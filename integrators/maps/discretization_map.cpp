#include "courant/integrators/maps/discretization_map.hpp"

#include <stdexcept>

#include "courant/integrators/maps/inversion.hpp"

namespace courant {
namespace {

void check_size(const std::string& place, const char* argument, Index size, Index expected) {
  if (size != expected)
    throw std::invalid_argument(place + ": " + argument + " has " + std::to_string(size) +
                                " entries, expected " + std::to_string(expected) + ".");
}

}  // namespace

DiscretizationMap::DiscretizationMap(std::string name, std::shared_ptr<const Manifold> manifold)
    : name_(std::move(name)), manifold_(std::move(manifold)) {
  if (!manifold_) throw std::invalid_argument(name_ + "::DiscretizationMap: manifold is null.");
}

DiscretizationMap::PointPair<Expr> DiscretizationMap::checked_forward(const ExprVector& x,
                                                                      const ExprVector& v) const {
  check_size(name_ + "::forward", "x", x.size(), manifold_->ambient_dimension());
  check_size(name_ + "::forward", "v", v.size(), manifold_->tangent_dimension());
  PointPair<Expr> result = do_forward(x, v);
  check_size(name_ + "::do_forward", "the first point", result.first.size(), x.size());
  check_size(name_ + "::do_forward", "the second point", result.second.size(), x.size());
  return result;
}

DiscretizationMap::PointPair<double> DiscretizationMap::numeric_forward(const VectorXd& x,
                                                                        const VectorXd& v) const {
  const PointPair<Expr> result = forward(constants(x), constants(v));
  return {values(result.first), values(result.second)};
}

DiscretizationMap::TangentVector<Expr> DiscretizationMap::checked_inverse(
    const ExprVector& x0, const ExprVector& x1) const {
  check_size(name_ + "::inverse", "x0", x0.size(), manifold_->ambient_dimension());
  check_size(name_ + "::inverse", "x1", x1.size(), manifold_->ambient_dimension());
  TangentVector<Expr> result =
      has_inverse() ? do_inverse(x0, x1) : DiscretizationMap::do_inverse(x0, x1);
  check_size(name_ + "::do_inverse", "x", result.x.size(), x0.size());
  check_size(name_ + "::do_inverse", "v", result.v.size(), manifold_->tangent_dimension());
  return result;
}

DiscretizationMap::TangentVector<Expr> DiscretizationMap::do_inverse(const ExprVector&,
                                                                     const ExprVector&) const {
  throw std::logic_error(
      name_ +
      "::inverse: this map has no closed inverse. Pass numbers, or use the forward formulation.");
}

DiscretizationMap::Displacement DiscretizationMap::from_start(const ExprVector& x0,
                                                              const ExprVector& w) const {
  check_size(name_ + "::from_start", "x0", x0.size(), manifold_->ambient_dimension());
  check_size(name_ + "::from_start", "w", w.size(), manifold_->tangent_dimension());
  Displacement result = has_start() ? do_from_start(x0, w) : from_start_by_inverse(x0, w);
  check_size(name_ + "::do_from_start", "x", result.x.size(), x0.size());
  check_size(name_ + "::do_from_start", "v", result.v.size(), w.size());
  check_size(name_ + "::do_from_start", "the end", result.end.size(), x0.size());
  return result;
}

DiscretizationMap::Displacement DiscretizationMap::from_start_by_inverse(
    const ExprVector& x0, const ExprVector& w) const {
  const ExprVector end = manifold_->retract(x0, w);
  auto [x, v] = inverse(x0, end);
  return {std::move(x), std::move(v), end};
}

DiscretizationMap::TangentVector<double> DiscretizationMap::numeric_inverse(
    const VectorXd& x0, const VectorXd& x1) const {
  if (has_inverse()) {
    const TangentVector<Expr> result = inverse(constants(x0), constants(x1));
    return {values(result.x), values(result.v)};
  }
  const auto [x, v] = Inversion(*this)(x0, x1);
  return {x, v};
}

}  // namespace courant
