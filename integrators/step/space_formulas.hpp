// SpaceFormulas: what keeps points on a manifold, and bases tangent to it.
#pragma once

#include "courant/core/expressions/function.hpp"
#include "courant/manifolds/manifold.hpp"

namespace courant {

// As TransportedFrame and RoundOffProjection evaluate it, and programs in other languages.
struct SpaceFormulas {
  explicit SpaceFormulas(const Manifold& M);

  Function::Formulas basis;  // (x, B) ↦ Π(x) B, column by column; nothing where B is the identity
  Function::Formulas constraint;  // x ↦ constraint(x)

  bool has_basis() const { return basis.outputs.size() > 0; }
  bool has_equations() const { return constraint.outputs.size() > 0; }
};

}  // namespace courant
