// Observer: the numbers of a row of a trajectory.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/core/function.hpp"
#include "courant/integrators/vector_field.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// What a run measures at each state: the coordinates, H where the system has an energy, the
// experiment's observables, the constraints, and (not written to files) the deviations that its
// expectations need and the quantities of its events.
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

  // The names of a row's numbers, and how many of them are coordinates, are written to files.
  const std::vector<std::string>& names() const { return names_; }
  std::size_t coordinate_count() const { return coordinate_count_; }
  std::size_t written_count() const { return written_count_; }
  std::size_t first_constraint() const { return first_constraint_; }
  std::size_t constraint_count() const { return written_count_ - first_constraint_; }
  std::size_t first_event() const { return first_event_; }

  // The numbers at a state; the reference is valid until the next call.
  const VectorXd& row(const State& state);

  // The rows after this depend on the state alone, which is near that of the next one; not on the
  // rows before, from which the velocity and the unknowns are looked for otherwise.
  void restart(const State& state);

 private:
  std::vector<std::string> names_;
  std::size_t coordinate_count_, first_constraint_, written_count_, first_event_;
  Function quantities_;  // x, v, z, t, what the field leaves out ↦ all but the coordinates
  std::unique_ptr<const VectorField> field_;
  bool is_field_ = false;  // whether v and z are those of the field, not those of the state
  std::optional<VectorField::Evaluation> evaluate_field_;
  VectorXd rate_, row_;
};

}  // namespace courant
