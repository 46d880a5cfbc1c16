#include "courant/manifolds/vector_bundle.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/linear_algebra.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"

namespace courant {
namespace {

const Manifold& checked_base(const std::string& kind, const std::shared_ptr<const Manifold>& base) {
  if (!base)
    throw std::invalid_argument(kind + "::" + kind + ": base is null; expected a manifold.");
  return *base;
}

}  // namespace

VectorBundle::VectorBundle(const std::string& kind, std::shared_ptr<const Manifold> base)
    : Manifold(kind + "(" + checked_base(kind, base).name() + ")",
               2 * checked_base(kind, base).dimension(),
               checked_base(kind, base).ambient_dimension() +
                   checked_base(kind, base).tangent_dimension(),
               2 * checked_base(kind, base).tangent_dimension()),
      base_(std::move(base)) {}

ExprVector VectorBundle::do_retract(const ExprVector& x, const ExprVector& v) const {
  const ExprVector position_after = base_->retract(position(x), horizontal(v));
  const ExprVector fibre = fibre_part(x) + vertical(v);
  ExprVector y(ambient_dimension());
  y << position_after, fibre_projector(position_after) * fibre;
  return y;
}

ExprVector VectorBundle::do_inverse_retract(const ExprVector& x, const ExprVector& y) const {
  ExprVector transported = fibre_part(y);
  if (!is_trivialised()) {
    const ExprMatrix F = fibre_projector(position(x));
    const ExprMatrix F_after = fibre_projector(position(y));
    const ExprMatrix one = ExprMatrix::Identity(F.rows(), F.cols());
    const ExprMatrix normal = one - F;
    const ExprMatrix normal_after = one - F_after;
    transported = solve(F_after * F + normal_after * normal, transported);
  }
  ExprVector v(tangent_dimension());
  v << base_->inverse_retract(position(x), position(y)), transported - fibre_part(x);
  return v;
}

// v ↦ dF(x; E v) u, Ñ × Ñ.
ExprMatrix VectorBundle::fibre_motion(const ExprVector& x) const {
  const Index n = base_->tangent_dimension();
  Graph graph;
  const ExprVector point = graph.variables("x", ambient_dimension());
  const ExprVector at = position(point);
  const ExprVector projected = fibre_projector(at) * fibre_part(point);
  const ExprMatrix motion = jacobian(projected, at).dense() * base_->frame(at);
  return substitute(motion.reshaped(), point, x).reshaped(n, n);
}

ExprMatrix VectorBundle::do_frame(const ExprVector& x) const {
  const Index n = base_->tangent_dimension();
  ExprMatrix result = ExprMatrix::Zero(ambient_dimension(), tangent_dimension());
  result.topLeftCorner(base_->ambient_dimension(), n) = base_->frame(position(x)).matrix();
  result.bottomRightCorner(n, n) = fibre_projector(position(x)).matrix();
  if (!is_trivialised()) result.bottomLeftCorner(n, n) = fibre_motion(x);
  return result;
}

ExprMatrix VectorBundle::do_coframe(const ExprVector& x) const {
  const Index n = base_->tangent_dimension();
  ExprMatrix result = ExprMatrix::Zero(tangent_dimension(), ambient_dimension());
  result.topLeftCorner(n, base_->ambient_dimension()) = base_->coframe(position(x)).matrix();
  result.bottomRightCorner(n, n) = fibre_projector(position(x)).matrix();
  return result;
}

// Without F dF(x; v) u below the diagonal, which is zero where u = F u. A momentum of 10⁶ that is normal by rounding,
// or in a stage of a Runge–Kutta method, would make positions of momenta.
ExprMatrix VectorBundle::do_tangent_projector(const ExprVector& x) const {
  const Index n = base_->tangent_dimension();
  const ExprMatrix F = fibre_projector(position(x)).matrix();
  ExprMatrix result = ExprMatrix::Zero(2 * n, 2 * n);
  result.topLeftCorner(n, n) = base_->tangent_projector(position(x)).matrix();
  result.bottomRightCorner(n, n) = F * F;
  return result;
}

ExprVector VectorBundle::do_constraint(const ExprVector& x) const {
  ExprVector on_base = base_->constraint(position(x));
  if (is_trivialised()) return on_base;
  const ExprVector fibre = fibre_part(x);
  ExprVector result(on_base.size() + fibre.size());
  result << on_base, fibre - fibre_projector(position(x)) * fibre;
  return result;
}

double VectorBundle::do_point_defect(const VectorXd& x) const {
  const VectorXd normal = fibre_part(x) - fibre_part(projected(position(x), fibre_part(x)));
  return std::max(base_->point_defect(position(x)), normal.lpNorm<Eigen::Infinity>());
}

double VectorBundle::do_separation(const VectorXd& x, const VectorXd& y) const {
  return std::hypot(base_->separation(position(x), position(y)),
                    (fibre_part(x) - fibre_part(y)).norm());
}

double VectorBundle::turning_rate(const VectorXd& position) const {
  if (base_->dimension() == 0 || is_trivialised()) return 0.0;
  Graph graph;
  const ExprVector at = graph.variables("x", base_->ambient_dimension());
  const ExprMatrix turning =
      jacobian(fibre_projector(at).matrix().reshaped(), at).dense() * base_->frame(at);
  const MatrixXd rate = values(substitute(turning.reshaped(), at, constants(position)))
                            .reshaped(turning.rows(), turning.cols()) *
                        base_->tangent_basis(position);
  return singular_values(rate)[0];
}

double VectorBundle::do_injectivity_radius(const VectorXd& x) const {
  return std::min(base_->injectivity_radius(position(x)), 1.0 / turning_rate(position(x)));
}

Manifold::Extent VectorBundle::do_extent_at(const VectorXd& x) const {
  return [this, of_base = base_->extent_at(position(x)),
          rate = turning_rate(position(x))](const VectorXd& v) {
    const VectorXd along = horizontal(v);
    return std::max(of_base(along), rate * along.norm());
  };
}

VectorXd VectorBundle::projected(const VectorXd& position, const VectorXd& fibre) const {
  const VectorXd along = values(fibre_projector(constants(position))) * fibre;
  VectorXd result(ambient_dimension());
  result << position, along;
  return result;
}

VectorXd VectorBundle::do_project(const VectorXd& x) const {
  return projected(base_->project(position(x)), fibre_part(x));
}

VectorXd VectorBundle::do_random_point(std::mt19937& generator) const {
  std::normal_distribution<double> normal;
  const VectorXd position = base_->random_point(generator);
  return projected(position, VectorXd::NullaryExpr(base_->tangent_dimension(),
                                                   [&] { return normal(generator); }));
}

Manifold::ScalingSymmetries VectorBundle::do_scaling_symmetries() const {
  ScalingSymmetries all = base_->scaling_symmetries();
  const std::vector<Index> fibre = all.fibre;
  const Index units = ScalingSymmetries::after(all.point);
  ScalingSymmetries::append(fibre, units, all.point);
  ScalingSymmetries::append(fibre, units, all.tangent);
  ScalingSymmetries::append(fibre, ScalingSymmetries::after(fibre), all.fibre);
  return all;
}

}  // namespace courant
