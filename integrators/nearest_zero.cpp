#include "courant/integrators/nearest_zero.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "courant/integrators/natural_scaling.hpp"

namespace courant {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// The solution of [P Sᵀ; S -γ] (δ, y) = (a, b), with P ⪰ 0 diagonally strengthened to be definite:
// quasi-definite, so that LDLᵀ exists for every ordering. Entries far below those of S cost digits,
// which two steps of refinement bring back.
class SaddlePoint {
 public:
  SaddlePoint(const SparseMatrixXd& P, const SparseMatrixXd& S, double gamma) {
    const Index n = S.cols(), m = S.rows();
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(P.nonZeros() + 2 * S.nonZeros() + m));
    for (Index j = 0; j < P.outerSize(); ++j)
      for (SparseMatrixXd::InnerIterator it(P, j); it; ++it)
        entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(j), it.value());
    for (Index j = 0; j < S.outerSize(); ++j)
      for (SparseMatrixXd::InnerIterator it(S, j); it; ++it) {
        entries.emplace_back(static_cast<int>(n + it.row()), static_cast<int>(j), it.value());
        entries.emplace_back(static_cast<int>(j), static_cast<int>(n + it.row()), it.value());
      }
    for (Index i = 0; i < m; ++i)
      entries.emplace_back(static_cast<int>(n + i), static_cast<int>(n + i), -gamma);
    matrix_.resize(n + m, n + m);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    factors_.compute(matrix_);
  }

  // δ; empty if the factorisation broke down.
  VectorXd solve(const VectorXd& a, const VectorXd& b) const {
    if (factors_.info() != Eigen::Success) return VectorXd();
    VectorXd right(a.size() + b.size());
    right << a, b;
    VectorXd solution = factors_.solve(right);
    for (int refinement = 0; refinement < 2; ++refinement)
      solution += factors_.solve(right - matrix_ * solution);
    return solution.head(a.size());
  }

 private:
  SparseMatrixXd matrix_;
  Eigen::SimplicialLDLT<SparseMatrixXd, Eigen::Lower> factors_;
};

SparseMatrixXd diagonal(const VectorXd& d) {
  SparseMatrixXd matrix(d.size(), d.size());
  matrix.setIdentity();
  return d.asDiagonal() * matrix;
}

// argmin ‖S δ + g‖² + μ ‖cost ∘ δ‖²
VectorXd damped_step(const SparseMatrixXd& S, const VectorXd& g, const VectorXd& cost, double mu) {
  const double root = std::sqrt(mu);
  return SaddlePoint(diagonal(root * cost.cwiseAbs2()), S, root)
      .solve(VectorXd::Zero(S.cols()), -g);
}

bool finite(const Linearization& at) {
  if (!at.value.allFinite()) return false;
  for (Index j = 0; j < at.jacobian.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(at.jacobian, j); it; ++it)
      if (!std::isfinite(it.value())) return false;
  return true;
}

}  // namespace

Zero find_zero(const LinearizableMap& map, const VectorXd& start, const Mobility& mobility) {
  constexpr double least_damping = 1e-10, most_damping = 1e8, accepted = 1e-10;
  Zero zero;
  zero.y = start;
  zero.reach = start.cwiseAbs().cwiseMax(mobility.typical);
  zero.defect = std::numeric_limits<double>::infinity();
  Linearization at = map(start);
  if (!finite(at)) return zero;

  double damping = least_damping;
  bool moves = true;
  while (moves) {
    const NaturalScaling units(at, zero.reach);
    const VectorXd g = units.row_scale.cwiseProduct(at.value);
    zero.scaled_value = g;
    zero.defect = units.defect(at.value, zero.reach);
    zero.found = zero.defect <= accepted;
    zero.history.push_back(zero.defect);
    zero.uncertainty = zero.defect;
    if (zero.defect <= eps || zero.iterations == 100) break;

    SparseMatrixXd S = units.scaled;
    S.prune([&](Index, Index column, double) { return column >= mobility.frozen; });
    moves = false;
    // At the level of rounding a step that does not help is the end; far from it, too long.
    for (double mu = damping; !moves && mu <= (zero.found ? damping : most_damping); mu *= 100.0) {
      const VectorXd delta = damped_step(S, g, mobility.cost, mu);
      if (delta.size() == 0 || !delta.allFinite()) continue;
      if (mu == least_damping) {
        zero.uncertainty = delta.lpNorm<Eigen::Infinity>();
        const bool stationary = (S * delta + g).squaredNorm() > (1.0 - 1e-6) * g.squaredNorm();
        if (stationary) break;
      }
      const VectorXd y = zero.y + units.column_scale.cwiseProduct(delta);
      Linearization next = map(y);
      if (!finite(next) ||
          units.row_scale.cwiseProduct(next.value).norm() >= (1.0 - 1e-3) * g.norm())
        continue;
      zero.y = y;
      zero.reach = zero.reach.cwiseMax(y.cwiseAbs());
      ++zero.iterations;
      at = std::move(next);
      damping = std::max(least_damping, mu / 1e4);
      moves = true;
    }
  }
  return zero;
}

Zero least_zero(const LinearizableMap& map,
                const std::function<Quadratic(const VectorXd& y)>& objective, const Zero& at,
                const Mobility& mobility) {
  constexpr double gamma = 1e-8;  // constraints give way to the objective by this much in a step,
                                  // find_zero takes it back
  Zero best = at;
  double previous_step = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Quadratic goal = objective(best.y);
    if (goal.value == 0.0) break;
    const NaturalScaling scaling(map(best.y), best.reach);
    const SparseMatrixXd& S = scaling.scaled;
    const Index n = goal.gradient.size();
    const VectorXd units = scaling.column_scale.head(n);
    const SparseMatrixXd H = units.asDiagonal() * goal.hessian * units.asDiagonal();
    const double strength = H.nonZeros() == 0 ? 0.0 : H.diagonal().maxCoeff();
    if (strength == 0.0) break;
    VectorXd right = VectorXd::Zero(best.y.size());
    right.head(n) = -units.cwiseProduct(goal.gradient) / strength;
    // The objective, and a little inertia for what it does not see.
    SparseMatrixXd P = diagonal(1e-6 * mobility.cost.cwiseAbs2());
    SparseMatrixXd lifted(best.y.size(), best.y.size());
    std::vector<Eigen::Triplet<double>> entries;
    for (Index j = 0; j < H.outerSize(); ++j)
      for (SparseMatrixXd::InnerIterator it(H, j); it; ++it)
        entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(j),
                             it.value() / strength);
    lifted.setFromTriplets(entries.begin(), entries.end());
    P += lifted;
    const VectorXd delta = SaddlePoint(P, S, gamma).solve(right, VectorXd::Zero(S.rows()));
    if (delta.size() == 0 || !delta.allFinite()) break;

    const double step = delta.norm();
    double length = 1.0;
    bool improved = false;
    while (!improved && length > 1e-3) {
      const Zero next =
          find_zero(map, best.y + length * scaling.column_scale.cwiseProduct(delta), mobility);
      // Near the minimum 1e-12 of the value is round-off, though y is known to 1e-6 only: there the
      // steps decide.
      const double change = next.found ? objective(next.y).value / goal.value - 1.0 : 1.0;
      if (change < -1e-12 || (change < 1e-12 && step < 0.5 * previous_step)) {
        const int iterations = best.iterations + next.iterations;
        best = next;
        best.iterations = iterations;
        improved = true;
      }
      length *= 0.5;
    }
    if (!improved) break;
    previous_step = step;
  }
  return best;
}

}  // namespace courant
