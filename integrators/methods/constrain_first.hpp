// Method 2: the continuous constraint algorithm first, then a discretization on M_f.
#pragma once

#include "courant/core/solve/equation_system.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/integrators/step/kinetic_projector.hpp"
#include "courant/integrators/step/moving_conormals.hpp"
#include "courant/integrators/step/open_jets.hpp"
#include "courant/integrators/step/step_program.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

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

  std::string name() const override { return "constrain-first"; }
  int order() const override { return map_->order(); }
  // With gauge freedom the step of least change is not that of the way back.
  bool is_symmetric() const override { return gauge_dimension_ == 0 && map_->is_symmetric(); }
  // M_f with the pulled-back form is in general not preserved (Proposition 6.3): known only where
  // there is nothing to constrain, and the system is Lagrangian.
  std::optional<bool> is_symplectic() const override {
    if (codimension_ == 0 && map_->is_symplectic().value_or(false) &&
        system()->is_lagrangian().value_or(false))
      return true;
    return std::nullopt;
  }
  bool is_native() const override { return equations_.is_native(); }
  StepProgram program() const override;

 private:
  class Differential;
  class Trajectory;
  class Projection;
  struct Trace;
  // Of S_f: equations that follow from the others, and what is open in those that are left.
  struct Omissions {
    std::vector<Index> redundant;  // ascending
    OpenJets open;
    VectorXd held;  // values of open.unknowns
  };

  // Whether W is the same at every x, or there is nothing to project.
  bool has_fixed_directions() const { return codimension_ == 0 || fixed_directions_.size() > 0; }

  std::unique_ptr<Stepper> do_stepper() const override;
  // Exact but for the turning of W on curved spaces, by differences of order 8 to 1e-12 of ‖μ‖.
  std::shared_ptr<const StepDifferential> do_differential() const override;
  std::vector<StepFormulas> do_formulas() const override;

  std::shared_ptr<const DiscretizationMap> map_;
  std::shared_ptr<const Projector> projector_;
  std::shared_ptr<const ConstraintLadder> ladder_;
  std::vector<int> differentiations_;  // of each equation of the system
  bool keeps_all_equations_;
  Index codimension_;  // d = dim M - dim M_f
  Index gauge_dimension_;
  // What steps do without, known once the formulas were traced.
  std::optional<Omissions> omitted_;
  Index blocks_;              // tangent blocks of the unknowns: ξ, ξ', …
  Index auxiliaries_;         // z, z', …
  EquationSystem equations_;  // (ξ, ξ', …, z, …, μ); x₀, basis, W, h, t  ↦ residual of the step
  Function whole_;            // the same without elimination, unless it is affine
  Function advance_;          // the same ↦ R_d⁺(x̄, h v), x̄, v
  EquationSystem
      projection_;  // (ξ, ξ', …, z, …, μ); x_guess, basis, W, x_near, t ↦ residual of x ∈ M_f,
                    // R_x(W μ) = x_near
  Function projected_;  // the same ↦ x, v, z
  // The same ↦ equations that steps do without, with their Jacobian; what is held of z, by its place.
  Function redundant_;
  std::vector<std::pair<Index, double>> held_z_;
  Function basis_;       // of MovingBasis
  Function constraint_;  // of RoundOffProjection
  Function shift_;       // (near, s) ↦ R_near(Π s)
  Function corrected_shift_;  // (near, s, x₀, x) ↦ what leads to x if s leads to x₀, to first order
  MovingConormals::Functions conormals_;
  std::vector<MatrixXd> references_;  // of the conormals, the first those at the ladder's point
  Function span_;                     // of MovingDirections
  MatrixXd fixed_directions_;         // W, where it is the same at every x; else empty
};

}  // namespace courant
