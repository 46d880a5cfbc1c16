// Rotations of R³: the formulas that SO(3), SE(3) and their discretization maps share.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant {

// v̂, the skew matrix with v̂ w = v × w, and its inverse on skew matrices; vee takes the skew part of
// any 3 × 3 matrix.
ExprMatrix hat(const ExprVector& v);
ExprVector vee(const ExprMatrix& A);

// exp v̂ = 1 + c₁ v̂ + c₂ v̂², c_k = c_k(‖v‖²) the Stumpff functions (Rodrigues).
ExprMatrix rotation_exponential(const ExprVector& v);
// v with exp v̂ = R, ‖v‖ ≤ π; smooth for rotations by less than π, and accurate up to there because
// it goes through the quaternion.
ExprVector rotation_logarithm(const ExprMatrix& R);

// cay v̂ = (1 - v̂/2)⁻¹ (1 + v̂/2) = 1 + (v̂ + v̂²/2) / (1 + ‖v‖²/4): the rotation about v by
// 2 arctan(‖v‖/2).
ExprMatrix rotation_cayley(const ExprVector& v);
// Its inverse, for rotations by less than π.
ExprVector rotation_inverse_cayley(const ExprMatrix& R);

// (c, s) = (cos φ/2, sin φ/2 · axis) of the rotation R by φ, c ≥ 0: a unit quaternion. From the
// column of 4 q qᵀ (linear in R) with the largest diagonal entry, which is at least 1, so that
// nothing is divided by a small number whatever φ is.
ExprVector quaternion(const ExprMatrix& R);
// The rotation of a unit quaternion.
ExprMatrix rotation_of(const ExprVector& quaternion);

// The rotation matrix nearest to A in the Frobenius norm. Throws std::domain_error unless det A >
// 0.
MatrixXd nearest_rotation(const MatrixXd& A);

}  // namespace courant
