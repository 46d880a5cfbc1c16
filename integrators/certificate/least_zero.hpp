// The zero of a map with the least value of a function.
#pragma once

#include <functional>

#include "courant/integrators/certificate/nearest_zero.hpp"

namespace courant {

// A function to make least: its value, gradient and (Gauss–Newton) Hessian by the first unknowns.
struct Quadratic {
  double value;
  VectorXd gradient;
  SparseMatrixXd hessian;
};

// From the zero `at`, the zero nearby with the least value of the objective: tangential Newton
// steps, each brought back by find_zero, halved while they do not lead downhill.
Zero least_zero(const LinearizableMap& map,
                const std::function<Quadratic(const VectorXd& y)>& objective, const Zero& at,
                const Mobility& mobility);

}  // namespace courant
