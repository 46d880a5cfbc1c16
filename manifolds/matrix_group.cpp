#include "courant/manifolds/matrix_group.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/words/message.hpp"

namespace courant {

MatrixGroup::MatrixGroup(const MatrixAlgebra& algebra)
    : MatrixGroup(algebra, exponential_map(algebra)) {}

MatrixGroup::MatrixGroup(MatrixAlgebra algebra, GroupMap map, Equations equations)
    : Manifold("MatrixGroup(" + algebra.name() + ", " + map.name + ")", algebra.dimension(),
               algebra.ambient_dimension(), algebra.dimension()),
      algebra_(std::move(algebra)),
      map_(std::move(map)),
      equations_(std::move(equations)) {
  const Index wanted = ambient_dimension() - dimension();
  if (!equations_) {
    if (const Index missing = algebra_.missing_equations(); missing > 0)
      throw std::domain_error(name() + ": of " + std::to_string(wanted) +
                              " equations of the group " + std::to_string(missing) +
                              (missing == 1 ? " is not found; expected it to be given."
                                            : " are not found; expected them to be given."));
    return;
  }
  std::mt19937 generator(1);
  for (int sample = 0; sample < 3; ++sample) {
    const VectorXd x = do_random_point(generator);
    Graph graph;
    const ExprVector at = graph.variables("x", ambient_dimension());
    const ExprVector c = do_constraint(at);
    const MatrixXd gradients =
        values(substitute(jacobian(c, at).dense().reshaped(), at, constants(x)))
            .reshaped(c.size(), ambient_dimension());
    const double defect = values(substitute(c, at, constants(x))).lpNorm<Eigen::Infinity>();
    const Index rank = CompleteOrthogonalDecomposition(gradients, 1e-9).rank();
    if (!(defect <= 1e-9 * (1.0 + x.squaredNorm())) || rank != wanted)
      throw std::domain_error(name() + ": the equations are off by " + number_text(defect) +
                              " at a point of the group, with " + std::to_string(rank) +
                              " independent gradients; expected 0, and " + std::to_string(wanted) +
                              " of them.");
  }
}

std::shared_ptr<const MatrixGroup> MatrixGroup::with(GroupMap map) const {
  return std::make_shared<MatrixGroup>(algebra_, std::move(map), equations_);
}

bool MatrixGroup::do_equals(const Manifold& other) const {
  const auto& group = static_cast<const MatrixGroup&>(other);
  return group.name() == name() && group.algebra_ == algebra_ && !group.equations_ && !equations_;
}

ExprVector MatrixGroup::do_retract(const ExprVector& x, const ExprVector& v) const {
  return algebra_.point(algebra_.matrix(x) * map_.map(v));
}

ExprVector MatrixGroup::do_inverse_retract(const ExprVector& x, const ExprVector& y) const {
  return map_.inverse(algebra_.inverse(algebra_.matrix(x)) * algebra_.matrix(y));
}

ExprVector MatrixGroup::do_source(const ExprVector& y, const ExprVector& v) const {
  return algebra_.point(algebra_.matrix(y) * map_.reciprocal(v));
}

std::optional<VectorXd> MatrixGroup::do_unit() const {
  return values(algebra_.point(ExprMatrix::Identity(algebra_.size(), algebra_.size())));
}

ExprVector MatrixGroup::do_velocity_along(const ExprVector& x, const ExprVector& v,
                                          const Expr& s) const {
  return map_.is_exponential ? v : differentiated_velocity(x, v, s);
}

ExprMatrix MatrixGroup::do_frame(const ExprVector& x) const {
  const ExprMatrix X = algebra_.matrix(x);
  ExprMatrix result(ambient_dimension(), dimension());
  for (Index a = 0; a < dimension(); ++a)
    result.col(a) = algebra_.velocity(X * algebra_.hat(ExprVector::Unit(dimension(), a)));
  return result;
}

ExprMatrix MatrixGroup::do_coframe(const ExprVector& x) const {
  const ExprMatrix inverse = algebra_.inverse(algebra_.matrix(x));
  const ExprVector origin = algebra_.matrix(ExprVector::Zero(ambient_dimension())).reshaped();
  ExprMatrix result(dimension(), ambient_dimension());
  for (Index i = 0; i < ambient_dimension(); ++i) {
    const ExprVector along =
        algebra_.matrix(ExprVector::Unit(ambient_dimension(), i)).reshaped() - origin;
    result.col(i) =
        algebra_.vee(inverse * ExprMatrix(along.reshaped(algebra_.size(), algebra_.size())));
  }
  return result;
}

ExprVector MatrixGroup::do_constraint(const ExprVector& x) const {
  const ExprVector found = algebra_.equations(x);
  return equations_ ? joined(found, equations_(x)) : found;
}

double MatrixGroup::do_point_defect(const VectorXd& x) const {
  const MatrixXd X = values(algebra_.matrix(constants(x)));
  if (!(LuDecomposition(X).determinant() > 0.0)) return std::numeric_limits<double>::infinity();
  const VectorXd c = constraint(x);
  return c.size() == 0 ? 0.0 : c.lpNorm<Eigen::Infinity>();
}

// Two factors, so that not all points are exponentials.
VectorXd MatrixGroup::do_random_point(std::mt19937& generator) const {
  std::normal_distribution<double> normal;
  const double length = 1.0 / (1.0 + algebra_.spectral_bounds().real);
  ExprMatrix X = ExprMatrix::Identity(algebra_.size(), algebra_.size());
  const GroupMap exponential = exponential_map(algebra_);
  for (int factor = 0; factor < 2; ++factor) {
    const VectorXd v =
        VectorXd::NullaryExpr(dimension(), [&] { return length * normal(generator); });
    X = (X * exponential.map(constants(v))).eval();
  }
  return values(algebra_.point(X));
}

}  // namespace courant
