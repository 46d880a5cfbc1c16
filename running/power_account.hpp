// PowerAccount: the energies that went through the ports of a system in a run.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "courant/integrators/step/step_energies.hpp"

namespace courant {

// Adds up what the steps of a run supplied and dissipated, port by port, and measures how far each of
// them is from balance:
//
//   balance = H(x₁) - H(x₀) - supplied + dissipated
//
// where supplied and dissipated are those of the step. Next to the greatest |H(x₀)| + |H(x₁)| + what
// moved (StepEnergies) in a step, the greatest |balance| is the imbalance of the run. The stage balance of a
// step, h ⟨α, v⟩ - supplied + dissipated, is 0 whatever the method is, if its equations are solved; next to the
// greatest that moved in a step the greatest is the stage imbalance. One object a trajectory.
class PowerAccount {
 public:
  explicit PowerAccount(StepEnergies energies) : energies_(std::move(energies)) {}

  const StepEnergies& energies() const { return energies_; }

  // H at the first state.
  void open(double H);
  // The next step, then H where it ended.
  void enter(const Step& step);
  void settle(double H);

  // Since the beginning, of all ports.
  double supplied() const { return sum_in_order(memory_.supplied); }
  double dissipated() const { return sum_in_order(memory_.dissipated); }
  double balance() const { return memory_.balance; }  // of the last step
  double imbalance() const;                           // 0 before the first step
  double stage_imbalance() const;                     // the same

  // What is told of the run.
  struct Report {
    std::vector<std::pair<std::string, double>> supplied, dissipated;  // by port
    double stored;                                                     // ΔH
    double max_balance, max_imbalance;  // the greatest |balance|, and next to the energies
    double max_stage_imbalance;
  };
  Report report() const;

  // All that is kept of the steps so far.
  struct Memory {
    double first = 0.0, last = 0.0;  // H
    double balance = 0.0, greatest = 0.0, size = 0.0;
    double stage_greatest = 0.0, moved = 0.0;
    VectorXd supplied = {}, dissipated = {};  // by port
  };
  const Memory& memory() const { return memory_; }
  // Goes on from there; throws std::invalid_argument if it is of another number of ports.
  void recall(const Memory& memory);

 private:
  StepEnergies energies_;
  StepEnergies::Energies last_;
  VectorXd workspace_;
  Memory memory_;
};

}  // namespace courant
