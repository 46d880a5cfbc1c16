// ObservedQuantities: what an Observer measures, as formulas.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/integrators/step/vector_field.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/structures/energy_system.hpp"

namespace courant {

// The numbers of a row, in the order that Observer tells, and the functions that give them.
struct ObservedQuantities {
  ObservedQuantities(const Experiment& experiment, const ConstraintLadder& ladder);

  std::vector<std::string> names;
  std::size_t coordinate_count = 0, first_constraint = 0, written_count = 0, first_event = 0,
              first_reset = 0;
  std::optional<Index> H, balance;  // places in a row
  std::vector<Defect> defects;
  std::vector<Index> defect_places;
  Index first_sensitivity = 0, sensitivity_count = 0;  // places in a row
  std::vector<Index> stage_places;                     // of the observables at the stage
  std::vector<Index> deviating;                        // of what deviates

  // x, v, z, t, what the field leaves out, energies ↦ all between the coordinates and the deviations
  std::vector<Function::Input> inputs;
  ExprVector quantities;
  // x, v, z, t, effort ↦ observables at the stage
  std::vector<Function::Input> stage_inputs;
  ExprVector staged;
  Function::Input time;
  ExprVector forms;  // t ↦ what deviations are from

  // Where something depends on v or z, or constraints are seen through them alone.
  std::optional<VectorFieldFormulas> field;
  bool is_field = false;  // whether v and z are those of the field, not those of the state
  // Of the energies that go through the ports, where something asks for them.
  std::shared_ptr<const EnergySystem> account;
};

}  // namespace courant
