// Verlet: half a step of a discretization map, then half a step of its adjoint.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/integrators/methods/verlet_trace.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/integrators/step/programmed.hpp"

namespace courant {

struct ExplicitVerlet;
class ExplicitVerletSteps;
class VerletSteps;

// The composition of relations
//
//   S_d*^{h/2} ∘ S_d^{h/2},     S_d^h = {(x₀, x₁) : (1/h) R_d⁻¹(x₀, x₁) ∈ S},
//
// where S_d* is that of the adjoint map, (x₀, x₁) ↦ R_d*(x, v) = (R⁺(x, -v), R⁻(x, -v)). Symmetric, and of order 2 for
// any R_d of order 1; symplectic where R_d is and S is Lagrangian. With the cotangent lift of Theta(0), whose adjoint
// is that of Theta(1), and H = T(p) + V(q) it is the method of Störmer and Verlet,
//
//   p_m = p₀ - (h/2) V'(q₀),   q₁ = q₀ + h T'(p_m),   p₁ = p_m - (h/2) V'(q₁).
//
// Where the equations give a step explicitly, as here, it is one compiled function (is_explicit()); where they do once
// multipliers are known, these alone are solved for, λ by Newton's method and μ, below, by linear equations; else both
// halves are solved for together.
//
// With constraints c(q) = 0 it is a map of M_f: the composition, restricted to M_f × M_f. The first half has c(q₀) = 0,
// which says nothing of its multiplier: that is what leads to c(q₁) = 0, an equation of the second half. The multiplier
// of the second half changes p₁ alone, along conormals of {c = 0}, and nothing in S_d* ∘ S_d says by how much: there
// the constraint algorithm has to be asked, and x₁ ∈ M_f, the hidden constraint dc/dt = 0, decides. In this way
//
//   p_m = p₀ - (h/2) (V'(q₀) + c'(q₀)ᵀλ),   q₁ = q₀ + h T'(p_m),   c(q₁) = 0,
//   p₁ = p_m - (h/2) (V'(q₁) + c'(q₁)ᵀμ),   c'(q₁) T'(p₁) = 0:
//
// RATTLE. Of the solutions for λ the one next to the last λ is taken. It preserves ω on M_f, which Method 2 with the
// projected midpoint rule does not. References: H. C. Andersen, J. Comput. Phys. 52 (1983); R. I. McLachlan, K. Modin,
// O. Verdier, M. Wilkins, Geometric generalisations of SHAKE and RATTLE, Found. Comput. Math. 14 (2014).
class Verlet final : public Integrator, public Programmed {
 public:
  struct Options {
    Backend backend = Backend::automatic;
  };

  // `ladder` of `system`, regular; `map`, R_d, on its manifold, with an inverse. Throws std::invalid_argument
  // otherwise, and where there are constraints other than on positions, or redundant ones.
  Verlet(std::shared_ptr<const ImplicitSystem> system, const ConstraintLadder& ladder,
         std::shared_ptr<const DiscretizationMap> map, const Options& options);
  Verlet(std::shared_ptr<const ImplicitSystem> system, const ConstraintLadder& ladder,
         std::shared_ptr<const DiscretizationMap> map)
      : Verlet(std::move(system), ladder, std::move(map), Options()) {}

  std::string name() const override;  // "verlet"; with constraints "rattle"
  int order() const override { return 2; }
  bool is_symmetric() const override { return true; }
  std::optional<bool> is_symplectic() const override;
  bool is_native() const override;
  // Whether a step solves nothing, not for multipliers either.
  bool is_explicit() const;
  // Of explicit steps; throws std::invalid_argument for others.
  StepProgram program() const override;
  const std::shared_ptr<const DiscretizationMap>& map() const { return map_; }  // R_d

  // Of the composition of steps of these parts of h, if they are explicit but for multipliers; else null.
  std::unique_ptr<Stepper> composed(std::span<const double> parts, const std::string& name) const;

 private:
  class Differential;

  std::unique_ptr<Stepper> do_stepper() const override;
  std::vector<StepFormulas> do_formulas() const override;
  // Of explicit steps.
  std::shared_ptr<const StepDifferential> do_differential() const override;

  bool has_constraints() const;
  std::optional<ExplicitVerlet> explicit_formulas() const;  // of a system without constraints
  VerletTrace trace(VerletTrace::Unknowns kind) const;

  std::shared_ptr<const DiscretizationMap> map_;
  std::shared_ptr<const ConstraintLadder> ladder_;
  // One of them.
  std::shared_ptr<const ExplicitVerletSteps> explicit_;
  std::shared_ptr<const VerletSteps> solved_;
};

}  // namespace courant
