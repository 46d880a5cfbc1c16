// Method 1: discretize first.
#pragma once

#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/integrators/step/programmed.hpp"

namespace courant {

class StageStep;

// The discrete system (S₀)_d^h = {(x₀, x₁) ∈ M × M : (1/h) R_d⁻¹(x₀, x₁) ∈ S} of an implicit system
// as a one-step method (Option 1 of Section 5.2, equations (3), (12), (28), (30), (36)-(38)): a
// StageStep with the equations of the system.
class DiscretizeFirst final : public Integrator, public Programmed {
 public:
  struct Options {
    Backend backend = Backend::automatic;
  };

  // `map` on the manifold of `system`; throws std::invalid_argument otherwise.
  DiscretizeFirst(std::shared_ptr<const ImplicitSystem> system,
                  std::shared_ptr<const DiscretizationMap> map, const Options& options);
  DiscretizeFirst(std::shared_ptr<const ImplicitSystem> system,
                  std::shared_ptr<const DiscretizationMap> map)
      : DiscretizeFirst(std::move(system), std::move(map), Options()) {}

  std::string name() const override { return "discretize-first"; }
  int order() const override;
  bool is_symmetric() const override;
  // A symplectic map takes the Lagrangian submanifold S to one of T*Q × T*Q, the graph of a
  // symplectic map (Section 5.1.1): a claim about the two together. Of other systems, those with
  // damping say, nothing is known.
  std::optional<bool> is_symplectic() const override;
  bool is_native() const override;
  StepProgram program() const override;

 private:
  std::unique_ptr<Stepper> do_stepper() const override;
  std::vector<StepFormulas> do_formulas() const override;
  std::shared_ptr<const StepDifferential> do_differential() const override;

  std::shared_ptr<const StageStep> step_;
};

}  // namespace courant
