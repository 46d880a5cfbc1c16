// IntegratorInUnits: a method whose steps are made in other units.
#pragma once

#include "courant/integrators/integrator.hpp"
#include "courant/integrators/step_program.hpp"
#include "courant/structures/system_in_units.hpp"

namespace courant {

// A method of a SystemInUnits as a method of the system itself: states are measured, stepped and restored,
// to the last bit. What the method promises holds in any units: the diagonal map between them is linear, and
// the discretization maps of Rⁿ and T*Rⁿ commute with it.
class IntegratorInUnits final : public Integrator, public Programmed {
 public:
  // `method` is one of `system`; throws std::invalid_argument otherwise.
  IntegratorInUnits(const std::shared_ptr<const SystemInUnits>& system,
                    std::shared_ptr<const Integrator> method);

  const std::shared_ptr<const Integrator>& measured() const { return method_; }
  const Units& units() const { return units_; }

  std::string name() const override { return method_->name(); }
  int order() const override { return method_->order(); }
  bool is_symmetric() const override { return method_->is_symmetric(); }
  std::optional<bool> is_symplectic() const override { return method_->is_symplectic(); }
  bool has_exact_energy() const override { return method_->has_exact_energy(); }
  bool is_native() const override { return method_->is_native(); }
  StepProgram program() const override;

 private:
  class Trajectory;
  class Differential;

  std::unique_ptr<Stepper> do_stepper() const override;
  // In the units.
  std::vector<StepFormulas> do_formulas() const override;
  std::shared_ptr<const StepDifferential> do_differential() const override;

  Units units_;
  std::shared_ptr<const Integrator> method_;
};

// units_of_all_terms where some coordinates are more than a million times others, or the unit of time is more
// than 10⁹ or less than 10⁻⁹; empty where numbers are comparable as they are, or no units are known.
std::optional<Units> needed_units(const std::shared_ptr<const ImplicitSystem>& system,
                                  const State& point);

}  // namespace courant
