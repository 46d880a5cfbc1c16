#include "courant/integrators/certificate/least_deviation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/singular_value_decomposition.hpp"
#include "courant/core/linear/symmetric_eigenvalues.hpp"
#include "courant/integrators/certificate/damped_inverse.hpp"
#include "courant/integrators/certificate/saddle_point.hpp"

namespace courant {
namespace {

// The directions of the zeros at a point that r sees: d_i moves r by an orthonormal vector each.
struct Tangents {
  MatrixXd directions;   // d_i, columns
  VectorXd gradient;     // of ½ ‖r‖² along them
  VectorXd multipliers;  // λ with dr/dyᵀ r + Jᵀ λ = 0 across the zeros
};

class DeviationDescent {
 public:
  DeviationDescent(const LinearizableMap& map, const DeviationMap& deviation,
                   const Mobility& mobility, const Zero& at)
      : map_(map), deviation_(deviation), mobility_(mobility) {
    best_.zero = at;
  }

  LeastDeviation run() {
    constexpr int most_steps = 50;
    constexpr double least_slope = 1e-10;
    for (int k = 0; k < most_steps; ++k) {
      const Deviation goal = deviation_(best_.zero.y);
      best_.deviation = goal.value.norm();
      best_.slope = 0.0;
      if (best_.deviation <= kRoundOff * goal.size || goal.jacobian.nonZeros() == 0) break;
      const double before = slope_;
      const VectorXd delta = step(goal);
      best_.slope = slope_;
      if (!(slope_ > least_slope) || delta.size() == 0 || !delta.allFinite()) break;
      is_curved_ = is_curved_ || (k > 0 && slope_ > 0.1 * before);
      if (!move(goal, delta) || stalled_ == 4) break;
    }
    return best_;
  }

 private:
  // Near the minimum so much of ½ ‖r‖² is round-off: there the steps decide.
  static constexpr double kRounding = 1e-13;
  // Of the size of r, below which it is none.
  static constexpr double kRoundOff = 1e-15;

  // A whole step; empty if there is none. Sets slope_.
  VectorXd step(const Deviation& goal) {
    const Linearization here = map_(best_.zero.y);
    const NaturalScaling units = scaling(here);
    const SparseMatrixXd S =
        units.row_scale.asDiagonal() * here.jacobian * units.column_scale.asDiagonal();
    if (!S.coeffs().isFinite().all()) return VectorXd();
    units_ = units.column_scale;
    if (!is_factored_dense(S)) return sparse_step(goal, S, units);
    const Tangents along = tangents(goal, S, units);
    slope_ = along.gradient.norm() / best_.deviation;
    constexpr Index most_directions = 60;
    if (!is_curved_ || along.gradient.size() > most_directions || !(slope_ > 0.0)) {
      const VectorXd plain = -(along.directions * along.gradient);
      length_ = guessed_length(plain.cwiseQuotient(units.column_scale));
      return plain;
    }
    length_ = 1.0;
    return along.directions * newton(goal, along);
  }

  // Preconditioners of the solves, which the minimum does not depend on. At most a thousand times those of the start:
  // where momenta are of no degree in velocities, as w / |w| is, entries vanish on the way.
  NaturalScaling scaling(const Linearization& here) {
    constexpr double most_growth = 1e3, round_off = 1e-10;
    NaturalScaling units(here, best_.zero.nominal, NaturalScaling::kUsualNoise, round_off);
    if (largest_units_.size() == 0) largest_units_ = most_growth * units.column_scale;
    units.column_scale = units.column_scale.cwiseMin(largest_units_);
    return units;
  }

  Tangents tangents(const Deviation& goal, const SparseMatrixXd& S,
                    const NaturalScaling& units) const {
    constexpr double unseen = 1e-9;  // of what moves r most
    const Index n = goal.jacobian.cols();
    const CompleteOrthogonalDecomposition rows(MatrixXd(S.transpose()), DampedInverse::kNegligible);
    const MatrixXd Z = rows.Q().rightCols(S.cols() - rows.rank());
    const MatrixXd A = MatrixXd(goal.jacobian) * units.column_scale.head(n).asDiagonal();
    const SingularValueDecomposition svd = singular_value_decomposition(A * Z.topRows(n));
    Index seen = 0;
    while (seen < svd.values.size() && svd.values[seen] > unseen * A.norm()) ++seen;
    Tangents along;
    const MatrixXd moving =
        svd.V.leftCols(seen) * svd.values.head(seen).cwiseInverse().asDiagonal();
    along.directions = units.column_scale.asDiagonal() * (Z * moving);
    along.gradient = svd.U.leftCols(seen).transpose() * goal.value;
    VectorXd force = VectorXd::Zero(S.cols());
    force.head(n) = A.transpose() * goal.value;
    along.multipliers = -units.row_scale.cwiseProduct(VectorXd(rows.solve(force)));
    return along;
  }

  // In the directions of the zeros, where the plain second derivative is 1.
  VectorXd newton(const Deviation& goal, const Tangents& along) {
    constexpr double small = 1e-4, least_curvature = 0.1;
    const Index k = along.gradient.size();
    const auto gradient_at = [&](const VectorXd& y, const Deviation& r) {
      VectorXd g = map_(y).jacobian.transpose() * along.multipliers;
      g.head(r.jacobian.cols()) += r.jacobian.transpose() * r.value;
      return VectorXd(along.directions.transpose() * g);
    };
    const VectorXd here = gradient_at(best_.zero.y, goal);
    const double size = small * best_.deviation;
    MatrixXd H(k, k);
    for (Index i = 0; i < k; ++i) {
      const VectorXd y = best_.zero.y + size * along.directions.col(i);
      H.col(i) = (gradient_at(y, deviation_(y)) - here) / size;
    }
    if (!H.allFinite()) return -along.gradient;
    const auto [curvatures, Q] = symmetric_eigenvectors(0.5 * (H + H.transpose()));
    best_.curvature = curvatures[0];
    const VectorXd divisors = curvatures.cwiseAbs().cwiseMax(least_curvature);
    return -(Q * (Q.transpose() * along.gradient).cwiseQuotient(divisors));
  }

  // With a little inertia for what r does not see.
  VectorXd sparse_step(const Deviation& goal, const SparseMatrixXd& S,
                       const NaturalScaling& units) {
    constexpr double inertia = 1e-6, gamma = 1e-11;  // find_zero takes back what gamma gives way
    const Index n = goal.jacobian.cols(), size = S.cols();
    const SparseMatrixXd A = goal.jacobian * units.column_scale.head(n).asDiagonal();
    const SparseMatrixXd H = A.transpose() * A;
    const double strength = H.diagonal().maxCoeff();
    if (!(strength > 0.0)) return VectorXd();
    std::vector<Eigen::Triplet<double>> entries;
    for (Index j = 0; j < H.outerSize(); ++j)
      for (SparseMatrixXd::InnerIterator it(H, j); it; ++it)
        entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(j),
                             it.value() / strength);
    SparseMatrixXd P(size, size);
    P.setFromTriplets(entries.begin(), entries.end());
    P += sparse_diagonal(inertia * mobility_.cost.cwiseAbs2());
    VectorXd right = VectorXd::Zero(size);
    right.head(n) = -(A.transpose() * goal.value) / strength;
    const VectorXd delta = SaddlePoint(P, S, gamma).solve(right, VectorXd::Zero(S.rows()));
    if (delta.size() == 0) return delta;
    slope_ = std::sqrt(std::max(0.0, right.dot(delta) * strength)) / best_.deviation;
    length_ = guessed_length(delta);
    return units.column_scale.cwiseProduct(delta);
  }

  // Where constraints are curved whole steps go too far; two steps tell by how much
  // (Barzilai, Borwein 1988).
  double guessed_length(const VectorXd& delta) {
    double length = 1.0;
    if (before_.size() == delta.size()) {
      const double bend = before_.dot(before_ - delta);
      if (bend > 0.0) length = std::min(1.0, length_ * before_.squaredNorm() / bend);
    }
    before_ = delta;
    return length;
  }

  // To the first zero along the step that is no worse; whether there is one.
  bool move(const Deviation& goal, const VectorXd& whole) {
    const double value = goal.value.squaredNorm();
    const auto size = [&](const VectorXd& step) { return step.cwiseQuotient(units_).norm(); };
    // Unknowns that r does not see are not to leave the sizes that they have: velocities that may be as long as one likes.
    constexpr double most = 3.0;
    const double farthest = most * (size(best_.zero.nominal) + size(whole));
    for (double length = length_; length > 1e-3 * length_; length *= 0.5) {
      Zero next = find_zero(map_, best_.zero.y + length * whole, mobility_);
      if (!next.found || size(next.y - best_.zero.y) > farthest) continue;
      const double change = deviation_(next.y).value.squaredNorm() / value - 1.0;
      if (!(change <= kRounding)) continue;
      next.iterations += best_.zero.iterations;
      best_.zero = std::move(next);
      length_ = length;
      stalled_ = change > -kRounding ? stalled_ + 1 : 0;
      return true;
    }
    return false;
  }

  const LinearizableMap& map_;
  const DeviationMap& deviation_;
  const Mobility& mobility_;
  LeastDeviation best_;
  double slope_ = 0.0, length_ = 1.0;
  VectorXd before_;  // the whole step before this one, in units
  bool is_curved_ = false;
  int stalled_ = 0;
  VectorXd units_, largest_units_;
};

}  // namespace

LeastDeviation least_deviation(const LinearizableMap& map, const DeviationMap& deviation,
                               const Zero& at, const Mobility& mobility) {
  return DeviationDescent(map, deviation, mobility, at).run();
}

}  // namespace courant
