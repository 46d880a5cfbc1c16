// Method 2: the continuous constraint algorithm first, then a discretization on M_f.
#pragma once

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/integrators/step/kinetic_projector.hpp"
#include "courant/integrators/step/programmed.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

struct ConstrainFirstFunctions;

// S_f over M_f discretized with R_d^{M_f} = (P × P) ∘ R_d ∘ Ti (Option 2 of Section 5.2,
// Proposition 7.3, Sections 6.2, 7.2 and 8.2):
//
//   R_d⁻(x̄, h v) = R_{x_k}(B W(x_k) μ),   (x̄, v) ∈ S_f,      then   x_{k+1} = P(R_d⁺(x̄, h v))
//
// in one solve for (x̄, v, z, jets, μ). (x̄, v) ∈ S_f means: the equations of the system and those of
// their time derivatives that the ladder needed. All of it is written in the chart at x_k. The
// points x_k are on M_f to round-off, hidden constraints included.
class ConstrainFirst final : public Integrator, public Programmed {
 public:
  struct Options {
    Backend backend = Backend::automatic;
    // Solves the equations that the ladder found to follow from others too, by least squares. Else steps do
    // without them, and one after which they do not hold is made again with all of them.
    bool keeps_all_equations = false;
  };

  // `ladder` of `system` (regular, or gauge: then the step of least change is taken); `map` on its
  // manifold. Throws std::invalid_argument otherwise.
  ConstrainFirst(std::shared_ptr<const ImplicitSystem> system, const ConstraintLadder& ladder,
                 std::shared_ptr<const DiscretizationMap> map,
                 std::shared_ptr<const Projector> projector, const Options& options);
  ConstrainFirst(std::shared_ptr<const ImplicitSystem> system, const ConstraintLadder& ladder,
                 std::shared_ptr<const DiscretizationMap> map,
                 std::shared_ptr<const Projector> projector)
      : ConstrainFirst(std::move(system), ladder, std::move(map), std::move(projector), Options()) {
  }
  // With usual_projector().
  ConstrainFirst(const std::shared_ptr<const ImplicitSystem>& system,
                 const ConstraintLadder& ladder, std::shared_ptr<const DiscretizationMap> map)
      : ConstrainFirst(system, ladder, std::move(map), usual_projector(system, ladder)) {}

  std::string name() const override;
  int order() const override;
  // With gauge freedom the step of least change is not that of the way back.
  bool is_symmetric() const override;
  // M_f with the pulled-back form is in general not preserved (Proposition 6.3): known only where
  // there is nothing to constrain, and the system is Lagrangian.
  std::optional<bool> is_symplectic() const override;
  bool is_native() const override;
  StepProgram program() const override;

 private:
  class Differential;
  class Trajectory;

  std::unique_ptr<Stepper> do_stepper() const override;
  // Exact but for the turning of W on curved spaces, by differences of order 8 to 1e-12 of ‖μ‖.
  std::shared_ptr<const StepDifferential> do_differential() const override;
  std::vector<StepFormulas> do_formulas() const override;

  std::shared_ptr<const ConstrainFirstFunctions> functions_;
};

}  // namespace courant
