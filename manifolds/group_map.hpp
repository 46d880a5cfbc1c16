// Maps of a Lie algebra of matrices to its group.
#pragma once

#include <functional>
#include <limits>
#include <string>

#include "courant/manifolds/matrix_algebra.hpp"

namespace courant {

// τ: g → G, smooth with τ(0) = 1 and dτ(0) = id: x ↦ x τ(v) is a retraction of G.
struct GroupMap {
  std::string name;
  std::function<ExprMatrix(const ExprVector& v)> map;           // τ(v)
  std::function<ExprMatrix(const ExprVector& v)> reciprocal;    // τ(v)⁻¹
  std::function<ExprVector(const ExprMatrix& X)> inverse = {};  // v of τ(v); empty: no formula
  bool is_exponential = false;
  // τ is injective on {v : extent(v) < 1}, which contains {‖v‖ < injectivity_radius}.
  double injectivity_radius = std::numeric_limits<double>::infinity();
  std::function<double(const VectorXd& v)> extent = {};
  // v ↦ τ(-v/2)⁻¹ τ(v/2) is injective on {‖v‖ < midpoint_radius}.
  double midpoint_radius = std::numeric_limits<double>::infinity();
};

// exp v̂. With a power law of g it is, c_j the Stumpff functions at s = s(v),
//
//   exp v̂ = Σ_{j<k} v̂^j/j! + c_k v̂^k + c_{k+1} v̂^{k+1}
//
// for se(2), su(2), sl(2), Galilei's group and, with a finite sum, nilpotent algebras. Its inverse is then, with
// S = (Y - Y⁻¹)/2 and the angle φ, cos φ of the trace of Y, tr S² = -multiplicity sin² φ,
//
//   v̂ = S + (φ - sin φ)/sin³ φ · (-S³)      for k ≤ 3 and eigenvalues that are balanced,
//
// the finite sum of the logarithm for nilpotent algebras, and λ/(e^λ - 1) (Y - 1) where v̂² = λ v̂ with a linear form
// λ, as for the affine maps of the line.
//
// Without a power law it is r(v̂/16)^16 with the diagonal Padé approximant r of degree 6. For ‖v̂‖ ≤ 8 this is within
// 1e-15 of exp v̂, next to the size of the factors. It is in G at any length where G leaves forms invariant, as sp(2n).
// There is no formula for the inverse, and the injectivity radius is no more than Newton's method finds.
//
// Injective where every eigenvalue of v̂ has |Im λ| < π.
GroupMap exponential_map(const MatrixAlgebra& g);

// cay v̂ = (1 - v̂/2)⁻¹ (1 + v̂/2), for groups that leave forms invariant. Its inverse is
// 2 (Y - 1)(Y + 1)⁻¹; smooth and injective where every eigenvalue has |Re λ| < 2. cay(v/2) is the root of
// cay(v/2)² whose eigenvalues have positive real parts where |λ| < 4. Throws
// std::domain_error if it leads out of the group, as that of sl(3).
GroupMap cayley_map(const MatrixAlgebra& g);

// exp(v_1 B_1) exp(v_2 B_2) … exp(v_n B_n), canonical coordinates of the second kind. No formula for the inverse; the
// injectivity radius is a bound that is proven, and much less than the truth: r with
// (e^{ρ r} - 1) κ = σ, where ρ² = Σ ‖B_a‖², κ² = Σ ‖B_a‖_F² and σ is the least singular value of v ↦ v̂.
GroupMap second_kind_map(const MatrixAlgebra& g);

}  // namespace courant
