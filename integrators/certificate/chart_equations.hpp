// ChartEquations: the equations of an implicit system in a chart, traced.
#pragma once

#include <memory>

#include "courant/core/expressions/function.hpp"
#include "courant/core/solve/exponentials.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// F(x, v, z, t) with x = R_{x₀}(B ξ) and v = C(x) dx/ds, for every x₀ ∈ M and every basis B of T_{x₀}M: what derivative
// arrays are evaluated by. Tracing a system takes as long as many evaluations, so that all that look at one system share
// these. Immutable.
class ChartEquations {
 public:
  // Throws std::invalid_argument if the system is null.
  explicit ChartEquations(std::shared_ptr<const ImplicitSystem> system);

  const std::shared_ptr<const ImplicitSystem>& system() const { return system_; }
  // (xi, xi', z; x0, basis, t) ↦ F, with the Jacobian by the first three. Where the basis is the identity, it has no
  // entries.
  const Function& equations() const { return equations_; }
  const Function& state() const { return state_; }  // the same ↦ (x, v)
  // Of F as equations for (xi', z); xi, x0, basis, t. None where F has no exponentials.
  const Exponentials& of_rates() const { return of_rates_; }

  // F is affine in (x, v, z) with constant coefficients.
  bool has_constant_jacobian() const { return constant_jacobian_; }
  // Whether t stands in F.
  bool depends_on_time() const { return depends_on_time_; }
  // F contains exp, sinh or cosh.
  bool has_exponentials() const { return exponentials_; }

 private:
  std::shared_ptr<const ImplicitSystem> system_;
  Function equations_, state_;
  Exponentials of_rates_;
  bool constant_jacobian_ = false, depends_on_time_ = false, exponentials_ = false;
};

}  // namespace courant
