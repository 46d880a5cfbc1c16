#include "courant/integrators/methods/verlet_halves.hpp"

#include <algorithm>
#include <utility>

namespace courant {

void StateReader::take(VectorXd& to, Index count) {
  to.resize(count);
  std::copy_n(at_, count, to.data());
  at_ += count;
}

void StateReader::take(State& state, Index N, Index n, Index m) {
  take(state.x, N);
  take(state.v, n);
  take(state.z, m);
}

void tell_halves(const double* numbers, Step& step, bool tells_parts) {
  const Index N = step.before.x.size(), n = step.before.v.size(), m = step.before.z.size();
  StateReader reader(numbers);
  Step first{.h = kHalf * step.h}, second = first;
  reader.take(first.stage, N, n, m);
  reader.take(first.after.x, N);
  reader.take(second.stage, N, n, m);
  first.stage.t = step.before.t;
  second.stage.t = step.before.t + step.h;
  step.stage = second.stage;
  step.parts.clear();
  if (!tells_parts) return;
  first.before = step.before;
  first.after.t = step.before.t + first.h;
  first.after.v = first.stage.v;
  first.after.z = first.stage.z;
  second.before = first.after;
  second.after = step.after;
  step.parts = {std::move(first), std::move(second)};
}

}  // namespace courant
