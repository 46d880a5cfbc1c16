// An implicit system and its time derivatives in the chart at a point.
#pragma once

#include <vector>

#include "courant/structures/implicit_system.hpp"

namespace courant {

// The symbols of F^[k] in the chart ξ ↦ R_{x₀}(B ξ): what a step is composed from.
//
//   x(ξ) = R_{x₀}(B ξ),   v(ξ, ξ') = C(x) d/dt x(ξ)
//   F(x, v, z, t) and its total derivatives by t along (ξ', ξ'', …; z', z'', …)
//
// Where n = Ñ the basis B is the identity, and no parameter.
//
// Where n < Ñ, a block of Ñ equations that is a tangent vector or covector r (ImplicitSystem::
// tangent_blocks) stands in `equations` as Bᵀr and Ñ - n zeros: near x₀ that says the same. On curved
// spaces all of a block are differentiated as often as the one that is most often, so that nothing
// depends on B, nor on where in the chart x is.
struct LocalFormulation {
  // Traces in `graph` with chart origin `x0` (N) and basis `basis` (Ñ × n). Equation i is
  // differentiated differentiations[i] times; jets up to the order that they contain are made.
  LocalFormulation(const Graph& graph, const ImplicitSystem& system, const ExprVector& x0,
                   const LinearMap<Expr>& basis, const Expr& t,
                   const std::vector<int>& differentiations);

  std::vector<ExprVector> xi;  // ξ, ξ', ξ'', …
  std::vector<ExprVector> z;   // z, z', …
  ExprVector x, v;
  ExprVector equations;       // F_i, then the derivatives asked for, by order
  std::vector<Index> source;  // equations[j] comes from F_{source[j]}

  ExprVector nonzero_equations() const;  // without those that are the constant 0
};

// The equations F of the system near the chart origin of `basis`, each tangent block r as Bᵀr (n
// equations), which near there says the same: as many equations as are independent.
ExprVector reduced_equations(const ImplicitSystem& system, const LinearMap<Expr>& basis,
                             const ExprVector& F);

// The basis of a chart as an argument of a traced function: the identity where that holds for every
// point, else fresh variables.
LinearMap<Expr> basis_variables(const Graph& graph, const Manifold& manifold);
// The variables of the above (none if it is the identity), column by column.
ExprVector basis_parameters(const LinearMap<Expr>& basis);

}  // namespace courant
