// TransformedIntegrator: steps of one size in a time τ, of varying size in t.
#pragma once

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/integrators/methods/integrator_adaptor.hpp"
#include "courant/structures/time_transformation.hpp"

namespace courant {

// A method Φ_h of the extended system of a TimeTransformation as a method of the system itself:
//
//   (x, t) ↦ (x₁, t₁),   t₁ - t ≈ h g,   dt/dτ = g(x, t)
//
// h is a step in τ. The time of the state that a step leads to is what the step makes of it, not t + h:
// the argument `end` of Stepper::step is not used. Step::rate is (t₁ - t) / h. A state carries p_t where
// the transformation is symplectic, and without it p_t is -E there.
//
// What the method promises it promises on the extended manifold: with the symplectic transformation
// and a symplectic method, that the form of T*(Q × R) is preserved. Order, symmetry, constraints and
// (unless E depends on t) an exact balance of energy are those of the method. A step that does not go
// forward in t for h > 0, as where g vanishes or is negative, throws SolveError.
class TransformedIntegrator final : public IntegratorAdaptor {
 public:
  // `method` is of transformation->extended(), and wrapped(): its laws are those of every integrator. Throws
  // std::invalid_argument otherwise.
  TransformedIntegrator(std::shared_ptr<const TimeTransformation> transformation,
                        std::shared_ptr<const Integrator> method);

  const std::shared_ptr<const TimeTransformation>& transformation() const {
    return transformation_;
  }
  std::string name() const override { return wrapped()->name() + " in transformed time"; }
  bool has_exact_energy() const override {
    return wrapped()->has_exact_energy() && !transformation_->has_time_in_energy();
  }
  const Units* units() const override { return nullptr; }

 private:
  class Trajectory;

  std::unique_ptr<Stepper> do_stepper() const override;

  std::shared_ptr<const TimeTransformation> transformation_;
};

// The ladder of the extended system where a state of the system itself is.
ConstraintLadder extended_ladder(const TimeTransformation& transformation, const State& initial);

}  // namespace courant
