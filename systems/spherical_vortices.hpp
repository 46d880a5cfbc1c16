// Point vortices on the sphere.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "courant/structures/implicit_system.hpp"

namespace courant {

// n vortices of strengths Γ_i at points x_i of the unit sphere, x = (x_0, …, x_{n-1}) ∈ (S²)ⁿ ⊂
// R³ⁿ:
//
//   H(x) = 1/(4π) Σ_{i<j} Γ_i Γ_j log ‖x_i - x_j‖²,      Γ_i ẋ_i = x_i × ∂H/∂x_i
//   ẋ_i = 1/(2π) Σ_{j≠i} Γ_j x_j × x_i / ‖x_i - x_j‖²
//
// smooth where no two vortices are at one place; near a point of the sphere these are the vortices
// of PointVortices in its tangent plane. Rotations are symmetries, with the moment map Σ Γ_i x_i.
// Two vortices turn about it at the rate ‖Σ Γ_i x_i‖/(2π ‖x_0 - x_1‖²). The strengths need not add
// up to zero: that adds a constant vorticity to the sphere, which moves nothing. Reference: P. K.
// Newton, The N-Vortex Problem (2001), chapter 4.
class SphericalVortices {
 public:
  // Throws std::invalid_argument if a strength is zero or not finite.
  explicit SphericalVortices(VectorXd strengths);

  Index count() const { return strengths_.size(); }
  // H(x), of n points x_i ∈ R³ one after the other.
  Expr hamiltonian(const ExprVector& x) const;
  // Σ Γ_i x_i, size 3.
  ExprVector moment(const ExprVector& x) const;

  // On the product of n spheres, of H and the bivector v_i = x_i × α_i / Γ_i.
  std::shared_ptr<const ImplicitSystem> system() const;

  // The first two vortices of the configuration x that are at one place.
  std::optional<std::pair<Index, Index>> coinciding(const VectorXd& x) const;

 private:
  VectorXd strengths_;
};

}  // namespace courant
