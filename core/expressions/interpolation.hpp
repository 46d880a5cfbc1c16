// Functions of one variable that are given by a table.
#pragma once

#include <string>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// What is between the points of a table.
//
//   steps    the value of the last point
//   linear   straight lines
//   cubic    the natural cubic spline: twice differentiable, straight at both ends
enum class Interpolation { steps, linear, cubic };

// The function through (times_i, values_i), at t; before the first point and after the last the value
// there is kept. Throws std::invalid_argument unless there are as many values as times, one at least,
// all finite, and times increase.
Expr interpolated(const VectorXd& times, const VectorXd& values, Interpolation kind, const Expr& t);

}  // namespace courant
