// Small sizes as constants of the compiler.
#pragma once

#include <type_traits>

#include "courant/core/numbers/vectors.hpp"

namespace courant {

// f(std::integral_constant<int, size>()) for a size of 1 to 8, else with Eigen::Dynamic: for loops
// over little matrices, which cost several times as much where their length is known only at run
// time.
template <class F>
auto with_static_size(Index size, const F& f) {
  switch (size) {
    case 1:
      return f(std::integral_constant<int, 1>());
    case 2:
      return f(std::integral_constant<int, 2>());
    case 3:
      return f(std::integral_constant<int, 3>());
    case 4:
      return f(std::integral_constant<int, 4>());
    case 5:
      return f(std::integral_constant<int, 5>());
    case 6:
      return f(std::integral_constant<int, 6>());
    case 7:
      return f(std::integral_constant<int, 7>());
    case 8:
      return f(std::integral_constant<int, 8>());
    default:
      return f(std::integral_constant<int, Eigen::Dynamic>());
  }
}

}  // namespace courant
