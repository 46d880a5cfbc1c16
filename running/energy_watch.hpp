// EnergyWatch: changes of the energy that the method does not explain.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "courant/integrators/step/integrator.hpp"
#include "courant/running/observer.hpp"
#include "courant/running/run_watcher.hpp"

namespace courant {

// Whenever |H - H(0)| has grown to four times what it was at the last look, the last step is made
// again in one, three and nine parts. What a method of order p does to H on the way differs
// between these by less and less, about 3^-p times as much each time. Where it does not, H changes
// by something else than the error of the method: an unstable method, a solution that has been left.
//
// States that a method leaves beside the constraints, by its order, are no starts for shorter steps:
// these go from one side to the other, the faster the shorter they are. So the run up to the step is
// made again in steps of a third and a ninth as well, from the start: where H converges, and is wrong by no more
// than a hundredth of its terms, there is no finding. Of steps of a ninth that is left out where all together would
// take more than 10⁵ steps times coordinates: then H from steps of a third has to agree to a hundredth of its change.
// Large systems, and what is late in a run, are not made again.
//
// Where H of a system without ports has changed by more than it was the sum of at the start, as from -1 to 16, the run
// up to there is made again in steps of a third too: where these change it by less than half as much, the change is an
// error of the method, and is said, though its order explains it.
//
// Where the parts of a step lead to values of H that differ by more than H is the sum of, before the step and after the
// parts, the step has no digits: so it is at a collision, a pole. The run ends there. Where energy goes through ports,
// what was supplied and dissipated since the beginning are among what H is the sum of: a circuit that is switched on
// stores nothing beside them at first. From rest, where H is the sum of nothing, and where ports account for the
// change, nothing is said.
//
// H need not be conserved; what is round-off of its terms, which may cancel, is not looked at. Nor is a run that stands
// still, whose coordinates have not left the start but by rounding: velocities that round-off makes have an energy that
// is next to nothing, and no digits.
class EnergyWatch final : public RunWatcher {
 public:
  // Where numbers are in the rows of the run.
  struct Columns {
    Index energy;  // H
    // H - H(0) - supplied + dissipated, where energy goes through ports. Where that is little next to the
    // change of H, and shorter steps change H as much but for a hundredth, the ports explain it.
    std::optional<Index> balance = {};
    // Where energy goes through ports, since the beginning.
    std::vector<Index> through_ports = {};
  };
  // `energy`: H of a state that a step ended at, `sizes`: what it is made of there; `start`: of the run.
  EnergyWatch(std::shared_ptr<const Integrator> integrator,
              std::function<double(const State&)> energy,
              std::function<EnergySizes(const State&)> sizes, Columns columns, State start);

  std::optional<RunEnd> watch(const RunMoment& moment) override;
  // Empty, or a sentence about the first such step. One at which H changed by nothing next to what came
  // later, as from rest, is none.
  std::string finding() const;

  // What it remembers of the states before.
  struct Memory {
    double initial = 0.0;    // H
    double largest = 0.0;    // |H|
    double looked_at = 0.0;  // |H - H(0)| at the last look
    double found_at = 0.0;   // and at the finding
    std::string finding = {};
  };
  const Memory& memory() const { return memory_; }
  // Goes on as the watch over the same run that had this memory.
  void recall(Memory memory) { memory_ = std::move(memory); }

 private:
  // Whether H after `count` steps of h, and after as many as there are in one, three and nine parts,
  // differs by less and less, or by no more than `agreed`; and by no more than `most`.
  bool converges(const State& from, double h, long count, double agreed, double most) const;
  bool is_explained(const RunMoment& moment, double terms) const;
  // Whether what went through ports accounts for the change of H.
  bool is_accounted(const RunMoment& moment) const;
  // What went through ports since the beginning, in and out.
  double through_ports(const RunMoment& moment) const;
  // Whether the coordinates are those of the start, up to rounding.
  bool stands_still(const RunMoment& moment) const;
  // Why the run ends where the last step has no digits; nothing elsewhere.
  std::optional<RunEnd> end_where_broken(const RunMoment& moment) const;
  // Steps times coordinates of the run so far.
  double work_from_start(const RunMoment& moment) const;
  // H after the run so far, made again in steps of a third; nothing where that takes too long or cannot be.
  std::optional<double> energy_in_thirds(const RunMoment& moment) const;
  // How H changes then, where the run changed it by more than it was the sum of at the start; nothing where it did not,
  // and where ports change it.
  std::optional<double> change_in_thirds(const RunMoment& moment) const;
  EnergySizes sizes(const State& state) const;

  std::shared_ptr<const Integrator> integrator_;
  std::function<double(const State&)> energy_;
  std::function<EnergySizes(const State&)> sizes_;
  Columns columns_;
  State start_;
  Memory memory_;
};

}  // namespace courant
