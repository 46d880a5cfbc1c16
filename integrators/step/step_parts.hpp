// What steppers have in common that make a step of the steps of others.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "courant/integrators/step/stepper.hpp"

namespace courant {

// While it lives what the solver of another stepper does counts, whether its step can be made or not.
class CountedWork {
 public:
  // Both outlive it.
  CountedWork(SolverStatistics& counted, const Stepper& of)
      : counted_(counted), of_(of), before_(of.statistics()) {}
  ~CountedWork() { counted_.add_work(before_, of_.statistics()); }
  CountedWork(const CountedWork&) = delete;
  CountedWork& operator=(const CountedWork&) = delete;

 private:
  SolverStatistics& counted_;
  const Stepper& of_;
  const SolverStatistics before_;
};

// Of the last step that stands: what is known of its last part, and of all parts if that is asked for;
// those that are not told have h = 0.
class StepParts {
 public:
  // Each of these has made a part, in this order.
  void keep(std::span<const std::unique_ptr<Stepper>> steppers, bool tells_parts) {
    keep(steppers.back()->last(), steppers.size());
    if (!tells_parts) return;
    for (std::size_t i = 0; i < steppers.size(); ++i) parts_[i] = steppers[i]->last();
  }
  // So many parts, none of them told yet but by those before.
  void keep(const Step& last, std::size_t count) {
    stage_ = last.stage;
    effort_ = last.effort;
    parts_.resize(count);
  }
  // Tells these, and takes the last ones in exchange.
  void exchange(std::vector<Step>& parts) { parts_.swap(parts); }
  void tell(Step& step) const {
    step.stage = stage_;
    step.effort = effort_;
    step.parts = parts_;
  }

 private:
  State stage_;
  VectorXd effort_;
  std::vector<Step> parts_;
};

}  // namespace courant
