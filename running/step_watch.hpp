// StepWatch: steps that do not resolve the solution.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "courant/integrators/step/integrator.hpp"
#include "courant/running/run_watcher.hpp"

namespace courant {

// Explicit methods go through what no solution goes through: a collision, a pole, a point at which the velocity is not
// determined. Where x turns or lengthens its step at once, by half of it or more, the step is made again in one, three
// and nine parts. A run ends where their ends differ by more than the step is long, or by half of that and no less for
// nine parts than for three: such a step has no digits. It ends, too, where these parts cannot be made, since no
// velocity is found on the way: one long step may go on from there on another branch of the solutions. Looks only where
// x turns more than twice as much as where it was looked at last, so that there are few of them.
class StepWatch final : public RunWatcher {
 public:
  // `kinds`: the first entry and the count of coordinates that have a unit in common, as positions and momenta.
  StepWatch(std::shared_ptr<const Integrator> integrator,
            std::vector<std::pair<Index, Index>> kinds);

  std::optional<RunEnd> watch(const RunMoment& moment) override;
  bool needs_stages() const override { return false; }
  // What was seen so far, as at the start of a run that goes on from a checkpoint.
  void forget();

 private:
  std::optional<RunEnd> look(const RunMoment& moment) const;

  std::shared_ptr<const Integrator> integrator_;
  std::vector<std::pair<Index, Index>> kinds_;
  VectorXd last_;       // the displacement of the step before; empty at first
  VectorXd looked_at_;  // how much x turned there, for each kind
};

}  // namespace courant
