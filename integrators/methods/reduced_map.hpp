// The reduced map: Method 1 on a Lie group, on the dual of its Lie algebra.
#pragma once

#include <memory>

#include "courant/integrators/maps/cotangent_lift.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/structures/dirac_system.hpp"
#include "courant/structures/lie_group.hpp"
#include "courant/structures/lie_poisson.hpp"

namespace courant {

class EquationSystem;

// Method 1 with the cotangent lift of a left-invariant discretization map R_d on G, for a
// left-invariant system on T*G, or one on T*G × V* whose energy G leaves invariant, reduced to
// (g ⋉ V)* = {(μ, a)}: the Euler–Poincaré and Lie–Poisson systems of EulerPoincare.
//
// Everything is the same at every point of G as at the unit e. With (q̄, v, q₁) the points of R_d
// that begin at e, the covectors (p̄, π) = (T R_d)ᵀ(-μ₀, μ₁) at (q̄, v), and the matrices A of the
// representation of G on V
//
//   v = h ∂E/∂μ(p̄, ā),   π = h (f - ρ*_{∂E/∂a} ā)
//   ā = A(q̄)ᵀ a₀,   a₁ = A(q₁)ᵀ a₀
//
// with all that acts on μ from outside in f. Without V and f, π = 0 and
//
//   μ₁ = Ad*_{q₁} μ₀
//
// (J. E. Marsden, S. Pekarsky, S. Shkoller, Nonlinearity 12 (1999) 1647; N. Bou-Rabee,
// J. E. Marsden, Found. Comput. Math. 9 (2009) 197). For SO(3) and the Cayley midpoint q₁ is
// cay(v/2)², and μ₁ is μ₀ turned by it.
//
// The lift is symplectic on T*G, and G takes solutions to solutions; so without f
//
//   the step is a Poisson map of (g ⋉ V)*, for any E
//   it stays on its coadjoint orbit: every Casimir is kept, quadratic or not
//
// both to round-off. Where the state has the attitude x ∈ G (LiePoisson::group), x₁ = x₀ q₁ is
// reconstructed, and (x, μ) are those of Method 1 on T*G; μ and a do not depend on x. Systems of
// Sign::plus, right-invariant ones, are those with v = -h ∂E/∂μ.
class ReducedMap final : public Integrator {
 public:
  struct Options {
    Backend backend = Backend::automatic;
  };

  // `system` has a LiePoisson structure, and what acts on it acts on μ alone; `map` is on a group
  // with the algebra that acts, left-invariant, with DiscretizationMap::has_start. Throws std::invalid_argument
  // otherwise, and where the representation is not that of a known action (group_action).
  ReducedMap(std::shared_ptr<const DiracSystem> system,
             std::shared_ptr<const DiscretizationMap> map, const Options& options);
  ReducedMap(std::shared_ptr<const DiracSystem> system,
             std::shared_ptr<const DiscretizationMap> map)
      : ReducedMap(std::move(system), std::move(map), Options()) {}

  std::string name() const override { return "reduced"; }
  int order() const override { return map_->order(); }
  bool is_symmetric() const override { return map_->is_symmetric(); }
  bool is_native() const override;

 private:
  class Differential;
  class Trajectory;
  struct Trace;

  std::unique_ptr<Stepper> do_stepper() const override;
  std::vector<StepFormulas> do_formulas() const override;
  std::shared_ptr<const StepDifferential> do_differential() const override;

  std::shared_ptr<const DiracSystem> reduced_;  // the system
  std::shared_ptr<const LiePoisson> structure_;
  std::shared_ptr<const DiscretizationMap> map_;
  GroupAction action_;
  std::vector<Index> contained_;  // the coordinates of x₀ that the equations contain
  std::shared_ptr<const EquationSystem> equations_;  // y = (w, Δμ, z); x₀, h, t ↦ residual
  Function whole_;       // the same without elimination, unless it is affine
  Function advance_;     // the same ↦ (μ₁, a₁, x₁), its rate at the stage, (p̄, ā, x̄)
  Function rate_;        // x₀, z, t ↦ v/h and dμ/dt there
  Function constraint_;  // of RoundOffProjection
};

}  // namespace courant
