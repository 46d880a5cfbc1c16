#include "courant/integrators/ladder/obstruction.hpp"

#include <cmath>

#include "courant/core/singular_value_decomposition.hpp"

namespace courant {

Obstruction::Obstruction(const Prolongation& array, const VectorXd& y, const VectorXd& uncertainty,
                         Index rank)
    : array_(array), y_(y), uncertainty_(uncertainty) {
  const ComparableJacobian at(array, y, uncertainty);
  const SingularValueDecomposition svd = singular_value_decomposition(MatrixXd(at.scaled.value));
  row_scale_ = at.row_scale;
  // Errors turn W by their part of the least singular value that counts, in radians.
  constexpr double least_turned = 1e-3;
  is_known_ = rank == 0 || at.scaled.error.norm() <= least_turned * svd.values[rank - 1];
  unseen_ = svd.U.rightCols(svd.U.cols() - rank).transpose() * row_scale_.asDiagonal();
}

Obstruction::Answer Obstruction::is_seen_along(const VectorXd& direction) const {
  if (unseen_.rows() == 0) return Answer::no;
  // From 10⁻⁷ of a unit, which may be a large one, to where functions bend away from their powers: g ~ ε²
  // is above round-off from 10⁻⁶ on, ε³ from 10⁻⁴. What looks like a power at three sizes is one.
  constexpr double first = 1.0 / 4194304.0, last = 1.0 / 16.0, ratio = 4.0, least_power = 2.5;
  constexpr double measurable = 1e3;    // times the bound of rounding errors
  constexpr double negligible = 1e-13;  // next to all of F, in comparable units
  constexpr double least_growth = 8.0;  // of all of F, which is quadratic along a tangent
  constexpr double small = 1e-1;        // of ε², in comparable units: less need not be seen
  double before = 0.0, all_before = 0.0, weak_before = 0.0;
  int slow = 0, weak = 0;
  bool is_tangent = true, is_visible = false;
  const auto seen = [&] { return is_tangent && is_known_ ? Answer::yes : Answer::unknown; };
  for (double epsilon = first; epsilon <= last; epsilon *= ratio) {
    const VectorXd y = y_ + epsilon * direction;
    const Linearization there =
        array_.linearize(y, uncertainty_.cwiseMax(Prolongation::rounding(y)));
    if (!there.value.allFinite()) return Answer::no;
    const double g = (unseen_ * there.value).norm();
    const double row_noise = row_scale_.cwiseProduct(there.value_error).norm();
    const double noise = (unseen_.cwiseAbs() * there.value_error).norm();
    const double all = row_scale_.cwiseProduct(there.value).norm();
    is_visible = is_visible || measurable * noise < small * epsilon * epsilon;
    // Off the tangent space what J does not see is of second order everywhere.
    const bool is_measured = all > measurable * row_noise;
    if (all_before > 0.0 && is_measured && all < least_growth * all_before) return Answer::no;
    all_before = is_measured ? all : 0.0;
    if (before > 0.0) {
      if (std::log(g / before) >= least_power * std::log(ratio)) return Answer::no;
      is_tangent = is_tangent && is_measured;
      if (++slow == 2) return seen();
    }
    // Above the bound of its error g is not zero, though little is known of how it grows.
    weak = weak_before > 0.0 && std::log(g / weak_before) < least_power * std::log(ratio) ? weak + 1
                                                                                          : 0;
    weak_before = g > noise && g > negligible * all ? g : 0.0;
    if (before > 0.0 || (g > measurable * noise && g > negligible * all)) before = g;
  }
  if (slow > 0) return seen();
  return is_visible && weak < 2 ? Answer::no : Answer::unknown;
}

}  // namespace courant
