#include "courant/integrators/certificate/obstruction.hpp"

#include <cmath>

#include "courant/core/linear/singular_value_decomposition.hpp"

namespace courant {
namespace {

constexpr double kFirst = 1.0 / 4194304.0, kLast = 1.0 / 16.0;  // of a direction
constexpr double kRatio = 4.0;                                  // from one look to the next
constexpr double kLeastGrowth = 8.0;  // of all of F, which is quadratic along a tangent
constexpr double kMeasurable = 1e3;   // times the bound of rounding errors
constexpr double kBounded = 1e1;      // times that bound, a number is below something for certain
constexpr double kRounded = 1e-12;    // of all of F: what rounding alone leaves of an unseen part
constexpr double kSmall = 1e-1;       // of ε², in comparable units: less need not be seen

}  // namespace

Obstruction::Obstruction(const Prolongation& array, const VectorXd& y, const VectorXd& uncertainty,
                         Index rank, const SparseMatrixXd& magnitude, double blurred)
    : array_(array), y_(y), uncertainty_(uncertainty), blurred_(blurred) {
  const ComparableJacobian at(array, y, uncertainty);
  at_ = array.linearize(y);
  const SingularValueDecomposition svd = singular_value_decomposition(MatrixXd(at.scaled.value));
  row_scale_ = at.row_scale;
  // Errors turn W by their part of the least singular value that counts, in radians.
  constexpr double least_turned = 1e-3;
  is_known_ = rank == 0 || at.scaled.error.norm() <= least_turned * svd.values[rank - 1];
  // At y itself rounding is the only error, beside entries that were left out for theirs.
  const SparseMatrixXd numbers =
      at.row_scale.asDiagonal() * at_.jacobian * at.column_scale.asDiagonal();
  const SparseMatrixXd rounding =
      at.row_scale.asDiagonal() * at_.error * at.column_scale.asDiagonal();
  const SparseMatrixXd left_out = numbers - at.scaled.value;
  turned_ = rank == 0 ? 0.0 : (rounding.norm() + left_out.norm()) / svd.values[rank - 1];
  // Rows that a combination has nothing to do with may be 10²⁰ times as large.
  constexpr double round_off = 1e-14;
  unseen_ = svd.U.rightCols(svd.U.cols() - rank).transpose().unaryExpr([](double weight) {
    return std::fabs(weight) <= round_off ? 0.0 : weight;
  });
  const VectorXd seen = SparseMatrixXd(at.scaled.value.cwiseAbs()) * VectorXd::Ones(y.size());
  magnitude_of_empty_ = magnitude;
  magnitude_of_empty_.prune([&](Index row, Index, double) { return seen[row] == 0.0; });
}

VectorXd Obstruction::row_scale_along(const VectorXd& direction) const {
  const VectorXd size = magnitude_of_empty_ * direction.cwiseAbs();
  return (size.array() > 0.0).select(size.cwiseInverse(), row_scale_);
}

double Obstruction::least_seen(const MatrixXd& unseen, const Linearization& there,
                               const VectorXd& step, double epsilon) const {
  SparseMatrixXd change = (there.jacobian - at_.jacobian).cwiseAbs();
  const SparseMatrixXd error = at_.error + there.error;
  change.prune([&](Index i, Index j, double size) { return size > error.coeff(i, j); });
  const double bend = (unseen.cwiseAbs() * (change * step.cwiseAbs())).norm();
  const double natural = epsilon * epsilon;
  return kSmall * (bend > 0.0 ? std::min(bend, natural) : natural);
}

// The bounds of errors say what the zero that is meant, which is a little elsewhere, may make of g. The
// numbers themselves have rounding errors alone: where they are far below ε², nothing is hidden.
bool Obstruction::is_small_along(const VectorXd& direction) const {
  const VectorXd row_scale = row_scale_along(direction);
  const MatrixXd unseen = unseen_ * row_scale.asDiagonal();
  for (double epsilon = kLast; epsilon > kLast / 100.0; epsilon *= 0.25) {
    const Linearization there = array_.linearize(y_ + epsilon * direction);
    const double g = (unseen * there.value).norm();
    const double noise = (unseen.cwiseAbs() * there.value_error).norm() +
                         blurred_ * row_scale.cwiseProduct(there.value).norm();
    if (std::max(g, kBounded * noise) < least_seen(unseen, there, epsilon * direction, epsilon))
      return true;
  }
  return false;
}

bool Obstruction::is_square_along(const VectorXd& direction, double part) const {
  constexpr double exact = 0.3;  // of a power
  constexpr int needed = 4;
  const VectorXd row_scale = row_scale_along(direction);
  const MatrixXd unseen = unseen_ * row_scale.asDiagonal();
  const Linearization last = array_.linearize(y_ + kLast * direction);
  if (row_scale.cwiseProduct(last.value).norm() <
      kMeasurable * row_scale.cwiseProduct(last.value_error).norm())
    return false;
  double before = 0.0, all_before = 0.0;
  int squares = 0;
  for (double epsilon = kFirst; epsilon <= kLast && squares < needed; epsilon *= kRatio) {
    const VectorXd value = array_.residual(y_ + epsilon * direction);
    const double g = (unseen * value).norm();
    const double all = row_scale.cwiseProduct(value).norm();
    const bool is_number = g > std::max(part, kBounded * blurred_) * all;
    const double power = std::log(g / before) / std::log(kRatio);
    squares = is_number && before > 0.0 && std::fabs(power - 2.0) < exact &&
                      all >= kLeastGrowth * all_before
                  ? squares + 1
                  : 0;
    before = is_number ? g : 0.0;
    all_before = all;
  }
  return squares == needed;
}

Obstruction::Answer Obstruction::is_seen_along(const VectorXd& direction) const {
  if (unseen_.rows() == 0) return Answer::no;
  const Answer answer = by_bounds_along(direction);
  if (answer != Answer::yes && is_square_along(direction, kBounded * turned_))
    return Answer::likely;
  return answer == Answer::no && is_square_along(direction, kRounded) ? Answer::unknown : answer;
}

Obstruction::Answer Obstruction::by_bounds_along(const VectorXd& direction) const {
  const VectorXd row_scale = row_scale_along(direction);
  const MatrixXd unseen = unseen_ * row_scale.asDiagonal();
  // From 10⁻⁷ of a unit, which may be a large one, to where functions bend away from their powers: g ~ ε²
  // is above round-off from 10⁻⁶ on, ε³ from 10⁻⁴. What looks like a power at three sizes is one.
  constexpr double least_power = 2.5;
  constexpr double negligible = 1e-13;  // next to the terms of g, in comparable units
  double before = 0.0, all_before = 0.0, weak_before = 0.0;
  int slow = 0, weak = 0;
  bool is_tangent = true, is_visible = false, was_cubic = false;
  const auto seen = [&] { return is_tangent && is_known_ ? Answer::yes : Answer::unknown; };
  for (double epsilon = kFirst; epsilon <= kLast; epsilon *= kRatio) {
    const VectorXd y = y_ + epsilon * direction;
    const Linearization there =
        array_.linearize(y, uncertainty_.cwiseMax(Prolongation::rounding(y)));
    if (!there.value.allFinite()) return Answer::no;
    const double g = (unseen * there.value).norm();
    const double row_noise = row_scale.cwiseProduct(there.value_error).norm();
    const double all = row_scale.cwiseProduct(there.value).norm();
    const double noise = (unseen.cwiseAbs() * there.value_error).norm() + blurred_ * all;
    const double terms = (unseen.cwiseAbs() * there.value.cwiseAbs()).norm();
    const double least = least_seen(unseen, there, epsilon * direction, epsilon);
    is_visible = is_visible || kMeasurable * noise < least || std::max(g, kBounded * noise) < least;
    // Off the tangent space what J does not see is of second order everywhere.
    const bool is_measured = all > kMeasurable * row_noise;
    if (all_before > 0.0 && is_measured && all < kLeastGrowth * all_before) return Answer::beside;
    all_before = is_measured ? all : 0.0;
    if (before > 0.0) {
      if (std::log(g / before) >= least_power * std::log(kRatio)) return Answer::no;
      is_tangent = is_tangent && is_measured;
      if (++slow == 2) return seen();
    }
    // Above the bound of its error g is not zero, though little is known of how it grows.
    const bool is_weak =
        weak_before > 0.0 && std::log(g / weak_before) < least_power * std::log(kRatio);
    was_cubic = was_cubic || (weak_before > 0.0 && !is_weak);
    weak = is_weak ? weak + 1 : 0;
    weak_before = g > noise && g > negligible * terms ? g : 0.0;
    if (before > 0.0 || (g > kMeasurable * noise && g > negligible * terms)) before = g;
  }
  // Two sizes alone, the last ones, tell no power where g was seen to be a cube before.
  if (slow > 0 && !was_cubic) return seen();
  if (weak >= 2) return Answer::unknown;
  return is_visible || is_small_along(direction) ? Answer::no : Answer::unknown;
}

}  // namespace courant
