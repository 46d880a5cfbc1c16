// Zeros of maps with more unknowns than conditions, or the reverse, near a given point.
#pragma once

#include <functional>
#include <vector>

#include "courant/integrators/ladder/natural_scaling.hpp"

namespace courant {

// What to move by preference.
struct Mobility {
  VectorXd cost;  // of a step by one natural unit of each unknown: a step δ minimises ‖cost ∘ δ‖
                  // among those that do as well
  Index frozen = 0;               // so many leading unknowns do not move at all
  VectorXd typical = VectorXd();  // sizes |y_j| below which a change of y_j is round-off in the
                                  // map; may be 0
  VectorXd offset = VectorXd();   // sizes of what the map adds to leading unknowns
  double noise = 1e-11;           // natural units below which what is left of an unknown is noise
  // The generic magnitude of the derivatives around the start, where it is known; may be empty.
  SparseMatrixXd magnitude = SparseMatrixXd();
  // Whether derivatives grow as those of exp (v/25 mV) do: they are measured by what they are at each point, not
  // around it, and steps are as short as they have to be for derivatives to stay of their size. Heeded
  // for up to 200 unknowns.
  bool has_exponentials = false;
  // Whether y may be gone to, as the domain of a chart allows; empty: anything may.
  std::function<bool(const VectorXd& y)> admits = {};
};

// Whether F and its derivatives are.
bool is_finite(const Linearization& at);

// A zero y of a map, or where its search ended: found starts as false.
struct Zero {
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
  // not made, and steps that roundings of F would make.
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

// A function to make least: its value, gradient and (Gauss–Newton) Hessian by the first unknowns.
struct Quadratic {
  double value;
  VectorXd gradient;
  SparseMatrixXd hessian;
};

// From the zero `at`, the zero nearby with the least value of the objective: tangential Newton
// steps, each brought back by find_zero, halved while they do not lead downhill.
Zero least_zero(const LinearizableMap& map,
                const std::function<Quadratic(const VectorXd& y)>& objective, const Zero& at,
                const Mobility& mobility);

// The part of `direction` in the kernel of S, orthogonal to the rest.
VectorXd kernel_part(const SparseMatrixXd& S, const VectorXd& direction);

}  // namespace courant
