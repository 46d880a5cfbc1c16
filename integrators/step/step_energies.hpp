// StepEnergies: what enters and leaves a system in a step.
#pragma once

#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/step/step.hpp"
#include "courant/structures/energy_system.hpp"

namespace courant {

// Σ a_i from the first to the last, as programs in other languages add.
inline double sum_in_order(const VectorXd& a) { return std::accumulate(a.begin(), a.end(), 0.0); }

// The discrete power balance of a step. With the powers of the system at the stage (x̄, v, α, z, t̄),
//
//   supplied = h Σ supplied power,   dissipated = h Σ dissipated power,   port by port
//
// and, where E depends on time, a port "time" that supplies
//
//   E(x₁, z, t₁) - E(x₁, z, t̄) + E(x₀, z, t̄) - E(x₀, z, t₀)
//
// A step that is made of others has the sums of theirs. For every step that solves the equations of
// the system at its stage (Methods 1 and 2, discrete gradients)
//
//   h ⟨α, v⟩ = supplied - dissipated - what time supplies                            (29), (31)
//
// which is E(x₁, z, t̄) - E(x₀, z, t̄), so that the energy is balanced exactly, for discrete gradients,
// and for the midpoint map on Rⁿ where H is quadratic.
class StepEnergies {
 public:
  // What is evaluated for a step.
  struct Formulas {
    explicit Formulas(const EnergySystem& system);

    std::vector<std::string> suppliers, dissipators;
    bool has_time = false;         // the last of the suppliers, which has no power
    ExprVector x, v, alpha, z, t;  // variables
    // By port, suppliers first, what moves in a unit of time, and ⟨α, v⟩.
    ExprVector powers;
    ExprVector effort, generator;        // d_xE; E
    ExprVector powers_at_stage() const;  // with d_xE for α
  };
  explicit StepEnergies(std::shared_ptr<const EnergySystem> system,
                        Backend backend = Backend::interpreter)
      : StepEnergies(Formulas(*system), backend) {}
  StepEnergies(const Formulas& formulas, Backend backend);

  // Of the ports; both empty for a closed system without losses.
  const std::vector<std::string>& suppliers() const { return suppliers_; }
  const std::vector<std::string>& dissipators() const { return dissipators_; }

  struct Energies {
    VectorXd supplied, dissipated;  // by port
    // What moves within the system and through its ports: h Σ |α_i v_i| + Σ |supplied| + Σ |dissipated|.
    // Next to it, and to H, round-off in a balance is small, also where H is zero by cancellation.
    double moved = 0.0;
    // h ⟨α, v⟩ - supplied + dissipated at the stage, what time supplies left out: 0 by (29), (31).
    double stage_balance = 0.0;
    double supply() const { return sum_in_order(supplied); }
    double loss() const { return sum_in_order(dissipated); }
  };
  // Of a step that is made of several: the stepper has been told to tell_parts(). Throws
  // std::invalid_argument otherwise.
  Energies operator()(const Step& step) const;
  // The same without allocation after the first call with this place and this workspace.
  void measure(const Step& step, Energies& energies, VectorXd& workspace) const;

  // α of the step: its effort, or d_xE at its stage. Size Ñ.
  VectorXd effort(const Step& step) const;
  // E(x, z, t) of a state: H where the constraints of the system hold.
  double energy(const State& state) const;

 private:
  std::vector<std::string> suppliers_, dissipators_;
  bool has_time_ = false;
  Index size_;  // of points
  void add(const Step& step, Energies& energies, VectorXd& powers) const;

  // x, v, α, z, t ↦ powers by port, suppliers first, what moves in a unit of time, and ⟨α, v⟩; for α = d_xE
  // x, v, z, t ↦ the same.
  Function powers_, powers_at_stage_;
  Function effort_;     // x, z, t ↦ d_xE
  Function generator_;  // the same ↦ E
};

}  // namespace courant
