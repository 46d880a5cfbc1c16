// What steps by Method 2 evaluate.
#pragma once

#include <utility>
#include <vector>

#include "courant/core/solve/equation_system.hpp"
#include "courant/integrators/methods/constrain_first_scheme.hpp"
#include "courant/integrators/step/transported_conormals.hpp"

namespace courant {

// The compiled functions of a step and of the projection that follows it. Their unknowns are y = (ξ, ξ', …, z, …, μ),
// in the chart at x₀. Immutable: trajectories on several threads share one object.
struct ConstrainFirstFunctions {
  ConstrainFirstFunctions(ConstrainFirstScheme scheme, const Backend& backend);

  ConstrainFirstScheme scheme;
  // What steps do without.
  ConstrainFirstScheme::Omissions omitted;
  Index blocks;              // tangent blocks of the unknowns: ξ, ξ', …
  Index auxiliaries;         // z, z', …
  EquationSystem equations;  // y; x₀, basis, W, h, t  ↦ residual of the step
  Function whole;            // the same without elimination, unless it is affine
  Function advance;          // the same ↦ R_d⁺(x̄, h v), x̄, v
  EquationSystem
      projection;  // y; x_guess, basis, W, x_near, t ↦ residual of x ∈ M_f, R_x(W μ) = x_near
  Function projected;  // the same ↦ x, v, z
  // The same ↦ equations that steps do without, with their Jacobian; what is held of z, by its place.
  Function redundant;
  std::vector<std::pair<Index, double>> held_z;
  Function basis;            // of TransportedFrame
  Function constraint;       // of RoundOffProjection
  Function shift;            // (near, s) ↦ R_near(Π s)
  Function corrected_shift;  // (near, s, x₀, x) ↦ what leads to x if s leads to x₀, to first order
  TransportedConormals::Functions conormals;
  std::vector<MatrixXd> references;  // of the conormals, the first those at the ladder's point
  Function span;                     // of TransportedDirections
};

}  // namespace courant
