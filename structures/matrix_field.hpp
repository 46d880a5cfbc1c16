// MatrixField: a matrix that depends on the point.
#pragma once

#include <functional>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// x ↦ A(x), on expressions: the matrix of a form, a bivector, of vector fields or one-forms, in the
// tangent representation of the manifold. Fields and one-forms are columns.
using MatrixField = std::function<ExprMatrix(const ExprVector& x)>;

}  // namespace courant
