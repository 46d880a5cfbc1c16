#include "courant/core/contraction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "courant/core/broyden_update.hpp"
#include "courant/core/movement.hpp"
#include "courant/core/small_product.hpp"
#include "courant/core/static_size.hpp"

namespace courant {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

// change = A F, u ← u - change.
template <int n>
[[gnu::always_inline]] inline double improve_by(const Contraction::Workspace& at, double& size) {
  using Vector = Eigen::Array<double, n, 1>;
  const Vector change = small_product<n>(at.inverse, at.residual);
  Eigen::Map<Vector>{at.change} = change;
  PairMovement movement;
  for_each_pair(0, n, [&]<class Numbers>(Index i, Numbers) {
    movement.move(at.u + i, read<Numbers>(change.data() + i));
  });
  size = movement.sizes.value();
  return movement.is_finite() ? movement.changes.value() : std::numeric_limits<double>::infinity();
}

template <int n>
Contraction::Result iterate_by(const Function& F, const Inputs& in,
                               const Contraction::Workspace& at,
                               const Contraction::Limits& limits) {
  Contraction::Result result;
  double& previous = result.previous;
  for (;;) {
    ++result.iterations;
    F.value(in.data(), at.residual);
    const double change = improve_by<n>(at, result.size);
    const double size = result.size = std::max(limits.scale, result.size);
    const double moved = result.moved = contraction::relative(change, size);
    const bool is_first = result.iterations == 1;
    result.has_converged = moved <= limits.tolerance ||
                           (!is_first && contraction::has_ended(moved, previous, limits.tolerance));
    const double most = is_first ? kLargest : limits.slow * previous;
    if (result.has_converged || !(moved <= most) || result.iterations >= limits.most) return result;
    if (!result.has_learned) {
      if (!is_first && contraction::teaches(moved, previous)) {
        result.has_learned = true;
        double weighted[n];
        for (int i = 0; i < n; ++i) weighted[i] = at.before[i] / size / size;
        broyden_update(at.inverse, at.before, at.change, weighted, n);
      } else {
        std::copy_n(at.change, n, at.before);
      }
    }
    previous = moved;
  }
}

}  // namespace

Contraction::Contraction(Index count) {
  with_static_size(count, [this](auto size) {
    constexpr int n = decltype(size)::value;
    if constexpr (n != Eigen::Dynamic) {
      iterate_ = &iterate_by<n>;
      improve_ = &improve_by<n>;
    }
    return 0;
  });
}

}  // namespace courant
