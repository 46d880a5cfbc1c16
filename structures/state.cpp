#include "courant/structures/state.hpp"

#include <bit>
#include <cstdint>
#include <utility>

namespace courant {
namespace {

// Whether they are the same numbers, bit by bit: a NaN is the same as itself. By numbers, not by
// packets: a state has often just been written, and a packet would wait until that has reached the
// cache.
bool same(const VectorXd& a, const VectorXd& b) {
  if (a.size() != b.size()) return false;
  for (Index i = 0; i < a.size(); ++i)
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  return true;
}

}  // namespace

void State::swap(State& other) {
  std::swap(t, other.t);
  x.swap(other.x);
  v.swap(other.v);
  z.swap(other.z);
  carried.swap(other.carried);
}

bool operator==(const State& a, const State& b) {
  return a.t == b.t && same(a.x, b.x) && same(a.v, b.v) && same(a.z, b.z) &&
         same(a.carried, b.carried);
}

bool is_finite(const State& state) {
  // 0 · ±∞ and 0 · NaN are NaN. By numbers as above.
  double sum = 0.0;
  for (const VectorXd* part : {&state.x, &state.v, &state.z, &state.carried})
    for (Index i = 0; i < part->size(); ++i) sum += 0.0 * (*part)[i];
  return sum == 0.0;
}

}  // namespace courant
