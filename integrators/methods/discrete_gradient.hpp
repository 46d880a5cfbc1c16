// Discrete gradients: steps with an exact balance of energy.
#pragma once

#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/integrators/methods/discrete_differential.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/integrators/step/programmed.hpp"
#include "courant/structures/energy_system.hpp"

namespace courant {

class StageStep;

// Method 1 with a discrete differential of E in the place of dE(x̄) (Section 7.1, end): with the
// equations G of an EnergySystem and (x̄, h v) = R_d⁻¹(x₀, x₁),
//
//   G(x̄, v, α, z, t̄; x₁, t₁) = 0,   ⟨α, h v⟩ = E(x₁, z, t̄) - E(x₀, z, t̄)
//
// Where E is H, or H + Σ λ_b φ_b with φ_b = 0 at both ends, and H does not depend on t, each step has
//
//   H(x₁) - H(x₀) = h Σ supplied - h Σ dissipated
//
// up to round-off, with the powers of the system at (x̄, v, α, z, t̄): what (28)-(31) have in the
// place of the left side is ⟨dH, R_d⁻¹(x₀, x₁)⟩. A Hamiltonian of t adds what time changes in it at
// x₀ before t̄ and at x₁ after it, see StepEnergies.
//
// Where E has velocities w, as ⟨p, w⟩ - L, it is explicit_energy() in the place of E, and z has the w of x₁.
//
// Conditions c(x) = 0 that are ∂E/∂λ hold at x₁. Those that contain α, as of closed ports 0 = Bᵀα, and
// nonholonomic ones hold of α and v: x₁ is as near to M_f as the step is good.
class DiscreteGradient final : public Integrator, public Programmed {
 public:
  struct Options {
    Backend backend = Backend::automatic;
    // Nominal sizes of the Ñ components of tangent vectors (natural_units); empty: all 1.
    VectorXd units = VectorXd();
  };

  // `map` on the manifold of `system`. Throws std::invalid_argument otherwise, and for a system that is
  // not an EnergySystem with an explicit_energy().
  DiscreteGradient(std::shared_ptr<const ImplicitSystem> system,
                   std::shared_ptr<const DiscretizationMap> map,
                   std::shared_ptr<const DiscreteDifferential> differential,
                   const Options& options);
  DiscreteGradient(std::shared_ptr<const ImplicitSystem> system,
                   std::shared_ptr<const DiscretizationMap> map,
                   std::shared_ptr<const DiscreteDifferential> differential)
      : DiscreteGradient(std::move(system), std::move(map), std::move(differential), Options()) {}

  std::string name() const override { return "discrete-gradient"; }
  int order() const override;
  bool is_symmetric() const override;
  bool has_exact_energy() const override { return true; }
  bool is_native() const override;
  StepProgram program() const override;

 private:
  std::unique_ptr<Stepper> do_stepper() const override;
  std::vector<StepFormulas> do_formulas() const override;
  std::shared_ptr<const StepDifferential> do_differential() const override;

  std::shared_ptr<const DiscreteDifferential> differential_;
  std::shared_ptr<const StageStep> step_;
};

}  // namespace courant
