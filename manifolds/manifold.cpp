#include "courant/manifolds/manifold.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "courant/core/derivative.hpp"

namespace courant {
namespace {

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
  return do_retract(x, v);
}

ExprVector Manifold::checked_inverse_retract(const ExprVector& x, const ExprVector& y) const {
  check_size("inverse_retract", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  check_size("inverse_retract", "y", y.size(), ambient_dimension_, "ambient_dimension()");
  return do_inverse_retract(x, y);
}

ExprMatrix Manifold::checked_frame(const ExprVector& x) const {
  check_size("frame", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  return do_frame(x);
}

ExprMatrix Manifold::checked_coframe(const ExprVector& x) const {
  check_size("coframe", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  return do_coframe(x);
}

ExprMatrix Manifold::checked_projector(const ExprVector& x) const {
  if (dimension_ == tangent_dimension_) return ExprMatrix::Identity(dimension_, dimension_);
  return checked_coframe(x) * checked_frame(x);
}

ExprVector Manifold::checked_constraint(const ExprVector& x) const {
  check_size("constraint", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  return do_constraint(x);
}

ExprVector Manifold::velocity_along(const ExprVector& x, const ExprVector& v, const Expr& s) const {
  check_size("velocity_along", "x", x.size(), ambient_dimension_, "ambient_dimension()");
  check_size("velocity_along", "v", v.size(), tangent_dimension_, "tangent_dimension()");
  return do_velocity_along(x, v, s);
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

MatrixXd Manifold::tangent_basis(const VectorXd& x) const {
  if (dimension_ == tangent_dimension_) return MatrixXd::Identity(dimension_, dimension_);
  const MatrixXd projector = tangent_projector(x);
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(projector);
  const MatrixXd basis = qr.householderQ() * MatrixXd::Identity(tangent_dimension_, dimension_);
  // Zeros that are round-off become zeros: what is computed in the basis would see dependences that
  // are not there.
  return (basis.array().abs() < 1e-15).select(0.0, basis);
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
  return do_project(x);
}

VectorXd Manifold::do_project(const VectorXd& start) const {
  VectorXd x = start;
  Graph graph;
  const ExprVector point = graph.variables("x", ambient_dimension_);
  const ExprVector c = constraint(point);
  if (c.size() == 0) return x;
  const ExprMatrix d_constraint = jacobian(c, point).dense();
  double previous = std::numeric_limits<double>::infinity();
  // Quadratic convergence: 50 iterations are far beyond what a point near M needs.
  for (int iteration = 0; iteration < 50; ++iteration) {
    const VectorXd defect = constraint(x);
    const double size = defect.lpNorm<Eigen::Infinity>();
    if (size == 0.0 || (size < 1e-12 * (1.0 + x.norm()) && size >= 0.5 * previous)) return x;
    previous = size;
    MatrixXd J(d_constraint.rows(), d_constraint.cols());
    for (Index j = 0; j < J.cols(); ++j)
      J.col(j) = values(substitute(d_constraint.col(j), point, constants(x)));
    x -= J.completeOrthogonalDecomposition().solve(defect);
  }
  throw std::domain_error(
      name_ + "::project: no point of the manifold found near x, constraint defect " +
      std::to_string(previous) + " after 50 iterations; expected 0. Start nearer to the manifold.");
}

VectorXd Manifold::random_point(std::mt19937& generator) const {
  return do_random_point(generator);
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
  const MatrixXd basis = tangent_basis(x);
  const ExprVector image = chart(constants(x), constants(basis), xi);
  const SparseExprMatrix d_image = jacobian(image, xi);
  VectorXd at = (coframe(x) * (y - x)).transpose() * basis;
  double previous = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 50; ++iteration) {
    const VectorXd defect = values(substitute(image, xi, constants(at))) - y;
    const double size = defect.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(size)) break;
    if (size == 0.0 || (size < 1e-11 * (1.0 + y.norm()) && size >= 0.5 * previous))
      return basis * at;
    previous = size;
    const VectorXd entries = values(substitute(d_image.values, xi, constants(at)));
    MatrixXd J = MatrixXd::Zero(d_image.rows, d_image.cols);
    for (std::size_t k = 0; k < d_image.row.size(); ++k)
      J(d_image.row[k], d_image.col[k]) = entries[static_cast<Index>(k)];
    at -= J.completeOrthogonalDecomposition().solve(defect);
  }
  throw std::domain_error(
      name_ + "::inverse_retract: y is not reached from x, least defect " +
      std::to_string(previous) +
      " after Newton's method; expected 0. Is y beyond the injectivity radius?");
}

}  // namespace courant
