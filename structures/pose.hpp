// Pose: where a frame is, and how it is turned.
#pragma once

#include "courant/core/expressions/expr.hpp"

namespace courant {

// A right-handed orthonormal frame in another one: a point with coordinates x in the frame has R x + r in the other.
// R: 3 × 3, a rotation; r: 3. A value; the default is the frame itself.
struct Pose {
  ExprMatrix R = ExprMatrix::Identity(3, 3);
  ExprVector r = ExprVector::Zero(3);

  ExprVector operator*(const ExprVector& x) const { return R * x + r; }
  // The frame `inner`, which is given in this one.
  Pose operator*(const Pose& inner) const { return {R * inner.R, R * inner.r + r}; }
};

// a × b of vectors of three.
ExprVector cross_product(const ExprVector& a, const ExprVector& b);

}  // namespace courant
