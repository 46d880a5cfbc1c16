// Observer: the numbers of a row of a trajectory.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/methods/tangent_map.hpp"
#include "courant/integrators/step/vector_field.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/observed_quantities.hpp"
#include "courant/running/power_account.hpp"
#include "courant/running/run_sensitivities.hpp"

namespace courant {

// What H is made of at a state, by bounds of errors: `terms` is what H is small next to where they cancel, the
// factor that an error of all its numbers, each next to itself, comes out with; `round_off` is by how much it
// changes when each number is off by a few roundings of the largest of its group (x, v, z).
struct EnergySizes {
  double terms = 0.0, round_off = 0.0;
};

// What a run measures at each state: the coordinates, H where the system has an energy, the energies
// of its steps where it has ports, the defects of its tangent map, the momenta of its symmetries, the
// experiment's observables, its sensitivities, the constraints, and (not written to files) the quantities of its events
// and the deviations that its expectations need.
//
// `supplied` and `dissipated` are since the beginning, `balance` that of the step which ended at the state, as of
// PowerAccount. Observables at the stage of that step are evaluated with its effort; at the first state, before any
// step, they are those of the state. Defects are those of the map from the first state to the one that the last step
// led to; before follow() there is none, and they are 0. So are sensitivities.
//
// constraint[i] are the equations of the system that contain nothing but x and t, and the total
// time derivatives of those which the constraint algorithm differentiated more than once: zero on
// M_f. Where these are not all constraints that M_f has (its codimension is higher than the rank of
// their gradients), the others are seen only through v or z: they are what is left of the equations
// of S_f that VectorField leaves out, with the velocity that the others give at x. So there is a
// constraint[i] wherever M_f is not M. Where something depends on v or z, and S_f is the graph of a
// vector field, that is evaluated at the state's x: a step knows v and z at some point between two
// states. One object a trajectory.
class Observer {
 public:
  Observer(const Experiment& experiment, const ConstraintLadder& ladder, Backend backend);
  Observer(const ObservedQuantities& quantities, Backend backend);

  // The names of a row's numbers, and how many of them are coordinates, are written to files.
  const std::vector<std::string>& names() const { return names_; }
  std::size_t coordinate_count() const { return coordinate_count_; }
  std::size_t written_count() const { return written_count_; }
  std::size_t first_constraint() const { return first_constraint_; }
  std::size_t constraint_count() const { return written_count_ - first_constraint_; }
  std::size_t first_event() const { return first_event_; }
  // What events set, one after the other, and behind that of an event that sets velocities the whole of dx/dt.
  std::size_t first_reset() const { return first_reset_; }
  Index first_sensitivity() const { return first_sensitivity_; }

  // The numbers at a state by itself; the reference is valid until the next call.
  const VectorXd& row(const State& state);
  // The same for the first state of a run, and for the next one with the step that ended there.
  const VectorXd& begin(const State& state);
  // Throws std::domain_error where something that is measured is not defined.
  const VectorXd& advance(const Step& step);
  // Whether that takes the stage, the effort and the parts of a step.
  bool needs_stages() const { return account_ || map_ || sensitivities_ || stage_.size() > 0; }

  // Of the steps so far; null where nothing asks for it: the system has no ports, no observable is at
  // a stage, and no bound of the imbalance is expected.
  const PowerAccount* account() const { return account_ ? &*account_ : nullptr; }

  // Both 0 without an energy, and where nothing is known of it. Slopes of H do not tell: those of
  // Σ v ∂L/∂v - L for an L of the first degree in v vanish like H itself, and are round-off.
  EnergySizes energy_sizes(const State& state);

  // From begin() or recall() on measures the defects of this map; the steps have to know their parts.
  void follow(TangentMap map) { map_ = std::move(map); }
  // Null where no defect is asked for.
  const TangentMap* tangent_map() const { return map_ ? &*map_ : nullptr; }

  // The same of sensitivities.
  void follow(RunSensitivities sensitivities) { sensitivities_ = std::move(sensitivities); }
  const RunSensitivities* sensitivities() const {
    return sensitivities_ ? &*sensitivities_ : nullptr;
  }

  // All that is kept of the steps so far, where there is such a thing.
  struct Memory {
    std::optional<PowerAccount::Memory> power_account = {};
    std::optional<TangentMap::Memory> tangent_map = {};
    std::optional<RunSensitivities::Memory> sensitivities = {};
  };
  Memory memory() const;
  // Goes on from there; throws std::invalid_argument if it is of another system.
  void recall(const Memory& memory);

  // What is in the memory aside, the rows after this depend on the state alone, which is near that of the next one;
  // not on the rows before, from which the velocity and the unknowns are looked for otherwise.
  void restart(const State& state);

 private:
  // What quantities_ takes at a state by itself.
  const double* const* arguments(const State& state);
  bool evaluate_from_last(const State& state);
  // All of a row but the balance, which is settled with its H, and the deviations.
  void measure(const State& state);
  // These two, which complete it.
  const VectorXd& compare(double t);
  void observe_stage(const State& at, const VectorXd& effort);
  void take_energies();
  void take_defects();

  std::vector<std::string> names_;
  std::size_t coordinate_count_, first_constraint_, written_count_, first_event_, first_reset_;
  // x, v, z, t, what the field leaves out, energies ↦ all between the coordinates and the deviations
  Function quantities_;
  // H and what it is a function of, until its sizes are asked for: few runs ask for them.
  struct Energy {
    Expr H;
    std::vector<Function::Input> inputs;
  };
  std::optional<Energy> energy_;
  Function H_of_;                    // the same ↦ H, once it is asked for
  Function at_stage_;                // x, v, z, t, effort ↦ observables at the stage
  std::vector<Index> stage_places_;  // of those in a row
  VectorXd stage_;
  Function forms_;                // t ↦ what deviations are from
  std::vector<Index> deviating_;  // the places of what deviates
  VectorXd form_;
  std::optional<PowerAccount> account_;
  VectorXd energies_;
  std::optional<TangentMap> map_;
  std::vector<Defect> asked_defects_;
  std::vector<Index> defect_places_;  // of those in a row
  VectorXd defects_;
  std::optional<RunSensitivities> sensitivities_;
  Index first_sensitivity_, sensitivity_count_;
  std::optional<Index> H_, balance_;
  std::unique_ptr<const VectorField> field_;
  bool is_field_ = false;  // whether v and z are those of the field, not those of the state
  std::optional<VectorField::Evaluation> evaluate_field_;
  VectorXd rate_, row_;
  std::array<const double*, 6> arguments_{};
};

}  // namespace courant
