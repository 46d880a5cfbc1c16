// ClaimedOrder: whether errors have the order that an integrator states.
#pragma once

#include <functional>
#include <optional>

#include "courant/integrators/methods/integrator_setting.hpp"
#include "courant/integrators/methods/order_measurement.hpp"
#include "courant/integrators/methods/state_separation.hpp"

namespace courant {

// Compares the order that an integrator states, Integrator::order(), with the order that its errors have at a setting.
//
// The order is measured with the step of the setting first. An order is a statement about short steps, and that step
// may be too long to show it, as for a stiff system. Then steps that are shorter by 8, 8², …, 8⁵ are tried, until one
// shows the order. Where the errors are no more than round-off, steps that are longer by 8 and 8² are tried too.
//
// With the step of the setting a higher order than the stated one is no defect, unless options.both_ways. With another
// step it is one: there the stated order itself has to be seen.
class ClaimedOrder {
 public:
  // A measured order that differs by no more than this is the stated one.
  static constexpr double kTolerance = 0.15;

  // All arguments have to outlive it.
  ClaimedOrder(const Integrator& integrator, const IntegratorSetting& setting,
               const IntegratorLawOptions& options, const StateSeparation& separation);

  // The order that is measured with the step of the setting; infinite where steps are exact. Throws what a step throws.
  double order() { return orders_.errors(setting_.step).order; }

  struct Defect {
    double value = 0.0;
    // The order that was measured with another step than that of the setting, where only that one shows it.
    std::optional<double> order = std::nullopt;
  };
  // By how much the order misses the stated one. Throws what the first step throws, if the order can be measured with
  // no step.
  Defect defect();
  // The same with steps back in time. A step forward again has to lead back to the start; the defect is infinite if it
  // does not. A stiff system can go back by no more than its shortest time, so shorter steps are tried here too.
  double backward_defect();

 private:
  double defect(double h, bool is_other);
  bool is_hidden_by_round_off();
  // defect(h, is_other)
  double with_other_steps(const std::function<double(double, bool)>& defect);

  const Integrator& integrator_;
  const IntegratorSetting& setting_;
  const IntegratorLawOptions& options_;
  const StateSeparation& separation_;
  OrderMeasurement orders_;
};

}  // namespace courant
