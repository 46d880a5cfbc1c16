#include "courant/structures/state.hpp"

#include <cstring>
#include <utility>

#include "courant/core/pairs.hpp"

namespace courant {
namespace {

// Whether they are the same numbers, bit by bit: a NaN is the same as itself.
bool same(const VectorXd& a, const VectorXd& b) {
  return a.size() == b.size() &&
         (a.size() == 0 || std::memcmp(a.data(), b.data(),
                                       static_cast<std::size_t>(a.size()) * sizeof(double)) == 0);
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
  const auto holds_of = [](const VectorXd& part) { return are_finite(part.data(), part.size()); };
  return holds_of(state.x) && holds_of(state.v) && holds_of(state.z) && holds_of(state.carried);
}

}  // namespace courant
