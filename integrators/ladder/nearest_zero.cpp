#include "courant/integrators/ladder/nearest_zero.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "courant/core/complete_orthogonal_decomposition.hpp"
#include "courant/core/lu_decomposition.hpp"

namespace courant {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// Data error of a dense Jacobian: what is next to it above about 10⁻⁹ is divided by.
constexpr double kNegligible = 2e-12;

// Defects that are taken for zero.
constexpr double kAccepted = 1e-10;

// Where dense factorisations are cheaper than sparse ones.
bool is_small(const SparseMatrixXd& S) { return std::max(S.rows(), S.cols()) <= 200; }

// The solution of [P Sᵀ; S -γ] (δ, y) = (a, b), with P ⪰ 0 diagonally strengthened to be definite:
// quasi-definite, so that LDLᵀ exists for every ordering. Entries far below those of S cost digits,
// which two steps of refinement bring back.
class SaddlePoint {
 public:
  SaddlePoint(const SparseMatrixXd& P, const SparseMatrixXd& S, double gamma) : columns_(S.cols()) {
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
    // Without exchanges a pivot may cancel to 0.
    if (factors_.info() != Eigen::Success && is_small(matrix_)) pivoted_.emplace(MatrixXd(matrix_));
  }

  Index columns() const { return columns_; }

  // δ; empty if the factorisation broke down.
  VectorXd solve(const VectorXd& a, const VectorXd& b) const {
    if (factors_.info() != Eigen::Success && !pivoted_) return VectorXd();
    const auto applied = [&](const VectorXd& right) -> VectorXd {
      return pivoted_ ? VectorXd(pivoted_->solve(right)) : VectorXd(factors_.solve(right));
    };
    VectorXd right(a.size() + b.size());
    right << a, b;
    VectorXd solution = applied(right);
    for (int refinement = 0; refinement < 2; ++refinement)
      solution += applied(right - matrix_ * solution);
    return solution.head(a.size());
  }

 private:
  Index columns_;
  SparseMatrixXd matrix_;
  Eigen::SimplicialLDLT<SparseMatrixXd, Eigen::Lower> factors_;
  std::optional<LuDecomposition> pivoted_;
};

SparseMatrixXd diagonal(const VectorXd& d) {
  SparseMatrixXd matrix(d.size(), d.size());
  matrix.setIdentity();
  return d.asDiagonal() * matrix;
}

// g ↦ argmin ‖S δ + g‖² + μ ‖cost ∘ δ‖², for μ = 0 the least one in this norm of those that
// minimise ‖S δ + g‖. Small ones by orthogonal factorisations, which square nothing: for μ = 0
// singular values down to about 10⁻⁹ count, and there is no step at all in the directions of
// others.
class DampedInverse {
 public:
  DampedInverse(const SparseMatrixXd& S, const VectorXd& cost, double mu)
      : m_(S.rows()), cost_(cost) {
    const Index n = S.cols();
    // Scales of numbers that are 10²⁰⁰ apart leave the range of doubles.
    is_finite_ = S.coeffs().isFinite().all() && std::isfinite(mu);
    if (!is_finite_) return;
    if (!is_small(S)) {
      const double root = std::sqrt(std::max(mu, 1e-10));
      saddle_.emplace(diagonal(root * cost.cwiseAbs2()), S, root);
    } else if (mu == 0.0) {
      least_norm_.emplace(MatrixXd(S * cost.cwiseInverse().asDiagonal()), kNegligible);
    } else {
      MatrixXd stacked = MatrixXd::Zero(m_ + n, n);
      stacked.topRows(m_) = S;
      stacked.bottomRows(n).diagonal() = std::sqrt(mu) * cost;
      damped_.emplace(QrDecomposition::in_order(stacked));
    }
  }

  // Empty if the matrix is not finite or the factorisation broke down.
  VectorXd step(const VectorXd& g) const {
    if (!is_finite_ || !g.allFinite()) return VectorXd();
    if (saddle_) return saddle_->solve(VectorXd::Zero(saddle_->columns()), -g);
    if (least_norm_) return cost_.cwiseInverse().asDiagonal() * least_norm_->solve(-g);
    VectorXd right = VectorXd::Zero(damped_->rows());
    right.head(m_) = -g;
    return damped_->solve(right);
  }

 private:
  Index m_;
  VectorXd cost_;
  bool is_finite_ = true;
  std::optional<SaddlePoint> saddle_;
  std::optional<CompleteOrthogonalDecomposition> least_norm_;
  std::optional<QrDecomposition> damped_;
};

// Whether every |F_i| is within the bound of its rounding error: nothing is left to improve.
bool is_rounded(const Linearization& at) {
  return at.value_error.size() == at.value.size() && at.value_error.allFinite() &&
         (at.value.cwiseAbs().array() <= at.value_error.array()).all();
}

// Zero::uncertainty at `at`, in the given units, where leading unknowns of the mobility are frozen.
VectorXd uncertainty(const Linearization& at, const NaturalScaling& units,
                     const SparseMatrixXd& frozen, const Mobility& mobility) {
  constexpr int samples = 3;
  constexpr double safety = 2.0;
  const SparseMatrixXd S =
      units.row_scale.asDiagonal() * at.jacobian * units.column_scale.asDiagonal();
  VectorXd moved = VectorXd::Zero(S.cols());
  if (S.size() == 0) return moved;
  const auto include = [&](const VectorXd& delta) {
    if (delta.size() > 0 && delta.allFinite()) moved = moved.cwiseMax(delta.cwiseAbs());
  };
  const VectorXd g = units.row_scale.cwiseProduct(at.value);
  if (!g.isZero(0.0)) include(DampedInverse(S, mobility.cost, 0.0).step(g));
  const VectorXd rounding = at.value_error.size() == g.size()
                                ? VectorXd(units.row_scale.cwiseProduct(at.value_error))
                                : VectorXd(VectorXd::Constant(g.size(), eps));
  const DampedInverse inverse(frozen, mobility.cost, 0.0);
  std::mt19937 generator(20250614);
  for (int sample = 0; sample < samples; ++sample)
    include(inverse.step(
        rounding.unaryExpr([&](double size) { return generator() % 2 == 0 ? size : -size; })));
  return safety * units.column_scale.cwiseProduct(moved);
}

// y + c ∘ δ, where unknowns that are round-off of the step that made them are 0: what is left of them
// must not look like numbers, nor choose units.
VectorXd stepped(const VectorXd& y, const VectorXd& units, const VectorXd& delta,
                 const Mobility& mobility) {
  const double round_off = 8.0 * eps * delta.norm();
  VectorXd there = y + units.cwiseProduct(delta);
  for (Index j = mobility.frozen; j < there.size(); ++j)
    if (std::fabs(there[j]) <= round_off * units[j]) there[j] = 0.0;
  return there;
}

// The units of a search at its points, as its mobility asks for them.
class SearchUnits {
 public:
  SearchUnits(const LinearizableMap& map, const Mobility& mobility, const VectorXd& y,
              const VectorXd& reach, const Linearization& at)
      : mobility_(mobility), magnitude_(mobility.magnitude) {
    if (magnitude_.size() == 0) magnitude_ = generic_magnitude(map, y, reach, at);
  }

  NaturalScaling operator()(const Linearization& at, const VectorXd& reach) {
    magnitude_ = SparseMatrixXd(magnitude_.cwiseMax(SparseMatrixXd(at.jacobian.cwiseAbs())));
    if (mobility_.has_exponentials) heed(at);
    return NaturalScaling({at.value, magnitude_, at.value_error}, reach);
  }

 private:
  // What a diode conducts by elsewhere is no size of what it blocks by: entries that are not round-off here
  // are what they are here. Frozen unknowns are no matter of equations that others are in.
  void heed(const Linearization& at) {
    constexpr double steep = 1e3;
    std::vector<bool> moves(static_cast<std::size_t>(magnitude_.rows()), false);
    for (Index j = 0; j < magnitude_.outerSize(); ++j)
      for (SparseMatrixXd::InnerIterator it(magnitude_, j); it; ++it) {
        const double here = std::fabs(at.jacobian.coeff(it.row(), j));
        const double error = at.error.size() > 0 ? at.error.coeff(it.row(), j) : 0.0;
        if (here > error && it.value() > steep * here) it.valueRef() = here;
        if (j >= mobility_.frozen && it.value() > 0.0)
          moves[static_cast<std::size_t>(it.row())] = true;
      }
    magnitude_.prune([&](Index i, Index j, double) {
      return j >= mobility_.frozen || !moves[static_cast<std::size_t>(i)];
    });
  }

  const Mobility& mobility_;
  SparseMatrixXd magnitude_;
};

// `units`, smaller where a step by one of them would change a derivative to more than 1000 times the largest one
// of its equation: an exponential leads out of the range of numbers, when a unit is what a diode blocks by.
NaturalScaling curbed(NaturalScaling units, const LinearizableMap& map, const VectorXd& y,
                      const Linearization& at, const Mobility& mobility) {
  constexpr double most = 1e3;
  const SparseMatrixXd here = at.jacobian.cwiseAbs();
  VectorXd largest = VectorXd::Zero(here.rows());  // of a row, in units
  for (Index j = mobility.frozen; j < here.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(here, j); it; ++it)
      largest[it.row()] = std::max(largest[it.row()], it.value() * units.column_scale[j]);
  const auto grows = [&](Index moved, double size) {
    VectorXd there = y;
    there[moved] += size;
    const Linearization next = map(there);
    if (!is_finite(next)) return true;
    for (Index j = mobility.frozen; j < next.jacobian.outerSize(); ++j)
      for (SparseMatrixXd::InnerIterator it(next.jacobian, j); it; ++it)
        if (std::fabs(it.value()) * units.column_scale[j] > most * largest[it.row()]) return true;
    return false;
  };
  for (Index j = mobility.frozen; j < y.size(); ++j) {
    double size = units.column_scale[j];
    for (int k = 0; k < 60 && (grows(j, size) || grows(j, -size)); ++k) size *= 0.25;
    units.column_scale[j] = size;
  }
  return units;
}

// With `safeguard`, every step has to be an improvement; else full steps are made.
Zero search(const LinearizableMap& map, const VectorXd& start, const Mobility& mobility,
            bool safeguard) {
  constexpr double least_damping = 1e-12;
  const int most_iterations = safeguard ? 100 : 25;
  Zero zero;
  zero.y = start;
  zero.reach = start.cwiseAbs();
  if (mobility.typical.size() > 0) zero.reach = zero.reach.cwiseMax(mobility.typical);
  zero.defect = std::numeric_limits<double>::infinity();
  Linearization at = map(start);
  zero.is_finite = is_finite(at);
  if (!zero.is_finite) return zero;

  SearchUnits units_at(map, mobility, start, zero.reach, at);
  double damping = 0.0;
  bool moves = true;
  // Sparse factors reach what is seen through singular values below 10⁻⁵ only little by little. Where
  // curvature can no longer be why, so many steps in a row that leave nearly all of the residual end it.
  constexpr double straight = 1e-5, nearly_all = 0.9;
  constexpr int most_slow_steps = 3;
  int slow_steps = 0;
  while (moves) {
    NaturalScaling units = units_at(at, zero.reach);
    const VectorXd value = significant(at);
    const VectorXd g = units.row_scale.cwiseProduct(value);
    zero.scaled_value = g;
    zero.defect = units.defect(value, zero.reach);
    const bool rounded = is_rounded(at);
    zero.found = rounded || zero.defect <= kAccepted;
    zero.history.push_back(zero.defect);
    const bool is_curbed = mobility.has_exponentials && !zero.found && is_small(at.jacobian);
    if (is_curbed) units = curbed(std::move(units), map, zero.y, at, mobility);
    SparseMatrixXd S = units.row_scale.asDiagonal() * at.jacobian * units.column_scale.asDiagonal();
    S.prune([&](Index, Index column, double) { return column >= mobility.frozen; });
    moves = false;
    const bool is_done =
        rounded || zero.defect <= eps || zero.iterations == most_iterations || !g.allFinite();
    // A step damped by μ has about the length ‖F‖ / μ. Where numbers are small and a zero is far, as
    // 10⁻⁸ is from a circle of radius 1, ‖F‖ is large in these units.
    const double most_damping = 1e8 * std::min(std::max(1.0, g.norm()), 1e60);
    // At the level of rounding a step that does not help is the end; far from it, too long.
    for (double mu = damping; !is_done && !moves && mu <= (zero.found ? damping : most_damping);
         mu = std::max((is_curbed ? 10.0 : 100.0) * mu, least_damping)) {
      const DampedInverse inverse(S, mobility.cost, mu);
      const VectorXd delta = inverse.step(g);
      if (delta.size() == 0 || !delta.allFinite()) continue;
      if (mu == 0.0) {
        const bool stationary = (S * delta + g).squaredNorm() > (1.0 - 1e-6) * g.squaredNorm();
        if (stationary) break;
      }
      const VectorXd y = stepped(zero.y, units.column_scale, delta, mobility);
      if (mobility.admits && !mobility.admits(y)) continue;
      Linearization next = map(y);
      if (!is_finite(next)) continue;
      const VectorXd residual = units.row_scale.cwiseProduct(significant(next));
      if (residual.norm() >= (1.0 - 1e-3) * g.norm() && (safeguard || zero.found)) {
        // A residual may grow where equations are curved and the next step be shorter all the same
        // (the natural monotonicity of Deuflhard).
        if (zero.found) continue;
        const VectorXd after = inverse.step(residual);
        if (!(mobility.cost.cwiseProduct(after).norm() <
              0.5 * mobility.cost.cwiseProduct(delta).norm()))
          continue;
      }
      const bool is_slow = mu == 0.0 && !is_small(S) && zero.defect <= straight &&
                           residual.norm() > nearly_all * g.norm();
      slow_steps = is_slow ? slow_steps + 1 : 0;
      if (slow_steps > most_slow_steps) break;
      zero.y = y;
      zero.reach = zero.reach.cwiseMax(y.cwiseAbs());
      ++zero.iterations;
      at = std::move(next);
      // A large μ was one for the ‖F‖ of that point.
      damping = mu / 1e6 < least_damping ? 0.0 : std::min(mu / 1e6, 1.0);
      moves = true;
    }
    if (moves || !zero.found) continue;
    zero.uncertainty = uncertainty(at, units, S, mobility);
    // exp (v/25 mV) - 1 leaves of a voltage that is 0 what it takes from 1.
    if (mobility.has_exponentials)
      for (Index j = mobility.frozen; j < zero.y.size(); ++j)
        if (start[j] == 0.0 && std::fabs(zero.y[j]) <= zero.uncertainty[j]) zero.y[j] = 0.0;
    // Unknowns that F leaves open collect noise of the iteration, and given ones bring that of the
    // computation that they come from. What is proportional to it must not look like a number.
    for (Index j = 0; j < zero.y.size(); ++j) {
      const double offset = j < mobility.offset.size() ? mobility.offset[j] : 0.0;
      if (const double size = std::fabs(zero.y[j]) + offset;
          size < mobility.noise * units.column_scale[j])
        zero.uncertainty[j] = std::max(zero.uncertainty[j], size);
    }
  }
  return zero;
}

}  // namespace

bool is_finite(const Linearization& at) {
  if (!at.value.allFinite()) return false;
  for (Index j = 0; j < at.jacobian.outerSize(); ++j)
    for (SparseMatrixXd::InnerIterator it(at.jacobian, j); it; ++it)
      if (!std::isfinite(it.value())) return false;
  return true;
}

Zero find_zero(const LinearizableMap& map, const VectorXd& start, const Mobility& mobility) {
  const Zero careful = search(map, start, mobility, true);
  if (careful.found) return careful;
  const Zero bold = search(map, start, mobility, false);
  return bold.found ? bold : careful;
}

bool is_met(const Linearization& at) {
  constexpr double unseen = 1e-6;  // of the terms
  return at.value_error.size() != at.value.size() ||
         (at.value.array().abs() <= unseen / Uncertain::unit * at.value_error.array()).all();
}

VectorXd kernel_part(const SparseMatrixXd& S, const VectorXd& direction) {
  const VectorXd normal = DampedInverse(S, VectorXd::Ones(S.cols()), 0.0).step(-(S * direction));
  return normal.size() == 0 ? VectorXd(VectorXd::Zero(direction.size())) : direction - normal;
}

// argmin ½ δᵀPδ - aᵀδ where S δ = 0, in an orthonormal basis of the kernel: rows of S that depend on each other,
// which leave a factorisation without exchanges no digits, do no harm. Empty where S is not finite.
VectorXd step_in_kernel(const SparseMatrixXd& P, const SparseMatrixXd& S, const VectorXd& a) {
  if (!S.coeffs().isFinite().all()) return VectorXd();
  const CompleteOrthogonalDecomposition rows(MatrixXd(S.transpose()), kNegligible);
  const MatrixXd Z = rows.Q().rightCols(S.cols() - rows.rank());
  const MatrixXd reduced = Z.transpose() * (P * Z).eval();
  return Z * reduced.ldlt().solve(Z.transpose() * a);
}

Zero least_zero(const LinearizableMap& map,
                const std::function<Quadratic(const VectorXd& y)>& objective, const Zero& at,
                const Mobility& mobility) {
  constexpr double gamma = 1e-11;  // constraints give way to the objective by this much in a step,
                                   // find_zero takes it back
  Zero best = at;
  double length = 1.0;
  VectorXd before;  // the whole step before this one
  double shortest_step = std::numeric_limits<double>::infinity();
  int stalled = 0;
  bool loses_digits = false;
  // A thousand times those of `at`. Where momenta are of no degree in velocities, as w / |w| is, entries vanish on the
  // way to the nearest one, and units that follow them lead to velocities of 10¹⁷.
  constexpr double most_growth = 1e3;
  VectorXd largest_units;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Quadratic goal = objective(best.y);
    if (goal.value == 0.0) break;
    const Linearization here = map(best.y);
    NaturalScaling scaling(here, best.reach);
    if (iteration == 0) largest_units = most_growth * scaling.column_scale;
    scaling.column_scale = scaling.column_scale.cwiseMin(largest_units);
    const SparseMatrixXd S =
        scaling.row_scale.asDiagonal() * here.jacobian * scaling.column_scale.asDiagonal();
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
    VectorXd delta = SaddlePoint(P, S, gamma).solve(right, VectorXd::Zero(S.rows()));
    // No step takes more from the objective than there is: one that promises to has lost its digits, and so
    // may the steps after it.
    const double most = 1.01 * 2.0 * goal.value / strength;
    const bool is_finite = delta.size() > 0 && delta.allFinite();
    loses_digits = loses_digits || (is_finite && right.dot(delta) > most);
    if (loses_digits && is_small(S)) delta = step_in_kernel(P, S, right);
    if (delta.size() == 0 || !delta.allFinite()) break;

    const double step = delta.norm();
    if (before.size() > 0) {
      // Where constraints are curved whole steps go too far; two steps tell by how much
      // (Barzilai, Borwein 1988).
      const VectorXd last = before.cwiseQuotient(scaling.column_scale);
      const double bend = last.dot(last - delta);
      length = bend > 0.0 ? std::min(1.0, length * last.squaredNorm() / bend) : 1.0;
    }
    bool improved = false;
    double change = 0.0;
    for (; length > 1e-3; length *= 0.5) {
      const Zero next =
          find_zero(map, best.y + length * scaling.column_scale.cwiseProduct(delta), mobility);
      if (!next.found) continue;
      change = objective(next.y).value / goal.value - 1.0;
      // Near the minimum 1e-10 of the value is round-off, though y is known to 1e-5 only: there the
      // steps decide.
      if (change > 1e-10) continue;
      const int iterations = best.iterations + next.iterations;
      best = next;
      best.iterations = iterations;
      improved = true;
      break;
    }
    stalled = change > -1e-10 && step > 0.5 * shortest_step ? stalled + 1 : 0;
    if (!improved || step < 1e-10 || stalled == 4) break;
    before = scaling.column_scale.cwiseProduct(delta);
    shortest_step = std::min(shortest_step, step);
  }
  return best;
}

}  // namespace courant
