#include "courant/manifolds/implicit_submanifold.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/linear_algebra.hpp"
#include "courant/core/linear/cholesky_decomposition.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"

namespace courant {
namespace {

constexpr int kNewtonSteps = 6;
constexpr int kRandomStarts = 100;

const Manifold& checked_ambient(const std::string& name, const std::shared_ptr<const Manifold>& M) {
  if (!M)
    throw std::invalid_argument(name + "::ImplicitSubmanifold: M is null; expected a manifold.");
  return *M;
}

}  // namespace

ImplicitSubmanifold::ImplicitSubmanifold(const std::string& name, std::shared_ptr<const Manifold> M,
                                         Equations equations, Index count)
    : Manifold(name, checked_ambient(name, M).dimension() - count,
               checked_ambient(name, M).ambient_dimension(),
               checked_ambient(name, M).tangent_dimension()),
      surrounding_(std::move(M)),
      equations_(std::move(equations)),
      count_(count) {
  Graph graph;
  const Index size = equations_(graph.variables("x", ambient_dimension())).size();
  if (size != count)
    throw std::invalid_argument(name + "::ImplicitSubmanifold: equations give " +
                                std::to_string(size) +
                                " entries, expected count = " + std::to_string(count) + ".");
}

ImplicitSubmanifold::Normal ImplicitSubmanifold::normal(const ExprVector& x) const {
  Graph graph;
  const ExprVector at = graph.variables("x", ambient_dimension());
  const ExprMatrix A_at = jacobian(equations_(at), at).dense() * surrounding_->frame(at);
  const ExprMatrix A = substitute(A_at.reshaped(), at, x).reshaped(count_, tangent_dimension());
  return {A, surrounding_->tangent_projector(x) * A.transpose()};
}

ExprMatrix ImplicitSubmanifold::projector(const ExprVector& x) const {
  const auto [A, W] = normal(x);
  const ExprMatrix coefficients = solve(A * W, A);
  return surrounding_->tangent_projector(x).matrix() - W * coefficients;
}

ExprVector ImplicitSubmanifold::projection(const ExprVector& y) const {
  if (y.size() != ambient_dimension())
    throw std::invalid_argument(name() + "::projection: y has " + std::to_string(y.size()) +
                                " entries, expected " + std::to_string(ambient_dimension()) + ".");
  Graph graph;
  const ExprVector at = graph.variables("y", ambient_dimension());
  const auto [A, W] = normal(at);
  const ExprVector lambda = solve(A * W, equations_(at));
  const ExprVector improved = surrounding_->retract(at, ExprVector(-(W * lambda)));
  ExprVector result = y;
  for (int step = 0; step < kNewtonSteps; ++step) result = substitute(improved, at, result);
  return result;
}

ExprVector ImplicitSubmanifold::do_retract(const ExprVector& x, const ExprVector& v) const {
  Graph graph;
  const ExprVector at = graph.variables("x", ambient_dimension());
  const ExprVector velocity = graph.variables("v", tangent_dimension());
  const ExprVector lambda = graph.variables("lambda", count_);
  const ExprVector reached = surrounding_->retract(at, velocity + normal(at).W * lambda);
  const ExprVector defect = equations_(reached);
  const ExprVector improved = lambda - solve(jacobian(defect, lambda).dense(), defect);
  const ExprVector from = joined(at, velocity, lambda);
  ExprVector solution = ExprVector::Zero(count_);
  for (int step = 0; step < kNewtonSteps; ++step)
    solution = substitute(improved, from, joined(x, v, solution));
  return substitute(reached, from, joined(x, v, solution));
}

ExprVector ImplicitSubmanifold::do_inverse_retract(const ExprVector& x, const ExprVector& y) const {
  return projector(x) * surrounding_->inverse_retract(x, y);
}

ExprMatrix ImplicitSubmanifold::do_frame(const ExprVector& x) const {
  return surrounding_->frame(x) * projector(x);
}

ExprMatrix ImplicitSubmanifold::do_coframe(const ExprVector& x) const {
  return projector(x) * surrounding_->coframe(x);
}

ExprVector ImplicitSubmanifold::do_constraint(const ExprVector& x) const {
  return joined(surrounding_->constraint(x), equations_(x));
}

double ImplicitSubmanifold::do_point_defect(const VectorXd& x) const {
  return std::max(surrounding_->point_defect(x),
                  values(equations_(constants(x))).lpNorm<Eigen::Infinity>());
}

double ImplicitSubmanifold::do_separation(const VectorXd& x, const VectorXd& y) const {
  return surrounding_->separation(x, y);
}

double ImplicitSubmanifold::do_injectivity_radius(const VectorXd& x) const {
  const double surrounding_radius = 0.5 * surrounding_->injectivity_radius(x);
  if (dimension() == 0) return surrounding_radius;
  // Second fundamental form of S at x: second derivatives of c along the chart of M, measured in an
  // orthonormal basis of the normal space.
  Graph graph;
  const ExprVector xi = graph.variables("xi", dimension());
  const ExprVector along =
      equations_(surrounding_->chart(constants(x), constants(tangent_basis(x)), xi));
  const auto [A, W] = normal(constants(x));
  const CholeskyDecomposition metric(values(A * W));
  const ExprVector scaled =
      constants(metric.solve_lower(MatrixXd::Identity(A.rows(), A.rows()))) * along;
  double square = 0.0;
  for (const Expr& component : scaled) {
    const ExprMatrix hessian = jacobian(gradient(component, xi), xi).dense();
    const MatrixXd at_zero =
        values(substitute(hessian.reshaped(), xi, ExprVector::Zero(dimension())))
            .reshaped(dimension(), dimension());
    square += std::pow(singular_values(at_zero)[0], 2);
  }
  return std::min(surrounding_radius, 0.5 / std::sqrt(square));
}

VectorXd ImplicitSubmanifold::do_random_point(std::mt19937& generator) const {
  for (int start = 1; start < kRandomStarts; ++start) {
    try {
      return project(surrounding_->random_point(generator));
    } catch (const std::domain_error&) {  // a start from which Gauss–Newton does not converge
    }
  }
  return project(surrounding_->random_point(generator));
}

}  // namespace courant
