// The representations of a linear Dirac structure D ⊂ V ⊕ V*, dim V = n, as matrices of any kind.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace courant {

using Eigen::Index;

// D = {(v, α) : F v + E α = 0}. Dirac if and only if F Eᵀ + E Fᵀ = 0 and [F E] has rank n.
template <class Matrix>
struct KernelRepresentation {
  Matrix F, E;  // k × n
};

// D = {(F λ, E λ) : λ}. Dirac if and only if Fᵀ E + Eᵀ F = 0 and [F; E] has rank n.
// The kernel representation (F, E) has the image representation (Eᵀ, Fᵀ), because D = D^⊥.
template <class Matrix>
struct ImageRepresentation {
  Matrix F, E;  // n × k
};

// D = {(v, α) : v = J α + G λ, Gᵀ α = 0 for some λ}, J skew: the constrained input-output form. It
// is a port-Hamiltonian system with closed ports (equation (23)); G spans D ∩ V. Every D has it.
template <class Matrix>
struct ConstrainedRepresentation {
  Matrix J, G;  // n × n, n × m
};

// D = {(v, α) : (v₁, α₂) = M (α₁, v₂)}, M skew, for a partition of the coordinates in two: the
// hybrid input-output form. Every D has it for some partition (Bloch & Crouch, Representations of
// Dirac structures on vector spaces and nonlinear L-C circuits, 1999).
template <class Matrix>
struct HybridRepresentation {
  std::vector<Index> effort_driven;  // coordinates 1: α is given, v results
  std::vector<Index> flow_driven;    // coordinates 2: v is given, α results
  Matrix M;                          // n × n, rows and columns in the order 1, 2
};

// D = {(u, α) : u ∈ F, α(v) = ω(u, v) for all v ∈ F}: a subspace F ⊂ V by a basis f_i (columns),
// and ω_ij = ω(f_i, f_j), skew (Proposition 2.3). Every D has it, with F its projection F_D on V.
struct FormOnSubspace {
  Eigen::MatrixXd F, omega;  // n × r, r × r
};

// D = {(v, α) : α ∈ F, β(v) = Λ(β, α) for all β ∈ F}: a subspace F = F^(*) ⊂ V* by a basis φ_i
// (columns), and Λ_ij = Λ(φ_i, φ_j), skew (Theorem 2.5 at a point). Every D has it, with F its
// projection on V*.
struct BivectorOnSubspace {
  Eigen::MatrixXd F, lambda;  // n × r, r × r
};

}  // namespace courant
