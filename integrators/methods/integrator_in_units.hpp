// IntegratorInUnits: a method whose steps are made in other units.
#pragma once

#include <memory>
#include <optional>

#include "courant/integrators/methods/integrator_adaptor.hpp"
#include "courant/integrators/step/programmed.hpp"
#include "courant/structures/system_in_units.hpp"

namespace courant {

class ChartEquations;

// A method of a SystemInUnits as a method of the system itself: states are measured, stepped and restored,
// to the last bit. What the method promises holds in any units: the map between them is a scaling symmetry of M, and
// discretization maps commute with those.
class IntegratorInUnits final : public IntegratorAdaptor, public Programmed {
 public:
  // `method` is one of `system`; throws std::invalid_argument otherwise.
  IntegratorInUnits(const std::shared_ptr<const SystemInUnits>& system,
                    std::shared_ptr<const Integrator> method);

  const Units* units() const override { return &units_; }
  StepProgram program() const override;

 private:
  class Trajectory;
  class Differential;

  std::unique_ptr<Stepper> do_stepper() const override;
  // In the units.
  std::vector<StepFormulas> do_formulas() const override;
  std::shared_ptr<const StepDifferential> do_differential() const override;

  Units units_;
};

// units_of_all_terms where some coordinates are more than a million times others, or the unit of time is more
// than 10⁹ or less than 10⁻⁹; empty where numbers are comparable as they are, or no units are known.
std::optional<Units> needed_units(const std::shared_ptr<const ChartEquations>& equations,
                                  const State& point);
std::optional<Units> needed_units(const std::shared_ptr<const ImplicitSystem>& system,
                                  const State& point);

}  // namespace courant
