// The zero of a map at which some functions are least.
#pragma once

#include <functional>

#include "courant/integrators/certificate/nearest_zero.hpp"

namespace courant {

// Functions r(y) whose squares are to be least together, and their derivatives by the first unknowns.
struct Deviation {
  VectorXd value;
  SparseMatrixXd jacobian;
  double size = 0.0;  // of what r is a difference of
};
using DeviationMap = std::function<Deviation(const VectorXd& y)>;

// A zero where ‖r‖ is least, as far as was found.
struct LeastDeviation {
  Zero zero;
  double deviation = 0.0;  // ‖r‖
  // The part of r along the zeros, next to r: 0 where r is normal to all that the zeros nearby make of it, the
  // condition of Karush, Kuhn and Tucker. It has no units but those that r has.
  double slope = 0.0;
  // The least second derivative of ½ ‖r‖² along the zeros, 1 where they are flat: below 0 it is no minimum, and far
  // below 1 there may be others. 1 where nothing had to be known of it.
  double curvature = 1.0;

  bool is_stationary() const { return slope <= 1e-6; }
};

// From the zero `at`: steps along the zeros, each brought back by find_zero, halved while they do not lead downhill.
// They are those of Newton's method in an orthonormal basis of the zeros' tangents, with differences of the gradient
// of the Lagrangian for its second derivatives where those of r alone do not converge quickly; of more than 200
// unknowns sparse steps of Gauss and Newton.
LeastDeviation least_deviation(const LinearizableMap& map, const DeviationMap& deviation,
                               const Zero& at, const Mobility& mobility);

}  // namespace courant
