#include "courant/manifolds/cotangent_bundle.hpp"

#include "courant/core/expressions/derivative.hpp"

namespace courant {

ExprVector CotangentBundle::torsion(const ExprVector& q, const ExprVector& p,
                                    const ExprVector& v) const {
  // ⟨p, T(v,w)⟩ = ⟨p, dC(E v) E w⟩ - ⟨p, dC(E w) E v⟩, both linear in w: gradients of
  // q ↦ ⟨p, C(q) u⟩. Differentiated at fresh variables, then brought to (q, p, v), which may be
  // numbers or any expressions.
  const Manifold& Q = *base();
  const Index size = Q.tangent_dimension();
  Graph graph;
  const ExprVector at = graph.variables("q", Q.ambient_dimension());
  const ExprVector momentum = graph.variables("p", size);
  const ExprVector velocity = graph.variables("v", size);
  const LinearMap<Expr> E = Q.frame(at);  // the identity of Rⁿ takes no memory
  const ExprVector covector = Q.coframe(at).transpose() * momentum;  // Cᵀp, for fixed p
  const ExprVector ambient_velocity = E * velocity;
  const ExprVector along = tangent(covector, at, ambient_velocity);     // (dC(E v))ᵀ p
  const ExprVector across = pull_back(covector, at, ambient_velocity);  // w ↦ ⟨p, dC(w) E v⟩
  const ExprVector result = E.transpose() * (along - across);
  ExprVector from(at.size() + 2 * size);
  from << at, momentum, velocity;
  ExprVector to(from.size());
  const auto unit = Q.unit();  // where the torsion is the same everywhere
  to << (unit ? constants(*unit) : q), p, v;
  return substitute(result, from, to);
}

}  // namespace courant
