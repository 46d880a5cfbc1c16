#include "courant/integrators/certificate/least_zero.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "courant/core/linear/cholesky_decomposition.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/integrators/certificate/damped_inverse.hpp"
#include "courant/integrators/certificate/saddle_point.hpp"

namespace courant {
namespace {

// argmin ½ δᵀPδ - aᵀδ where S δ = 0, in an orthonormal basis of the kernel: rows of S that depend on each other,
// which leave a factorisation without exchanges no digits, do no harm. Empty where S is not finite.
VectorXd step_in_kernel(const SparseMatrixXd& P, const SparseMatrixXd& S, const VectorXd& a) {
  if (!S.coeffs().isFinite().all()) return VectorXd();
  const CompleteOrthogonalDecomposition rows(MatrixXd(S.transpose()), DampedInverse::kNegligible);
  const MatrixXd Z = rows.Q().rightCols(S.cols() - rows.rank());
  const MatrixXd reduced = Z.transpose() * (P * Z).eval();
  return Z * semidefinite_solution(reduced, Z.transpose() * a);
}

// Tangential Newton steps from zero to zero.
class Descent {
 public:
  using Objective = std::function<Quadratic(const VectorXd& y)>;

  Descent(const LinearizableMap& map, const Objective& objective, const Mobility& mobility,
          const Zero& at)
      : map_(map), objective_(objective), mobility_(mobility), best_(at) {}

  Zero run() {
    for (int iteration = 0; iteration < 50; ++iteration) {
      const Quadratic goal = objective_(best_.y);
      if (goal.value == 0.0) break;
      const Linearization here = map_(best_.y);
      const NaturalScaling scaling = units(here);
      const VectorXd& unit = scaling.column_scale;
      const VectorXd delta = step(goal, here, scaling);
      if (delta.size() == 0 || !delta.allFinite()) break;
      choose_length(delta, unit);
      const std::optional<double> change = move(goal, unit.cwiseProduct(delta));
      if (!change) break;
      const double size = delta.norm();
      stalled_ = *change > -kRounding && size > 0.5 * shortest_step_ ? stalled_ + 1 : 0;
      if (size < 1e-10 || stalled_ == 4) break;
      before_ = unit.cwiseProduct(delta);
      shortest_step_ = std::min(shortest_step_, size);
    }
    return best_;
  }

 private:
  // Near the minimum so much of the value is round-off, though y is known to 1e-5 only: there the steps decide.
  static constexpr double kRounding = 1e-10;

  // Units are at most a thousand times those of the start. Where momenta are of no degree in velocities, as
  // w / |w| is, entries vanish on the way to the nearest one, and units that follow them lead to velocities of 10¹⁷.
  NaturalScaling units(const Linearization& here) {
    constexpr double most_growth = 1e3;
    NaturalScaling scaling(here, best_.nominal);
    if (largest_units_.size() == 0) largest_units_ = most_growth * scaling.column_scale;
    scaling.column_scale = scaling.column_scale.cwiseMin(largest_units_);
    return scaling;
  }

  // The whole step, in units; empty if there is none.
  VectorXd step(const Quadratic& goal, const Linearization& here, const NaturalScaling& scaling) {
    constexpr double gamma =
        1e-11;  // constraints give way to the objective by this much in a step,
                // find_zero takes it back
    const SparseMatrixXd S =
        scaling.row_scale.asDiagonal() * here.jacobian * scaling.column_scale.asDiagonal();
    const Index n = goal.gradient.size();
    const VectorXd units = scaling.column_scale.head(n);
    const SparseMatrixXd H = units.asDiagonal() * goal.hessian * units.asDiagonal();
    const double strength = H.nonZeros() == 0 ? 0.0 : H.diagonal().maxCoeff();
    if (strength == 0.0) return VectorXd();
    VectorXd right = VectorXd::Zero(best_.y.size());
    right.head(n) = -units.cwiseProduct(goal.gradient) / strength;
    const SparseMatrixXd P = weights(H, strength);
    VectorXd delta = SaddlePoint(P, S, gamma).solve(right, VectorXd::Zero(S.rows()));
    // No step takes more from the objective than there is: one that promises to has lost its digits, and so
    // may the steps after it.
    const double most = 1.01 * 2.0 * goal.value / strength;
    const bool is_finite = delta.size() > 0 && delta.allFinite();
    loses_digits_ = loses_digits_ || (is_finite && right.dot(delta) > most);
    if (loses_digits_ && is_factored_dense(S)) delta = step_in_kernel(P, S, right);
    return delta;
  }

  // The objective, and a little inertia for what it does not see.
  SparseMatrixXd weights(const SparseMatrixXd& H, double strength) const {
    SparseMatrixXd P = sparse_diagonal(1e-6 * mobility_.cost.cwiseAbs2());
    SparseMatrixXd lifted(best_.y.size(), best_.y.size());
    std::vector<Eigen::Triplet<double>> entries;
    for (Index j = 0; j < H.outerSize(); ++j)
      for (SparseMatrixXd::InnerIterator it(H, j); it; ++it)
        entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(j),
                             it.value() / strength);
    lifted.setFromTriplets(entries.begin(), entries.end());
    P += lifted;
    return P;
  }

  // Where constraints are curved whole steps go too far; two steps tell by how much
  // (Barzilai, Borwein 1988).
  void choose_length(const VectorXd& delta, const VectorXd& unit) {
    if (before_.size() == 0) return;
    const VectorXd last = before_.cwiseQuotient(unit);
    const double bend = last.dot(last - delta);
    length_ = bend > 0.0 ? std::min(1.0, length_ * last.squaredNorm() / bend) : 1.0;
  }

  // To the first zero along the step that is no worse, with its change of the value next to that; none
  // where there is no such zero.
  std::optional<double> move(const Quadratic& goal, const VectorXd& whole) {
    for (; length_ > 1e-3; length_ *= 0.5) {
      const Zero next = find_zero(map_, best_.y + length_ * whole, mobility_);
      if (!next.found) continue;
      const double change = objective_(next.y).value / goal.value - 1.0;
      if (change > kRounding) continue;
      const int iterations = best_.iterations + next.iterations;
      best_ = next;
      best_.iterations = iterations;
      return change;
    }
    return std::nullopt;
  }

  const LinearizableMap& map_;
  const Objective& objective_;
  const Mobility& mobility_;
  Zero best_;
  double length_ = 1.0;
  VectorXd before_;  // the whole step before this one
  double shortest_step_ = std::numeric_limits<double>::infinity();
  int stalled_ = 0;
  bool loses_digits_ = false;
  VectorXd largest_units_;
};

}  // namespace

Zero least_zero(const LinearizableMap& map,
                const std::function<Quadratic(const VectorXd& y)>& objective, const Zero& at,
                const Mobility& mobility) {
  return Descent(map, objective, mobility, at).run();
}

}  // namespace courant
