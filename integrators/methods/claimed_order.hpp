// The order that an integrator claims.
#pragma once

#include <functional>
#include <optional>

#include "courant/integrators/methods/integrator_setting.hpp"
#include "courant/integrators/methods/order_measurement.hpp"
#include "courant/integrators/methods/state_separation.hpp"

namespace courant {

// How far the order that is measured at a setting misses order(): by the step of the setting, or else by
// one that is shorter by up to 8⁵ or, where round-off hides the order, longer by up to 8². An order is
// one of short steps: that of the setting may be too long for it where a system is stiff, and such a
// system may not go back by more than its shortest time.
class ClaimedOrder {
 public:
  // The order may be off by so much.
  static constexpr double kTolerance = 0.15;

  // All arguments have to outlive it.
  ClaimedOrder(const Integrator& integrator, const IntegratorSetting& setting,
               const IntegratorLawOptions& options, const StateSeparation& separation);

  // With the step of the setting; infinite where steps are exact. Throws what a step throws.
  double order() { return orders_.errors(setting_.step).order; }

  struct Defect {
    double value = 0.0;
    // The order with the other step that shows the claim, where it is another one.
    std::optional<double> order = std::nullopt;
  };
  // How far the order is from the claim (below it, unless both_ways). Throws what the first step throws,
  // if there is no step with which it can be measured.
  Defect defect();
  // The same with steps back in time, each of which has to lead back: infinite if it does not.
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
