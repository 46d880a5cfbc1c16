// Values of matrix fields in the equations of a structure.
#pragma once

#include <memory>
#include <string>

#include "courant/manifolds/manifold.hpp"
#include "courant/structures/matrix_field.hpp"

namespace courant {

// Ñ, or 0 of none: for the first argument of a base, before it is asked whether there is a manifold.
Index tangent_size(const std::shared_ptr<const Manifold>& manifold);

// A(x). Throws std::invalid_argument, with the names of structure and matrix, if it is not rows × columns.
ExprMatrix matrix_at(const MatrixField& field, const ExprVector& x, Index rows, Index columns,
                     const std::string& name, const char* matrix);

// v = Λ α + X u, Xᵀα = 0, as a residual.
ExprVector restricted_residual(const ExprMatrix& lambda, const ExprMatrix& X, const ExprVector& v,
                               const ExprVector& alpha, const ExprVector& u);

}  // namespace courant
