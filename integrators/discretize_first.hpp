// Method 1: discretize first.
#pragma once

#include "courant/core/equation_system.hpp"
#include "courant/integrators/integrator.hpp"
#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

// The discrete system (S₀)_d^h = {(x₀, x₁) ∈ M × M : (1/h) R_d⁻¹(x₀, x₁) ∈ S} of an implicit system
// as a one-step method (Option 1 of Section 5.2, equations (3), (12), (28), (30), (36)-(38)).
//
// With a map that has a closed inverse the unknowns of a step are the coordinates ξ of a tangent
// vector at x₀ and z:
//   F(x̄, v / h, z, t̄) = 0,   (x̄, v, x₁) = from_start(x₀, B ξ), so that (x̄, v) = R_d⁻¹(x₀, x₁);
// otherwise (x̄, v, z), with R_d⁻(x̄, h v) = x₀ and then x₁ = R_d⁺(x̄, h v).
// Where redundant equations or undetermined z make the matrix singular or oblong, steps are solved
// by least squares.
class DiscretizeFirst final : public Integrator {
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
  int order() const override { return map_->order(); }
  bool is_symmetric() const override { return map_->is_symmetric(); }
  // A symplectic map takes the Lagrangian submanifold S to one of T*Q × T*Q, the graph of a
  // symplectic map (Section 5.1.1): a claim about the two together. Of other systems, those with
  // damping say, nothing is known.
  std::optional<bool> is_symplectic() const override {
    if (map_->is_symplectic().value_or(false) && system()->is_lagrangian().value_or(false))
      return true;
    return std::nullopt;
  }
  bool is_native() const override { return equations_.is_native(); }

 private:
  class Trajectory;
  struct Trace;

  std::unique_ptr<Stepper> do_stepper() const override;
  std::vector<StepFormulas> do_formulas() const override;

  std::shared_ptr<const DiscretizationMap> map_;
  EquationSystem equations_;  // y; x₀, basis, h, t ↦ residual
  Function whole_;            // the same without elimination, unless it is affine
  Function advance_;          // the same ↦ x₁, v, and x̄ unless the map has an inverse
  Function stage_;            // x₀, x₁ ↦ x̄ where it has
  Function basis_;            // of MovingBasis
  Function constraint_;       // of RoundOffProjection
  Index tangent_blocks_ = 1;  // leading blocks of y that are coordinates of tangent vectors at x₀
};

}  // namespace courant
