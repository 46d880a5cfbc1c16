// A retraction as an object, for the manifolds that can be given several.
#pragma once

#include <functional>
#include <limits>
#include <string>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// A choice of R: TM → M that a manifold takes in its constructor and answers for in its laws
// (Manifold, M1 to M7). The functions get points and vectors of the right sizes.
struct Retraction {
  std::string name;
  std::function<ExprVector(const ExprVector& x, const ExprVector& v)> map;      // y = R_x(v)
  std::function<ExprVector(const ExprVector& x, const ExprVector& y)> inverse;  // v = R_x⁻¹(y)
  double injectivity_radius = std::numeric_limits<double>::infinity();
  bool is_geodesic = false;        // as Manifold::is_geodesic
  bool is_left_invariant = false;  // on a group: g R_x(v) = R_{gx}(v)
  // Manifold::velocity_along, or empty: by differentiation.
  std::function<ExprVector(const ExprVector& x, const ExprVector& v, const Expr& s)> velocity = {};
};

}  // namespace courant
