// The formulas of a step by Verlet that solves nothing.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/maps/discretization_map.hpp"
#include "courant/integrators/methods/verlet_multipliers.hpp"
#include "courant/integrators/step/vector_field.hpp"

namespace courant {

// Half a step of a discretization map R_d, then half a step of its adjoint, for a vector field v = X(x, t) on a space
// with x + v for a retraction:
//
//   w = (h/2) X(x̄(x₀, w), t̄),   x_m = x₀ + w,     (x̄, w) = R_d⁻¹(x₀, x_m)
//   u = (h/2) X(x̄(x_m, x₁), t̄'),   x₁ = x_m + u,   (x̄, u) = R_d*⁻¹(x_m, x₁)
//
// where these give w and u one component after the other, as those of a separable energy do on T*Rⁿ:
//
//   p_m = p₀ - (h/2) V'(q₀),   q₁ = q₀ + h T'(p_m),   p₁ = p_m - (h/2) V'(q₁)
//
// Components of X that do not change from the end of a step to the beginning of the next one, V'(q₁) here, are
// evaluated once: they are handed on as r.
//
// With constraints on positions the same is true of a step once its multipliers are known; then nothing is handed on.
struct ExplicitVerlet {
  // No value where something would have to be solved for.
  static std::optional<ExplicitVerlet> of(const VectorFieldFormulas& field,
                                          const std::shared_ptr<const DiscretizationMap>& map);
  // With constraints; no value as of VerletMultipliers.
  static std::optional<ExplicitVerlet> of(const VerletTrace& trace, const Manifold& manifold);

  std::vector<Index> handed_on;  // the components of v that are r
  Function::Formulas beginning;  // x₀, t ↦ r
  Function::Formulas step;       // x₀, r₀, h, t ↦ x₁, r₁
  // The stages of both halves: x₀, r₀, r₁, h, t ↦ x̄, v, z of the first half and x_m, then x̄, v, z of the second.
  Function::Formulas stages;
  Function::Formulas ending;  // the same ↦ v, z at the end
  // Where there are some, their unknowns u are the last input of `step`, `stages` and `ending`.
  std::optional<VerletMultipliers> multipliers = {};
};

}  // namespace courant
