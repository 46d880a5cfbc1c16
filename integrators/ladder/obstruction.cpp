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
  unseen_ = svd.U.rightCols(svd.U.cols() - rank).transpose() * row_scale_.asDiagonal();
}

bool Obstruction::is_seen_along(const VectorXd& direction) const {
  if (unseen_.rows() == 0) return false;
  // From 10⁻⁷ of a unit, which may be a large one, to where functions bend away from their powers: g ~ ε²
  // is above round-off from 10⁻⁶ on, ε³ from 10⁻⁴. What looks like a power at three sizes is one.
  constexpr double first = 1.0 / 4194304.0, last = 1.0 / 16.0, ratio = 4.0, least_power = 2.5;
  constexpr double measurable = 1e3;    // times the bound of rounding errors
  constexpr double negligible = 1e-13;  // next to all of F, in comparable units
  constexpr double least_growth = 8.0;  // of all of F, which is quadratic along a tangent
  double before = 0.0, all_before = 0.0;
  int slow = 0;
  for (double epsilon = first; epsilon <= last; epsilon *= ratio) {
    const VectorXd y = y_ + epsilon * direction;
    const Linearization there =
        array_.linearize(y, uncertainty_.cwiseMax(Prolongation::rounding(y)));
    if (!there.value.allFinite()) return false;
    const double g = (unseen_ * there.value).norm();
    const double row_noise = row_scale_.cwiseProduct(there.value_error).norm();
    const double noise = (unseen_.cwiseAbs() * there.value_error).norm();
    const double all = row_scale_.cwiseProduct(there.value).norm();
    // Off the tangent space what J does not see is of second order everywhere.
    if (all_before > 0.0 && all > measurable * row_noise && all < least_growth * all_before)
      return false;
    all_before = all > measurable * row_noise ? all : 0.0;
    if (before > 0.0) {
      if (std::log(g / before) >= least_power * std::log(ratio)) return false;
      if (++slow == 2) return true;
    }
    if (before > 0.0 || (g > measurable * noise && g > negligible * all)) before = g;
  }
  return slow > 0;
}

}  // namespace courant
