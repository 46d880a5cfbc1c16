#include "courant/manifolds/manifold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <stdexcept>
#include <typeinfo>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/solve/gauss_newton.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

// What an overridden function returned, if it has the size that the class promises.
template <class Matrix>
Matrix with_size(Matrix result, const std::string& name, const char* function, Index rows,
                 Index columns) {
  if (result.rows() != rows || result.cols() != columns)
    throw std::invalid_argument(name + "::do_" + function + ": the result is " +
                                size_text(result.rows(), result.cols()) + ", expected " +
                                size_text(rows, columns) + ".");
  return result;
}

// Whether all components of tangent vectors are velocities, or none; no value where E has to be measured. That is a matrix
// of N² entries: of points of many numbers it is not made.
std::optional<bool> has_velocities_without_measuring(const Manifold& M) {
  constexpr Index most_measured = 200;
  if (M.ambient_dimension() != M.tangent_dimension()) return false;
  if (M.has_identity_frame() || M.ambient_dimension() > most_measured) return true;
  return std::nullopt;
}

VectorXd normal_vector(Index size, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return VectorXd::NullaryExpr(size, [&] { return normal(generator); });
}

}  // namespace

Manifold::Manifold(std::string name, Index dimension, Index ambient_dimension,
                   Index tangent_dimension)
    : name_(std::move(name)),
      dimension_(dimension),
      ambient_dimension_(ambient_dimension),
      tangent_dimension_(tangent_dimension) {
  if (dimension < 0 || dimension > ambient_dimension || dimension > tangent_dimension)
    throw std::invalid_argument(name_ + "::Manifold: dimension is " + std::to_string(dimension) +
                                "; expected between 0 and the ambient and tangent dimensions " +
                                std::to_string(ambient_dimension) + " and " +
                                std::to_string(tangent_dimension) + ".");
}

bool Manifold::operator==(const Manifold& other) const {
  return this == &other || (typeid(*this) == typeid(other) && do_equals(other));
}

void Manifold::check_size(const char* function, const char* argument, Index size, Index expected,
                          const char* meaning) const {
  if (size != expected)
    throw std::invalid_argument(name_ + "::" + function + ": " + argument + " has " +
                                std::to_string(size) + " entries, expected " + meaning + " = " +
                                std::to_string(expected) + ".");
}

ExprVector Manifold::checked_retract(const ExprVector& x, const ExprVector& v) const {
  check_size("retract", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  check_size("retract", "v", v.size(), tangent_dimension_, "tangent_dimension()");
  return with_size(do_retract(x, v), name_, "retract", ambient_dimension_, 1);
}

ExprVector Manifold::checked_inverse_retract(const ExprVector& x, const ExprVector& y) const {
  check_size("inverse_retract", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  check_size("inverse_retract", "y", y.size(), ambient_dimension_, "ambient_dimension()");
  return with_size(do_inverse_retract(x, y), name_, "inverse_retract", tangent_dimension_, 1);
}

ExprVector Manifold::checked_source(const ExprVector& y, const ExprVector& v) const {
  check_size("source", "y", y.size(), ambient_dimension_, "ambient_dimension()");
  check_size("source", "v", v.size(), tangent_dimension_, "tangent_dimension()");
  return with_size(do_source(y, v), name_, "source", ambient_dimension_, 1);
}

ExprVector Manifold::do_source(const ExprVector&, const ExprVector&) const {
  throw std::logic_error(name_ +
                         "::source: no formula is known. Use it where has_source() is true.");
}

LinearMap<Expr> Manifold::checked_frame(const ExprVector& x) const {
  check_size("frame", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  if (has_identity_frame()) return LinearMap<Expr>::identity(dimension_);
  return with_size(do_frame(x), name_, "frame", ambient_dimension_, tangent_dimension_);
}

LinearMap<Expr> Manifold::checked_coframe(const ExprVector& x) const {
  check_size("coframe", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  if (has_identity_frame()) return LinearMap<Expr>::identity(dimension_);
  return with_size(do_coframe(x), name_, "coframe", tangent_dimension_, ambient_dimension_);
}

LinearMap<Expr> Manifold::checked_projector(const ExprVector& x) const {
  if (dimension_ == tangent_dimension_) return LinearMap<Expr>::identity(dimension_);
  check_size("tangent_projector", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  return with_size(do_tangent_projector(x), name_, "tangent_projector", tangent_dimension_,
                   tangent_dimension_);
}

ExprMatrix Manifold::do_tangent_projector(const ExprVector& x) const {
  return (checked_coframe(x) * checked_frame(x)).matrix();
}

ExprVector Manifold::checked_constraint(const ExprVector& x) const {
  check_size("constraint", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  return do_constraint(x);
}

ExprVector Manifold::velocity_along(const ExprVector& x, const ExprVector& v, const Expr& s) const {
  check_size("velocity_along", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  check_size("velocity_along", "v", v.size(), tangent_dimension_, "tangent_dimension()");
  return with_size(do_velocity_along(x, v, s), name_, "velocity_along", tangent_dimension_, 1);
}

ExprVector Manifold::differentiated_velocity(const ExprVector& x, const ExprVector& v,
                                             const Expr& s) const {
  Graph graph;
  ExprVector from(ambient_dimension_ + tangent_dimension_ + 1), to(from.size());
  from << graph.variables("x", ambient_dimension_), graph.variables("v", tangent_dimension_),
      graph.variable("s");
  to << x, v, s;
  const ExprVector length = from.tail(1);
  const ExprVector curve =
      retract(from.head(ambient_dimension_),
              ExprVector(length[0] * from.segment(ambient_dimension_, tangent_dimension_)));
  return substitute(ExprVector(coframe(curve) * tangent(curve, length, ExprVector::Ones(1))), from,
                    to);
}

ExprVector Manifold::do_inverse_retract(const ExprVector&, const ExprVector&) const {
  throw std::logic_error(
      name_ +
      "::inverse_retract: this retraction has no closed inverse. Pass numbers, or use a "
      "formulation that needs the retraction only.");
}

ExprVector Manifold::do_constraint(const ExprVector&) const {
  if (dimension_ != ambient_dimension_)
    throw std::logic_error(name_ +
                           "::constraint: not supplied, though dimension() < ambient_dimension(). "
                           "Override do_constraint.");
  return ExprVector(0);
}

LinearMap<double> Manifold::tangent_basis(const VectorXd& x) const {
  if (dimension_ == tangent_dimension_) return LinearMap<double>::identity(dimension_);
  const MatrixXd projector = tangent_projector(x);
  const MatrixXd basis = QrDecomposition::pivoted(projector).Q(dimension_);
  // Zeros that are round-off become zeros: what is computed in the basis would see dependences that
  // are not there.
  return MatrixXd((basis.array().abs() < 1e-15).select(0.0, basis));
}

Index Manifold::ScalingSymmetries::after(const std::vector<Index>& units) {
  return units.empty() ? 0 : *std::ranges::max_element(units) + 1;
}

void Manifold::ScalingSymmetries::append(const std::vector<Index>& units, Index first,
                                         std::vector<Index>& all) {
  for (const Index unit : units) all.push_back(unit == none ? none : first + unit);
}

Manifold::ScalingSymmetries Manifold::scaling_symmetries() const {
  ScalingSymmetries all = do_scaling_symmetries();
  check_size("scaling_symmetries", "point", std::ssize(all.point), ambient_dimension_,
             "ambient_dimension()");
  check_size("scaling_symmetries", "tangent", std::ssize(all.tangent), tangent_dimension_,
             "tangent_dimension()");
  check_size("scaling_symmetries", "fibre", std::ssize(all.fibre), tangent_dimension_,
             "tangent_dimension()");
  return all;
}

Manifold::ScalingSymmetries Manifold::do_scaling_symmetries() const {
  const auto points = static_cast<std::size_t>(ambient_dimension_);
  const auto vectors = static_cast<std::size_t>(tangent_dimension_);
  return {.point = std::vector<Index>(points, ScalingSymmetries::none),
          .tangent = std::vector<Index>(vectors, ScalingSymmetries::none),
          .fibre = std::vector<Index>(vectors, 0)};
}

// At a random point nothing that is mixed elsewhere is apart.
std::vector<Index> Manifold::mixed_components() const {
  std::vector<Index> first(static_cast<std::size_t>(tangent_dimension_));
  std::iota(first.begin(), first.end(), Index{0});
  if (dimension_ == tangent_dimension_) return first;
  std::mt19937 generator(1);
  const MatrixXd projector = tangent_projector(random_point(generator));
  for (Index i = 0; i < projector.rows(); ++i)
    for (Index j = 0; j < i; ++j) {
      if (std::abs(projector(i, j)) < 1e-12) continue;
      const Index a = first[static_cast<std::size_t>(i)], b = first[static_cast<std::size_t>(j)];
      std::ranges::replace(first, std::max(a, b), std::min(a, b));
    }
  return first;
}

double Manifold::point_defect(const VectorXd& x) const {
  check_size("point_defect", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  return do_point_defect(x);
}

double Manifold::do_point_defect(const VectorXd& x) const {
  const VectorXd c = constraint(x);
  return c.size() == 0 ? 0.0 : c.lpNorm<Eigen::Infinity>();
}

double Manifold::tangent_defect(const VectorXd& x, const VectorXd& v) const {
  check_size("tangent_defect", "v", v.size(), tangent_dimension_, "tangent_dimension()");
  return v.size() == 0 ? 0.0 : (v - tangent_projector(x) * v).lpNorm<Eigen::Infinity>();
}

double Manifold::separation(const VectorXd& x, const VectorXd& y) const {
  check_size("separation", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  check_size("separation", "y", y.size(), ambient_dimension_, "ambient_dimension()");
  return do_separation(x, y);
}

double Manifold::do_separation(const VectorXd& x, const VectorXd& y) const {
  return (x - y).norm();
}

double Manifold::injectivity_radius(const VectorXd& x) const {
  check_size("injectivity_radius", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  return do_injectivity_radius(x);
}

double Manifold::do_injectivity_radius(const VectorXd&) const {
  return std::numeric_limits<double>::infinity();
}

Manifold::Extent Manifold::extent_at(const VectorXd& x) const {
  check_size("extent_at", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  return do_extent_at(x);
}

Manifold::Extent Manifold::do_extent_at(const VectorXd& x) const {
  return [radius = injectivity_radius(x)](const VectorXd& v) { return v.norm() / radius; };
}

VectorXd Manifold::project(const VectorXd& x) const {
  check_size("project", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  return with_size(do_project(x), name_, "project", ambient_dimension_, 1);
}

VectorXd Manifold::do_project(const VectorXd& start) const {
  Graph graph;
  const ExprVector point = graph.variables("x", ambient_dimension_);
  const ExprVector c = constraint(point);
  if (c.size() == 0) return start;
  const ExprMatrix d_constraint = jacobian(c, point).dense();
  const auto d_constraint_at = [&](const VectorXd& x) {
    MatrixXd J(d_constraint.rows(), d_constraint.cols());
    for (Index j = 0; j < J.cols(); ++j)
      J.col(j) = values(substitute(d_constraint.col(j), point, constants(x)));
    return J;
  };
  const GaussNewtonResult zero =
      gauss_newton([&](const VectorXd& x) { return constraint(x); }, d_constraint_at, start,
                   {.accepted = 1e-12 * (1.0 + start.norm())});
  if (zero.converged) return zero.y;
  throw std::domain_error(name_ + "::project: no point of the manifold found near x, constraint " +
                          "defect " + number_text(zero.defect) + " after " +
                          std::to_string(zero.iterations) +
                          " iterations; expected 0. Start nearer to the manifold.");
}

VectorXd Manifold::random_point(std::mt19937& generator) const {
  return with_size(do_random_point(generator), name_, "random_point", ambient_dimension_, 1);
}

bool Manifold::has_velocities_as_vectors() const {
  if (const auto known = has_velocities_without_measuring(*this)) return *known;
  std::mt19937 generator(1);
  return velocities_among_components(random_point(generator)).all();
}

Eigen::Array<bool, Eigen::Dynamic, 1> Manifold::velocities_among_components(
    const VectorXd& x) const {
  constexpr double round_off = 1e-9;
  using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;
  if (const auto known = has_velocities_without_measuring(*this))
    return Flags::Constant(tangent_dimension_, *known);
  const MatrixXd projector = tangent_projector(x);
  const MatrixXd turned = (frame(x) * projector) - projector;
  return turned.rowwise().lpNorm<Eigen::Infinity>().array() <= round_off;
}

VectorXd Manifold::do_random_point(std::mt19937& generator) const {
  return project(normal_vector(ambient_dimension_, generator));
}

VectorXd Manifold::random_tangent(const VectorXd& x, double length, std::mt19937& generator) const {
  if (dimension_ == 0) return VectorXd::Zero(tangent_dimension_);
  return length * (tangent_basis(x) * normal_vector(dimension_, generator).normalized());
}

VectorXd Manifold::newton_inverse(const VectorXd& x, const VectorXd& y) const {
  check_size("inverse_retract", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  check_size("inverse_retract", "y", y.size(), ambient_dimension_, "ambient_dimension()");
  Graph graph;
  const ExprVector xi = graph.variables("xi", dimension_);
  const LinearMap<double> basis = tangent_basis(x);
  const ExprVector image = chart(constants(x), constants(basis), xi);
  const SparseExprMatrix d_image = jacobian(image, xi);
  const auto d_image_at = [&](const VectorXd& at) {
    const VectorXd entries = values(substitute(d_image.values, xi, constants(at)));
    MatrixXd J = MatrixXd::Zero(d_image.rows, d_image.cols);
    for (std::size_t k = 0; k < d_image.row.size(); ++k)
      J(d_image.row[k], d_image.col[k]) = entries[static_cast<Index>(k)];
    return J;
  };
  const GaussNewtonResult zero = gauss_newton(
      [&](const VectorXd& at) {
        return VectorXd(values(substitute(image, xi, constants(at))) - y);
      },
      d_image_at, basis.transpose() * (coframe(x) * (y - x)),
      {.accepted = 1e-11 * (1.0 + y.norm())});
  if (zero.converged) return basis * zero.y;
  throw std::domain_error(
      name_ + "::inverse_retract: y is not reached from x, defect " + number_text(zero.defect) +
      " after Newton's method; expected 0. Is y beyond the injectivity radius?");
}

}  // namespace courant
