// What operations are called in formulas.
#pragma once

#include "courant/core/numbers/op.hpp"

namespace courant {

// "sin", "atan2", "if": what stands before the parentheses, as courant/core/language reads it; "stumpff" and
// "arccos_factor", which only printed expressions have. Null for what is written by a sign, and for constants and
// variables.
const char* function_name(Op op);

}  // namespace courant
