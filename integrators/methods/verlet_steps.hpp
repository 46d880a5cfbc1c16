// Steps by Verlet that are solved for, compiled.
#pragma once

#include <memory>
#include <string>

#include "courant/core/expressions/function.hpp"
#include "courant/core/solve/equation_system.hpp"
#include "courant/integrators/methods/verlet_start.hpp"
#include "courant/integrators/methods/verlet_trace.hpp"
#include "courant/integrators/step/stepper.hpp"

namespace courant {

// The formulas of VerletTrace as functions. Immutable: trajectories on several threads share one object.
class VerletSteps : public std::enable_shared_from_this<VerletSteps> {
 public:
  VerletSteps(const VerletTrace& trace, const Manifold& manifold, const Backend& backend);

  bool is_native() const { return advance_.is_native(); }
  std::unique_ptr<Stepper> stepper(const std::string& name,
                                   const std::shared_ptr<const ImplicitSystem>& system) const;

 private:
  class Trajectory;

  Index codimension_ = 0;
  Index tangents_ =
      0;  // where steps are solved for: how many of ξ, ξ', … at their ends are unknowns
  EquationSystem equations_;  // y; x₀, basis, h, t ↦ residual
  Function whole_;            // the same without elimination, unless it is affine
  Function advance_;  // the same ↦ x₁, v, z and what is known of the halves, see tell_halves()
  VerletStart start_;
  Function basis_, constraint_;  // of TransportedFrame, of RoundOffProjection
};

}  // namespace courant
