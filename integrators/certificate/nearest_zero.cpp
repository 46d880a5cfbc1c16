#include "courant/integrators/certificate/nearest_zero.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "courant/integrators/certificate/damped_inverse.hpp"
#include "courant/integrators/certificate/search_units.hpp"

namespace courant {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

// Defects that are taken for zero.
constexpr double kAccepted = 1e-10;

// Whether every |F_i| is within the bound of its rounding error: nothing is left to improve.
bool is_rounded(const Linearization& at) {
  return at.value_error.size() == at.value.size() && at.value_error.allFinite() &&
         (at.value.cwiseAbs().array() <= at.value_error.array()).all();
}

// Whether every F_i that is more than rounding is small next to its own terms, of numbers as large as `nominal` and with
// derivatives of this size: those of other equations, which units of a component are made of, say nothing of
// x² + y² = l² of nanometres beside a weight. Numbers that are round-off in these units are as large as those; the point
// only where it vanishes.
bool is_small_next_to_terms(const Linearization& at, const SparseMatrixXd& derivatives,
                            const NaturalScaling& units, const VectorXd& nominal,
                            Index point_size) {
  constexpr double round_off = 1e-9;
  VectorXd sizes = nominal;
  for (Index j = 0; j < sizes.size(); ++j) {
    const double vanishing = j < point_size ? 0.0 : round_off * units.column_scale[j];
    if (sizes[j] <= vanishing) sizes[j] = units.column_scale[j];
  }
  const VectorXd terms = derivatives * sizes;
  return (significant(at).array().abs() <= kAccepted * terms.array()).all();
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

// One search: where it is, and what it found.
class ZeroSearch {
 public:
  // With `is_careful`, every step has to be an improvement; else full steps are made.
  ZeroSearch(const LinearizableMap& map, const VectorXd& start, const Mobility& mobility,
             bool is_careful)
      : map_(map), start_(start), mobility_(mobility), is_careful_(is_careful) {}

  Zero run() {
    zero_ = Zero(start_);
    if (mobility_.nominal.size() > 0) zero_.nominal = zero_.nominal.cwiseMax(mobility_.nominal);
    zero_.defect = std::numeric_limits<double>::infinity();
    at_ = map_(start_);
    zero_.is_finite = is_finite(at_);
    if (!zero_.is_finite) return zero_;
    units_at_.emplace(map_, mobility_, start_, zero_.nominal, at_);
    Place here = place();
    while (moves(here)) here = place();
    if (!zero_.found) return zero_;
    zero_.uncertainty = uncertainty(here);
    // Of numbers that leave the range of doubles no error is known.
    zero_.found = zero_.uncertainty.allFinite();
    if (zero_.found) forget_noise(here.units);
    return zero_;
  }

 private:
  // The map in units: S = diag(r) J diag(c) without frozen columns, and g = diag(r) F.
  struct Place {
    NaturalScaling units;
    SparseMatrixXd S;
    VectorXd g;
    bool is_exact = false;         // up to the bounds of rounding errors
    bool has_step_limits = false;  // in units that exponentials need
  };

  Place place() {
    NaturalScaling units = (*units_at_)(at_, zero_.nominal);
    const VectorXd value = significant(at_);
    const VectorXd g = units.row_scale.cwiseProduct(value);
    zero_.scaled_value = g;
    zero_.defect = units.defect(value, zero_.nominal);
    const bool rounded = is_rounded(at_);
    const SparseMatrixXd here = at_.jacobian.cwiseAbs();
    derivatives_ = derivatives_.size() == 0 ? here : SparseMatrixXd(derivatives_.cwiseMax(here));
    zero_.found = rounded || (zero_.defect <= kAccepted &&
                              is_small_next_to_terms(at_, derivatives_, units, zero_.nominal,
                                                     mobility_.offset.size()));
    zero_.history.push_back(zero_.defect);
    const bool has_step_limits =
        mobility_.has_exponentials && !zero_.found && is_factored_dense(at_.jacobian);
    if (has_step_limits) units = with_step_limits(std::move(units), map_, zero_.y, at_, mobility_);
    SparseMatrixXd S =
        units.row_scale.asDiagonal() * at_.jacobian * units.column_scale.asDiagonal();
    S.prune([&](Index, Index column, double) { return column >= mobility_.frozen; });
    return {std::move(units), std::move(S), g, rounded, has_step_limits};
  }

  // Makes the least damped step that helps, if there is one.
  bool moves(const Place& here) {
    constexpr double least_damping = 1e-12;
    const int most_iterations = is_careful_ ? 100 : 25;
    const SparseMatrixXd& S = here.S;
    const VectorXd& g = here.g;
    if (here.is_exact || (zero_.found && zero_.defect <= eps) ||
        zero_.iterations == most_iterations || !g.allFinite())
      return false;
    // A step damped by μ has about the length ‖F‖ / μ. Where numbers are small and a zero is far, as
    // 10⁻⁸ is from a circle of radius 1, ‖F‖ is large in these units.
    const double most_damping = 1e8 * std::min(std::max(1.0, g.norm()), 1e60);
    // At the level of rounding a step that does not help is the end; far from it, too long.
    const double most = zero_.found ? damping_ : most_damping;
    for (double mu = damping_; mu <= most;
         mu = std::max((here.has_step_limits ? 10.0 : 100.0) * mu, least_damping)) {
      const DampedInverse inverse(S, mobility_.cost, mu);
      const VectorXd delta = inverse.step(g);
      if (delta.size() == 0 || !delta.allFinite()) continue;
      if (mu == 0.0) {
        const bool stationary = (S * delta + g).squaredNorm() > (1.0 - 1e-6) * g.squaredNorm();
        if (stationary) return false;
      }
      const VectorXd y = stepped(zero_.y, here.units.column_scale, delta, mobility_);
      if (mobility_.admits && !mobility_.admits(y)) continue;
      Linearization next = map_(y);
      if (!is_finite(next)) continue;
      const VectorXd residual = here.units.row_scale.cwiseProduct(significant(next));
      // What grows like exp x may leave the range of doubles in these units alone.
      if (!residual.allFinite()) continue;
      if (!helps(inverse, delta, residual, g)) continue;
      if (has_crept(mu == 0.0 && !is_factored_dense(S), residual, g)) return false;
      zero_.y = y;
      zero_.nominal = zero_.nominal.cwiseMax(y.cwiseAbs());
      ++zero_.iterations;
      at_ = std::move(next);
      // A large μ was one for the ‖F‖ of that point.
      damping_ = mu / 1e6 < least_damping ? 0.0 : std::min(mu / 1e6, 1.0);
      return true;
    }
    return false;
  }

  // A residual may grow where equations are curved and the next step be shorter all the same
  // (the natural monotonicity of Deuflhard).
  bool helps(const DampedInverse& inverse, const VectorXd& delta, const VectorXd& residual,
             const VectorXd& g) const {
    const bool is_no_less = residual.norm() >= (1.0 - 1e-3) * g.norm();
    if (!is_no_less || !(is_careful_ || zero_.found)) return true;
    if (zero_.found) return false;
    const VectorXd after = inverse.step(residual);
    return mobility_.cost.cwiseProduct(after).norm() <
           0.5 * mobility_.cost.cwiseProduct(delta).norm();
  }

  // Sparse factors get to what is seen through singular values below 10⁻⁵ only little by little. Where
  // curvature can no longer be why, so many steps in a row that leave nearly all of the residual end it.
  bool has_crept(bool is_sparse, const VectorXd& residual, const VectorXd& g) {
    constexpr double straight = 1e-5, nearly_all = 0.9;
    constexpr int most_slow_steps = 3;
    const bool is_slow =
        is_sparse && zero_.defect <= straight && residual.norm() > nearly_all * g.norm();
    slow_steps_ = is_slow ? slow_steps_ + 1 : 0;
    return slow_steps_ > most_slow_steps;
  }

  // Zero::uncertainty where the search ended.
  VectorXd uncertainty(const Place& here) const {
    constexpr int samples = 3;
    constexpr double safety = 2.0;
    const NaturalScaling& units = here.units;
    const SparseMatrixXd S =
        units.row_scale.asDiagonal() * at_.jacobian * units.column_scale.asDiagonal();
    VectorXd moved = VectorXd::Zero(S.cols());
    if (S.size() == 0) return moved;
    const auto include = [&](const VectorXd& delta) {
      if (delta.size() > 0 && delta.allFinite()) moved = moved.cwiseMax(delta.cwiseAbs());
    };
    const VectorXd g = units.row_scale.cwiseProduct(at_.value);
    if (!g.isZero(0.0)) include(DampedInverse(S, mobility_.cost, 0.0).step(g));
    const VectorXd rounding = at_.value_error.size() == g.size()
                                  ? VectorXd(units.row_scale.cwiseProduct(at_.value_error))
                                  : VectorXd(VectorXd::Constant(g.size(), eps));
    const DampedInverse inverse(here.S, mobility_.cost, 0.0);
    std::mt19937 generator(20250614);
    for (int sample = 0; sample < samples; ++sample)
      include(inverse.step(
          rounding.unaryExpr([&](double size) { return generator() % 2 == 0 ? size : -size; })));
    return safety * units.column_scale.cwiseProduct(moved);
  }

  void forget_noise(const NaturalScaling& units) {
    // exp (v/25 mV) - 1 leaves of a voltage that is 0 what it takes from 1.
    if (mobility_.has_exponentials)
      for (Index j = mobility_.frozen; j < zero_.y.size(); ++j)
        if (start_[j] == 0.0 && std::fabs(zero_.y[j]) <= zero_.uncertainty[j]) zero_.y[j] = 0.0;
    // Unknowns that F leaves open collect noise of the iteration, and given ones bring that of the
    // computation that they come from. What is proportional to it must not look like a number.
    for (Index j = 0; j < zero_.y.size(); ++j) {
      const double offset = j < mobility_.offset.size() ? mobility_.offset[j] : 0.0;
      if (const double size = std::fabs(zero_.y[j]) + offset;
          size < mobility_.noise * units.column_scale[j])
        zero_.uncertainty[j] = std::max(zero_.uncertainty[j], size);
    }
  }

  const LinearizableMap& map_;
  const VectorXd& start_;
  const Mobility& mobility_;
  const bool is_careful_;
  Zero zero_;
  Linearization at_;            // zero_.y
  SparseMatrixXd derivatives_;  // the largest on the way
  std::optional<SearchUnits> units_at_;
  double damping_ = 0.0;
  int slow_steps_ = 0;
};

}  // namespace

Zero find_zero(const LinearizableMap& map, const VectorXd& start, const Mobility& mobility) {
  Zero careful = ZeroSearch(map, start, mobility, true).run();
  if (careful.found) return careful;
  const Zero bold = ZeroSearch(map, start, mobility, false).run();
  return bold.found ? bold : careful;
}

bool is_met(const Linearization& at) {
  constexpr double unseen = 1e-6;  // of the terms
  return at.value_error.size() != at.value.size() ||
         (at.value.array().abs() <= unseen / Uncertain::unit * at.value_error.array()).all();
}

}  // namespace courant
