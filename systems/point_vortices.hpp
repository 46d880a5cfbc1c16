// Point vortices in the plane (Section 6 of the paper).
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "courant/structures/dirac_system.hpp"

namespace courant {

// n vortices of strengths Γ_i at (x_i, y_i), q = (x_0, …, x_{n-1}, y_0, …, y_{n-1}) ∈ R²ⁿ:
//
//   H(q) = 1/(4π) Σ_{i<j} Γ_i Γ_j log l_ij²,   l_ij² = (x_i - x_j)² + (y_i - y_j)²
//   α(q) = ½ Σ_i Γ_i (x_i dy_i - y_i dx_i)
//
// H is equation (9) with each pair once, α equation (8); both are smooth where no two vortices are
// at one place. The equations of motion are (6).
class PointVortices {
 public:
  // Throws std::invalid_argument if a strength is zero or not finite: its equation would determine
  // nothing.
  explicit PointVortices(VectorXd strengths);

  Index count() const { return strengths_.size(); }
  // H(q), and α(q) by its 2n components.
  Expr hamiltonian(const ExprVector& q) const;
  ExprVector alpha(const ExprVector& q) const;

  // On T*R²ⁿ, of the singular Lagrangian L = ⟨α(q), q̇⟩ - H(q) (equation (7)). Points (q, p).
  std::shared_ptr<const DiracSystem> lagrangian_form() const;
  // On R²ⁿ, of H and the bivector with Γ_i ẋ_i = -∂H/∂y_i, Γ_i ẏ_i = ∂H/∂x_i. Points q.
  std::shared_ptr<const ImplicitSystem> hamiltonian_form() const;

  // The first two vortices of the configuration q that are at one place.
  std::optional<std::pair<Index, Index>> coinciding(const VectorXd& q) const;

 private:
  VectorXd strengths_;
};

}  // namespace courant
