// What of some expressions stays while some of their variables change.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant {

// The largest parts of `outputs` that contain none of the variables `varying`: results of operations that are outputs
// themselves, or operands of what contains some of these variables. Worked out once, they serve for many values of
// these. In the order in which they were made, each once; constants and variables alone are not among them. Throws
// std::invalid_argument if the outputs are of two graphs.
ExprVector held_part(const ExprVector& outputs, const ExprVector& varying);

}  // namespace courant
