#include "courant/structures/state.hpp"

#include <cstring>
#include <utility>

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
  // 0 · ±∞ and 0 · NaN are NaN; two numbers at a time.
  Eigen::Array2d sums = Eigen::Array2d::Zero();
  for (const VectorXd* part : {&state.x, &state.v, &state.z, &state.carried}) {
    Index i = 0;
    for (; i + 1 < part->size(); i += 2)
      sums += 0.0 * Eigen::Map<const Eigen::Array2d>(part->data() + i);
    if (i < part->size()) sums[0] += 0.0 * (*part)[i];
  }
  return sums[0] + sums[1] == 0.0;
}

}  // namespace courant
