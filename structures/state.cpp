#include "courant/structures/state.hpp"

#include <bit>
#include <cstdint>
#include <utility>

#include "courant/core/linear/pairs.hpp"

namespace courant {
namespace {

// Whether they are the same numbers, bit by bit: a NaN is the same as itself. In a loop, since most have a few entries,
// and a call of a function costs more.
bool same(const VectorXd& a, const VectorXd& b) {
  if (a.size() != b.size()) return false;
  std::uint64_t different = 0;
  for (Index i = 0; i < a.size(); ++i)
    different |= std::bit_cast<std::uint64_t>(a[i]) ^ std::bit_cast<std::uint64_t>(b[i]);
  return different == 0;
}

}  // namespace

void State::swap(State& other) {
  std::swap(t, other.t);
  x.swap(other.x);
  v.swap(other.v);
  z.swap(other.z);
  carried.swap(other.carried);
}

void State::take(const State& other) {
  const auto copy = [](const VectorXd& from, VectorXd& to) {
    to.resize(from.size());
    copy_pairs(from.data(), from.size(), to.data());
  };
  t = other.t;
  copy(other.x, x);
  copy(other.v, v);
  copy(other.z, z);
  copy(other.carried, carried);
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
