// RunSensitivities: derivatives along a run.
#pragma once

#include <memory>
#include <optional>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/step/step_differential.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/varied_system.hpp"

namespace courant {

// What the key `sensitivities` of an experiment asks for: with TΦ of the steps of the run, and the directions δ₀ of
// varied_start,
//
//   (δx, δθ) = TΦ δ₀,   δq = ∂q/∂x δx + ∂q/∂v δv + ∂q/∂z δz + ∂q/∂θ δθ
//
// for each quantity q, where v and z are those that S_f has at x; and the growth of volumes by TΦ, as of
// DiscreteFlow::lyapunov_exponents. The steps are those of the run, which knows nothing of this: parameters are
// coordinates of a method of the extended system, of which the differential alone is asked for, at these steps.
//
// One object a trajectory; copies go on by themselves.
class RunSensitivities {
 public:
  // `ladder`: of the experiment at its start; `method`: of the run. Throws ExperimentError as VariedSystem and
  // varied_start do, and at /sensitivities where the method does not know its differential, also by parameters.
  RunSensitivities(const Experiment& experiment, const ConstraintLadder& ladder,
                   const PreparedMethod& method);

  // The first state.
  void begin(const State& state);
  // The next step. Throws std::domain_error where it has no derivative.
  void advance(const Step& step);

  // In the order of Sensitivities::columns(), at the present state.
  const VectorXd& values() const { return memory_.values; }
  // So far, in descending order; none before the first step, or where they are not asked for.
  VectorXd exponents() const;
  // What summary.json has of it: {"final": {"x": {"L": 0.5}}, "lyapunov_exponents": […]}. `last`: values() of the last
  // row, which is within a step where an event ended the run.
  Json summary(const VectorXd& last) const;

  // All that is kept of the steps so far.
  struct Memory {
    MatrixXd
        images;  // (N + p) × (k, and as many as M_f has dimensions where exponents are asked for)
    VectorXd growth;    // log of that of the latter
    double time = 0.0;  // in which they grew
    VectorXd values;    // at the last state
  };
  const Memory& memory() const { return memory_; }
  // Goes on from there. Throws std::invalid_argument if it is of another run.
  void recall(const Memory& memory);

 private:
  struct Quantities {
    std::vector<Index> places;  // in `of`
    Function values;            // (x, θ), v, z, t, with Jacobian by all but t
  };
  void make_quantities(const Experiment& experiment);
  void take_values(const State& state);

  Sensitivities asked_;
  std::shared_ptr<const VariedSystem> system_;
  std::shared_ptr<const StepDifferential> differential_;
  std::shared_ptr<const Quantities> quantities_;  // null where all are coordinates
  bool needs_rates_ = false;
  MatrixXd start_;
  Memory memory_;
};

// Nothing unless the experiment asks for sensitivities. The first step is tried, so that what has no derivative is
// known before a file is written.
std::optional<RunSensitivities> sensitivities_of_run(const Experiment& experiment,
                                                     const ConstraintLadder& ladder,
                                                     const PreparedMethod& method);

}  // namespace courant
