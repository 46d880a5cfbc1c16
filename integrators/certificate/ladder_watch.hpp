// LadderWatch: the certificate of the constraint algorithm along a run.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

class DerivativeArray;

// Runs the constraint algorithm again at states of a trajectory and says when the ladder that the
// method was built on no longer holds:
//
//   1. the dimensions or the verdict are others than at the start, or
//   2. a singular value that a rank counts, in the units of the start, falls to zero before the
//      next state.
//
// A value is taken to fall to zero when it is below 5 % of the largest it has had, less than half
// of what it was at the last state, and was falling before that. Where values fall at several
// levels the lowest level counts, because at higher levels the same value appears as a power. The
// second finding is how a singular configuration looks to steps that do not hit it. One object a
// run.
class LadderWatch {
 public:
  LadderWatch(std::shared_ptr<const ImplicitSystem> system, const ConstraintLadder& start);

  // Why the run should not go on from this state; empty if it may. Called in the order of time.
  std::string examine(const State& state);
  // What there is to say when a step failed after the last examination: which singular value had
  // come down to less than half of the largest it had; empty if none.
  std::string decline() const;

  // What it remembers of the states that it examined; empty before the first.
  struct Memory {
    VectorXd largest = {}, last = {}, before_last = {};  // as smallest_counted() has them
    double last_time = 0.0;
  };
  const Memory& memory() const { return memory_; }
  // Goes on as the watch over the same run that had this memory.
  void recall(Memory memory) { memory_ = std::move(memory); }

 private:
  // The smallest singular value that counts of each rank decision, level by level; as many as at
  // the start.
  VectorXd smallest_counted(const ConstraintLadder& now) const;

  std::shared_ptr<const ImplicitSystem> system_;
  ConstraintLadder start_;
  std::shared_ptr<const DerivativeArray> array_;
  VectorXd row_scale_, column_scale_;  // of the Jacobian at the start
  Memory memory_;
};

}  // namespace courant
