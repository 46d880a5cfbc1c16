// What became of some unknowns when they were changed.
#pragma once

#include <cmath>

#include "courant/core/linear/pairs.hpp"

namespace courant {

// The largest change of some unknowns, their largest size after it, and whether all changes are finite.
template <class Largest, class Total>
struct UnknownChange {
  Largest changes, sizes;
  Total total;

  // u ← u - change
  template <class Numbers>
  void move(double* u, const Numbers& change) {
    const Numbers length = magnitude(change), moved = read<Numbers>(u) - change;
    write(u, moved);
    changes.add(length);
    sizes.add(Numbers(magnitude(moved)));
    total.add(length);
  }
  bool is_finite() const { return std::isfinite(total.value()); }
};

using PairChange = UnknownChange<PairMaximum, PairSum>;

}  // namespace courant
