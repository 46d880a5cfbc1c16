// find_zero: a zero of a map near a given point, for any numbers of unknowns and equations.
#pragma once

#include <utility>
#include <vector>

#include "courant/integrators/certificate/mobility.hpp"
#include "courant/integrators/certificate/natural_scaling.hpp"

namespace courant {

// What a search for a zero y of a map F found, or where it ended without one. `found` starts as false.
struct Zero {
  Zero() = default;
  // The state before a search: where it begins.
  explicit Zero(VectorXd start)
      : y(std::move(start)), uncertainty(VectorXd::Zero(y.size())), nominal(y.cwiseAbs()) {}

  bool found = false;
  VectorXd y;
  // NaturalScaling::defect at y, and F at y in these units. Where the search ended without a zero, Jᵀ F = 0. F is then
  // a left null vector of the Jacobian, and its entries tell which equations contradict each other.
  double defect = 0.0;
  VectorXd scaled_value;
  // Whether F and its derivatives are finite where the search began.
  bool is_finite = true;
  // How far the exact zero may be from y, entry by entry: the Gauss–Newton step from y, which is not made any more, and
  // the steps that rounding errors of F would cause. 0 where no zero was found.
  VectorXd uncertainty;
  VectorXd nominal;  // the largest |y_j| on the way, and at least that of the mobility
  int iterations = 0;
  std::vector<double> history;  // of defect
};

// Searches for a zero of F near `start`, by the method of Gauss and Newton with the safeguard of Levenberg and
// Marquardt. Equations may depend on each other. A step δ minimises
//
//   ‖S δ + F‖² + μ ‖cost ∘ δ‖²,   S = diag(r) J diag(c)
//
// with F and δ in natural units r, c.
//
// * Units are those of the largest Jacobian met so far, so that an unknown that is small by accident does not look like
//   one with a large unit.
// * μ begins with 0. The step is then that of the pseudo-inverse, which neglects singular values below about 10⁻⁹
//   (10⁻¹⁰ for more than 200 unknowns, where sparse factors of the normal equations are used). μ grows only where a
//   step makes neither ‖F‖ nor the next step shorter.
// * Where the zeros form a manifold whose normal space is the row space of J, convergence is that of Gauss–Newton
//   (Yamashita, Fukushima 2001), also where equations depend on each other.
// * A residual within the bound of its rounding error counts as 0. So does an unknown that is round-off of the step
//   that made it.
// * A zero is found where the defect is at most 10⁻¹⁰. The iteration goes on until the defect no longer falls.
//
// A search that finds no zero is tried once more with full steps, whether they help or not.
Zero find_zero(const LinearizableMap& map, const VectorXd& start, const Mobility& mobility);

// Whether every |F_i| is small next to the terms that it is the sum of. The bound of its rounding error tells how large
// these are; the units of a search do not, since they may stem from a point on its way, such as 3 V across a diode.
bool is_met(const Linearization& at);

}  // namespace courant
