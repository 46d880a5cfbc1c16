// Zeros of maps near a point, by Gauss–Newton.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace courant {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// When a zero counts as found, and when the search is given up.
struct GaussNewtonOptions {
  // A defect ‖F‖_∞ above this is no zero; below it the iteration goes on until the defect no longer
  // halves, that is to round-off.
  double accepted = 1e-11;
  // Quadratic convergence: far more than a start near a zero needs.
  int max_iterations = 50;
};

// Where the search ended.
struct GaussNewtonResult {
  bool converged = false;
  VectorXd y;           // the last iterate
  double defect = 0.0;  // ‖F(y)‖_∞, the last one that was finite
  int iterations = 0;
};

// y ← y - J(y)⁺ F(y) from `start`, with the pseudo-inverse of the Jacobian J (m × n) of F: Rⁿ →
// R^m, on the rank of CompleteOrthogonalDecomposition: the nearest zero to first order where there
// are many, redundant equations or not. Full steps only: for starts near a zero. (find_zero
// searches from far; Newton solves one system again and again.)
GaussNewtonResult gauss_newton(const std::function<VectorXd(const VectorXd& y)>& F,
                               const std::function<MatrixXd(const VectorXd& y)>& J,
                               const VectorXd& start, const GaussNewtonOptions& options = {});

}  // namespace courant
