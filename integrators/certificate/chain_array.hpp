// ChainArray: a discrete system repeated along a chain of points.
#pragma once

#include <memory>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/certificate/prolongation.hpp"
#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// The equations S_d ⊂ M × M of a system with a discretization map, for each link of a chain
// x_0, x_1, …, x_{k+1}:
//
//   (x̄_i, h v_i) = R_d⁻¹(x_i, x_{i+1}),    F(x̄_i, v_i, z_i, t_i) = 0,    i = 0 … k
//
// with t_i = t + (i + s) h, s the stage time of R_d. Unknowns are the chart coordinates
// x_i = R_{x₀}(B ξ_i) of all points in the chart at one origin, and z_i: what time derivatives are
// to a DerivativeArray, shifted copies are here. Immutable.
class ChainArray final : public Prolongation {
 public:
  // Throws std::invalid_argument if system and map are not on one manifold, h = 0, or x0 has the
  // wrong size.
  ChainArray(std::shared_ptr<const ImplicitSystem> system,
             std::shared_ptr<const DiscretizationMap> map, double h, double t, const VectorXd& x0);

  // x_i of the chain y.
  VectorXd point(const VectorXd& y, Index i) const;
  const LinearMap<double>& basis() const { return basis_; }  // B, Ñ × n

  bool has_constant_jacobian() const override { return false; }

 private:
  std::vector<VectorXd> arguments(const VectorXd& y, Index i) const;
  std::vector<VectorXd> arguments_error(const VectorXd& uncertainty, Index i) const;
  Linearization do_linearize(const VectorXd& y, const VectorXd& uncertainty,
                             Index k) const override;
  VectorXd do_residual(const VectorXd& y, Index k) const override;

  std::shared_ptr<const ImplicitSystem> system_;
  std::shared_ptr<const DiscretizationMap> map_;
  Function link_;  // (ξ_i, ξ_{i+1}, z_i; x0, basis, t_i) ↦ F, with Jacobian by the first three
  double h_, t_;
  VectorXd origin_;
  LinearMap<double> basis_;
};

}  // namespace courant
