// Zeros of maps with more unknowns than conditions, or the reverse, near a given point.
#pragma once

#include <utility>
#include <vector>

#include "courant/integrators/certificate/mobility.hpp"
#include "courant/integrators/certificate/natural_scaling.hpp"

namespace courant {

// A zero y of a map, or where its search ended: found starts as false.
struct Zero {
  Zero() = default;
  // Before a search: where it begins, with its sizes and nothing uncertain.
  explicit Zero(VectorXd start)
      : y(std::move(start)), uncertainty(VectorXd::Zero(y.size())), reach(y.cwiseAbs()) {}

  bool found = false;
  VectorXd y;
  // NaturalScaling::defect at y, and F there in these units. Where no zero was found Jᵀ F = 0: F is
  // itself a left null vector of the Jacobian, so that its entries tell which equations contradict
  // each other.
  double defect = 0.0;
  VectorXd scaled_value;
  // Whether F and its derivatives are finite where the search began.
  bool is_finite = true;
  // How far from y, entry by entry, the zero that is meant may be: the Gauss–Newton step that was
  // not made, and steps that roundings of F would make. 0 where no zero was found.
  VectorXd uncertainty;
  VectorXd reach;  // the largest |y_j| that was met, `typical` included
  int iterations = 0;
  std::vector<double> history;  // of defect
};

// Gauss–Newton with the Levenberg–Marquardt safeguard from `start`: each step δ minimises
// ‖S δ + F‖² + μ ‖cost ∘ δ‖² with S = diag(r) J diag(c) in natural units: those of the largest
// Jacobian met so far, so that an unknown that is small by accident does not look like a large
// unit. μ starts at 0, the pseudo-inverse that neglects singular values below about 10⁻⁹ (10⁻¹⁰ for
// more than 200 unknowns, where sparse factors of the normal equations are used), and grows only
// where a step reduces neither ‖F‖ nor the next step. The convergence is that of Gauss–Newton
// wherever the zeros form a manifold whose normal space is the row space of J (Yamashita, Fukushima
// 2001), redundant equations or not. Residuals within the bounds of their rounding errors count as 0,
// and so do unknowns that a step leaves at its own round-off. Accepted: defect ≤ 10⁻¹⁰, and iterated on until it no longer
// falls.
Zero find_zero(const LinearizableMap& map, const VectorXd& start, const Mobility& mobility);

// Whether every |F_i| is small next to the terms that it is the sum of, which the bound of its rounding error tells.
// Units that a search met on its way, as those of 3 V across a diode, do not enter.
bool is_met(const Linearization& at);

}  // namespace courant
