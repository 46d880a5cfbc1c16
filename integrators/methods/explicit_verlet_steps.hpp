// Steps by Verlet that solve nothing, or for multipliers alone, compiled.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/methods/explicit_verlet.hpp"
#include "courant/integrators/methods/multiplier_solver.hpp"
#include "courant/integrators/methods/verlet_start.hpp"
#include "courant/integrators/step/stepper.hpp"

namespace courant {

// The formulas of ExplicitVerlet as functions. Immutable: trajectories on several threads share one object.
class ExplicitVerletSteps : public std::enable_shared_from_this<ExplicitVerletSteps> {
 public:
  ExplicitVerletSteps(const ExplicitVerlet& formulas, const Backend& backend);
  // With multipliers; `trace` and `manifold` are those that the formulas are of.
  ExplicitVerletSteps(const ExplicitVerlet& formulas, const VerletTrace& trace,
                      const Manifold& manifold, const Backend& backend);

  bool is_native() const { return step_.is_native(); }
  // Of the composition of steps of these parts of h.
  std::unique_ptr<Stepper> stepper(const std::string& name,
                                   const std::shared_ptr<const ImplicitSystem>& system,
                                   std::span<const double> parts) const;

 private:
  class Trajectory;

  Index handed_on_ = 0;
  Function beginning_, step_, stages_, ending_;
  // Where there are multipliers.
  std::optional<MultiplierFunctions> multipliers_;
  VerletStart start_;
  Function basis_;  // of TransportedFrame
};

}  // namespace courant
