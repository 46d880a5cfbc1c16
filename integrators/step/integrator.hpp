// Integrator: a one-step method made ready for a system.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/integrators/step/step_differential.hpp"
#include "courant/integrators/step/step_formulas.hpp"
#include "courant/integrators/step/stepper.hpp"

namespace courant {

struct Units;

// A one-step method Φ_h for one system, traced and compiled. Immutable; any number of steppers may
// be at work at once.
class Integrator {
 public:
  virtual ~Integrator() = default;

  const std::shared_ptr<const ImplicitSystem>& system() const { return system_; }

  // The method with its maps and parameters, as messages say it.
  virtual std::string name() const = 0;
  // The order on smooth problems within the method's hypotheses.
  virtual int order() const = 0;
  // Whether Φ_{-h} is the inverse of Φ_h.
  virtual bool is_symmetric() const = 0;
  // Whether the step preserves the symplectic form of its phase space; no value: unknown.
  virtual std::optional<bool> is_symplectic() const { return std::nullopt; }
  // Whether in each step the energy changes by what is supplied less what is dissipated (StepEnergies),
  // up to round-off. A claim about the method: others have this where the energy is quadratic, say.
  virtual bool has_exact_energy() const { return false; }
  virtual bool is_native() const = 0;  // whether compiled C code evaluates the step
  // In which numbers are comparable to a step, where it is made in other units than those of the system; null: as
  // they are.
  virtual const Units* units() const { return nullptr; }

  // The equations that a step solves, one after the other; none for a method that solves none, or has
  // no formulas to show.
  std::vector<StepFormulas> formulas() const { return do_formulas(); }

  // What makes steps along one trajectory, with workspace of its own.
  std::unique_ptr<Stepper> stepper() const { return do_stepper(); }

  // T_xΦ_h of the steps that a stepper of this method makes, exactly; traced when this is called. Null for a method
  // that does not know it. Throws std::domain_error where its steps are no function of the state, as with gauge
  // freedom.
  std::shared_ptr<const StepDifferential> differential() const { return do_differential(); }

  // Φ_h applied `count` times, by a stepper of its own. Throws as Stepper::step does.
  State advance(State state, double h, long count = 1) const;

 protected:
  explicit Integrator(std::shared_ptr<const ImplicitSystem> system);

 private:
  // To subclass, override:
  virtual std::unique_ptr<Stepper> do_stepper() const = 0;
  // May override:
  virtual std::vector<StepFormulas> do_formulas() const { return {}; }
  virtual std::shared_ptr<const StepDifferential> do_differential() const { return nullptr; }

  std::shared_ptr<const ImplicitSystem> system_;
};

}  // namespace courant
