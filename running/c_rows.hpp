// The rows of a program in C. Not installed API: c_program is.
#pragma once

#include <optional>
#include <string>

#include "courant/integrators/step/step_energies.hpp"
#include "courant/integrators/step/step_program.hpp"
#include "courant/running/c_functions.hpp"
#include "courant/running/observed_quantities.hpp"

namespace courant {

// What a program in C measures, and writes into its rows: the quantities of an Observer, in its order, with
// the energies that go through ports. Keeps references to what it is made of.
class CRows {
 public:
  CRows(const StepProgram& step, const ObservedQuantities& observed, const Manifold& manifold);

  // Whether something is measured within steps: energies through ports, observables at the stage.
  bool measures_steps() const;

  // The formulas.
  void add_functions(CFunctions& functions) const;
  // What each part of a step leaves to be known: its stage, and the energies through the ports.
  std::string parts() const;
  // From states to rows. `first_asked`: where a run asks first what rows are, the point of its ladder.
  std::string measurement(const State& first_asked) const;

 private:
  bool has_basis() const;
  bool has_effort() const;

  const StepProgram& step_;
  const ObservedQuantities& observed_;
  std::optional<StepEnergies::Formulas> energies_;
  Index coordinates_, velocities_;
};

}  // namespace courant
