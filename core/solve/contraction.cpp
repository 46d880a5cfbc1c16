#include "courant/core/solve/contraction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "courant/core/linear/small_product.hpp"
#include "courant/core/linear/static_size.hpp"
#include "courant/core/solve/broyden_update.hpp"
#include "courant/core/solve/unknown_change.hpp"

namespace courant {
namespace {

constexpr double kLargest = std::numeric_limits<double>::max();

template <int n>
using Numbers = Eigen::Array<double, n, 1>;

// u ← u - change.
template <int n>
[[gnu::always_inline]] inline PairChange subtract(double* u, const Numbers<n>& change) {
  PairChange movement;
  for_each_pair(0, n, [&]<class Part>(Index i, Part) {
    movement.move(u + i, read<Part>(change.data() + i));
  });
  return movement;
}

double largest_change(const PairChange& movement) {
  return movement.is_finite() ? movement.changes.value() : std::numeric_limits<double>::infinity();
}

template <int n>
double improve_by(const Contraction::Workspace& at, double& size) {
  const Numbers<n> change = small_product<n>(at.inverse, at.residual);
  Eigen::Map<Numbers<n>>{at.change} = change;
  const PairChange movement = subtract<n>(at.u, change);
  size = movement.sizes.value();
  return largest_change(movement);
}

// What is looked at in every iteration is in variables of its own: the compiler cannot know that F does not
// write to the workspace, and would read places and numbers again and again.
template <int n>
[[gnu::always_inline]] inline Contraction::Result iterate_by(const Function& F, const Inputs& in,
                                                             const Contraction::Workspace& at,
                                                             const Contraction::Limits& limits) {
  const auto [inverse, u, residual, change_at, before] = at;
  const auto [scale, tolerance, slow, most, is_exact] = limits;
  const double* const* const numbers = in.data();
  double moved = 0.0, previous = 0.0, size = 0.0;
  bool has_learned = false;
  for (int iteration = 1;; ++iteration) {
    F.value_with_held(numbers, residual);
    const Numbers<n> change = small_product<n>(inverse, residual);
    const PairChange movement = subtract<n>(u, change);
    size = std::max(scale, movement.sizes.value());
    moved = contraction::relative(largest_change(movement), size);
    const bool is_first = iteration == 1;
    const bool has_converged =
        moved <= tolerance || (is_first ? is_exact && moved <= contraction::kForeseen
                                        : contraction::has_ended(moved, previous, tolerance));
    const double longest = is_first ? kLargest : slow * previous;
    if (has_converged || !(moved <= longest) || iteration >= most) {
      Eigen::Map<Numbers<n>>{change_at} = change;
      return {.has_converged = has_converged,
              .iterations = iteration,
              .moved = moved,
              .previous = previous,
              .size = size,
              .has_learned = has_learned};
    }
    if (!has_learned) {
      has_learned = !is_first && contraction::teaches(moved, previous);
      if (has_learned) {
        const double unit = 1.0 / size;
        const Numbers<n> weighted = Eigen::Map<const Numbers<n>>(before) * unit * unit;
        broyden_update(inverse, before, change.data(), weighted.data(), n);
      } else {
        Eigen::Map<Numbers<n>>{before} = change;
      }
    }
    previous = moved;
  }
}

using Iterate = decltype(&iterate_by<1>);

template <int n>
[[gnu::flatten]] Contraction::Result iterate(const Function& F, const Inputs& in,
                                             const Contraction::Workspace& at,
                                             const Contraction::Limits& limits) {
  return iterate_by<n>(F, in, at, limits);
}

#if defined(__x86_64__) && defined(__GNUC__)
// The same with instructions of three operands, which are a fifth fewer.
template <int n>
[[gnu::target("avx"), gnu::flatten]] Contraction::Result iterate_with_avx(
    const Function& F, const Inputs& in, const Contraction::Workspace& at,
    const Contraction::Limits& limits) {
  return iterate_by<n>(F, in, at, limits);
}

bool has_avx() { return __builtin_cpu_supports("avx") != 0; }
#else
template <int n>
constexpr Iterate iterate_with_avx = nullptr;

constexpr bool has_avx() { return false; }
#endif

}  // namespace

Contraction::Contraction(Index count, Instructions instructions) {
  const bool may_use_avx = instructions == Instructions::best && has_avx();
  with_static_size(count, [&](auto size) {
    constexpr int n = decltype(size)::value;
    if constexpr (n != Eigen::Dynamic) {
      iterate_ = may_use_avx ? iterate_with_avx<n> : &iterate<n>;
      improve_ = &improve_by<n>;
    }
    return 0;
  });
}

}  // namespace courant
