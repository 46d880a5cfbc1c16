#include "courant/integrators/discretization_map.hpp"

#include <Eigen/Dense>
#include <stdexcept>

#include "courant/core/function.hpp"

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
  return do_forward(x, v);
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
  return has_inverse() ? do_inverse(x0, x1) : DiscretizationMap::do_inverse(x0, x1);
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
  return has_inverse() ? do_from_start(x0, w) : from_start_by_inverse(x0, w);
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
  check_size(name_ + "::inverse", "x0", x0.size(), manifold_->ambient_dimension());
  check_size(name_ + "::inverse", "x1", x1.size(), manifold_->ambient_dimension());
  // Newton's method on (ξ, η) ↦ R_d(R_{x₀}(B ξ), Π B η) - (x₀, x₁), from the tangent vector that
  // leads from x₀ to x₁.
  const Index n = manifold_->dimension();
  const MatrixXd basis = manifold_->tangent_basis(x0);
  Graph graph;
  const ExprVector unknown = graph.variables("y", 2 * n);
  const ExprVector x = manifold_->chart(constants(x0), constants(basis), unknown.head(n));
  const ExprVector v =
      manifold_->tangent_projector(x) * (constants(basis) * unknown.tail(n)).eval();
  const PointPair<Expr> image = forward(x, v);
  ExprVector outputs(2 * x0.size() + x.size() + v.size());
  outputs << image.first, image.second, x, v;
  const Function map("inverse", {{"y", unknown}}, outputs, {.differentiate = {"y"}});
  VectorXd target(2 * x0.size());
  target << x0, x1;

  VectorXd y = VectorXd::Zero(2 * n);
  y.tail(n) = basis.transpose() * (manifold_->coframe(x0) * (x1 - x0));
  y.head(n) = 0.5 * y.tail(n);
  double previous = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 50; ++iteration) {
    const VectorXd value = map({y});
    const VectorXd defect = value.head(target.size()) - target;
    const double size = defect.size() == 0 ? 0.0 : defect.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(size)) break;
    if (size == 0.0 || (size < 1e-11 * (1.0 + target.norm()) && size >= 0.5 * previous))
      return {value.segment(target.size(), x.size()), value.tail(v.size())};
    previous = size;
    y -= map.jacobian({y}).topRows(target.size()).completeOrthogonalDecomposition().solve(defect);
  }
  throw std::domain_error(
      name_ + "::inverse: no tangent vector is mapped to (x0, x1), least defect " +
      std::to_string(previous) +
      " after Newton's method; expected 0. The points are too far apart for this map.");
}

}  // namespace courant
