#include "courant/integrators/certificate/nearby_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/solve/gauss_newton.hpp"

namespace courant {

NearbyPoints::NearbyPoints(const ExprVector& variables, const VectorXd& point, Index fixed,
                           const ExprVector& parameters, const VectorXd& of_parameters,
                           const std::vector<Expr>& constraints)
    : variables_(variables.size() + parameters.size()),
      moving_(variables.size() - fixed),
      changing_(variables.size()) {
  constexpr int trials = 3, most_steps = 12;
  constexpr double distance = 0.05;  // in sizes of the variables, or in ones
  constexpr double round_off = 1e-10;
  variables_ << variables, parameters;
  const ExprVector phi = Eigen::Map<const ExprVector>(constraints.data(), std::ssize(constraints));
  const ExprMatrix slopes = jacobian(phi, ExprVector(variables.head(moving_))).dense();
  const ExprVector entries = slopes.reshaped();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(-distance, distance);
  for (int trial = 0; trial < trials; ++trial) {
    VectorXd at(variables_.size());
    at << point, of_parameters;
    for (Index i = 0; i < changing_; ++i) at[i] += step(random) * std::max(1.0, std::abs(at[i]));
    const auto moved_to = [&](const VectorXd& moving) -> const VectorXd& {
      at.head(moving_) = moving;
      return at;
    };
    const auto J = [&](const VectorXd& moving) -> MatrixXd {
      return values(entries, moved_to(moving)).reshaped(slopes.rows(), slopes.cols());
    };
    const VectorXd start = at.head(moving_);
    const double terms = (J(start).cwiseAbs() * start.cwiseAbs().cwiseMax(1.0)).sum();
    const GaussNewtonResult zero =
        gauss_newton([&](const VectorXd& moving) { return values(phi, moved_to(moving)); }, J,
                     start, {.accepted = round_off * terms, .max_iterations = most_steps});
    if (zero.converged) points_.push_back(moved_to(zero.y));
  }
}

bool NearbyPoints::vanishes(const Expr& f) const {
  if (f.is_constant()) return f.value() == 0.0;
  const ExprVector slopes = gradient(f, ExprVector(variables_.head(changing_)));
  ExprVector all(1 + slopes.size());
  all << f, slopes;
  return !points_.empty() && std::ranges::all_of(points_, [&](const VectorXd& at) {
    const VectorXd numbers = values(all, at);
    const double change =
        numbers.tail(changing_).cwiseAbs().dot(at.head(changing_).cwiseAbs().cwiseMax(1.0));
    return std::abs(numbers[0]) <= 1e-9 * change;
  });
}

// NaN where one is no number.
VectorXd NearbyPoints::values(const ExprVector& functions, const VectorXd& at) const {
  return substitute(functions, variables_, constants(at)).unaryExpr([](const Expr& a) {
    return a.is_constant() ? a.value() : std::numeric_limits<double>::quiet_NaN();
  });
}

}  // namespace courant
