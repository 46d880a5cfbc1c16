// The halves of a step by Verlet.
#pragma once

#include "courant/integrators/step/step.hpp"

namespace courant {

// The part of h in which a half is made.
inline constexpr double kHalf = 0.5;

// The numbers of a state, one after the other.
class StateReader {
 public:
  explicit StateReader(const double* numbers) : at_(numbers) {}
  void take(VectorXd& to, Index count);
  void take(State& state, Index N, Index n, Index m);  // x, v, z

 private:
  const double* at_;
};

// Sets the stage of `step`, from `before` to `after`, and its parts, two halves, if asked for. `numbers`: x̄, v, z of
// the first half and x_m, then x̄, v, z of the second.
void tell_halves(const double* numbers, Step& step, bool tells_parts);

}  // namespace courant
