// GradientWatch: steps across points at which constraints have no gradients.
#pragma once

#include <memory>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/running/run_watcher.hpp"

namespace courant {

// At the tip of a cone, x² + y² = z², the gradient of the constraint vanishes, and equations do not say how a solution
// goes on. A step across it has points of M_f at both of its ends. Gradients of equations c(x, t) = 0, rows J of rank
// d, are those of one piece of a submanifold as long as they turn little by little:
//
//   det(J(x₀) J(x₁)ᵀ) > 0
//
// Where that fails the step is made again in nine parts, along which gradients that turn far do not turn at once. A run
// ends where it fails for one of the parts, or where such a part cannot be made. Up to 200 coordinates and 50
// equations, which are independent at the start.
class GradientWatch final : public RunWatcher {
 public:
  GradientWatch(std::shared_ptr<const Integrator> integrator, const State& initial);

  std::optional<RunEnd> watch(const RunMoment& moment) override;
  bool needs_stages() const override { return false; }

 private:
  // J, as covectors of M in its ambient space: d × N.
  MatrixXd gradients(const State& state) const;
  bool is_crossed(const Step& step) const;

  std::shared_ptr<const Integrator> integrator_;
  Function constraints_;     // x, t ↦ c with ∂c/∂x; without inputs where nothing is watched
  VectorXd last_x_;          // where gradients were asked for last
  MatrixXd last_gradients_;  // these
};

}  // namespace courant
