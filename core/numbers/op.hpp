// Op: the operations that formulas are made of.
#pragma once

#include <cstddef>
#include <cstdint>

namespace courant {

// The operations that a node of an expression graph can stand for.
// clang-format off
enum class Op : std::uint8_t {
  constant, variable,
  negate, add, subtract, multiply, divide,
  sqrt, exp, log, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, abs, sign,
  power,  // aᵏ for an integer k, by repeated multiplication: every derivative is right at a = 0
  pow, atan2, min, max,
  less, less_equal, equal, logical_and, logical_or, logical_not,  // 1.0 or 0.0
  select,         // a != 0 ? b : c; the branch that is not taken may be anything, not a number included
  stumpff,        // c_k(a), see special_functions.hpp
  arccos_factor,  // g_k(a), see special_functions.hpp
};
// clang-format on

constexpr std::size_t kOpCount = static_cast<std::size_t>(Op::arccos_factor) + 1;

}  // namespace courant
