#include "courant/integrators/space_formulas.hpp"

#include "courant/integrators/ladder/local_formulation.hpp"

namespace courant {

SpaceFormulas::SpaceFormulas(const Manifold& M) {
  Graph graph;
  const ExprVector x = graph.variables("x", M.ambient_dimension());
  const LinearMap<Expr> B = basis_variables(graph, M);
  const ExprVector entries = basis_parameters(B);
  basis.inputs = {{"x", x}, {"basis", entries}};
  if (entries.size() > 0) basis.outputs = (M.tangent_projector(x) * B).entries().reshaped();
  constraint = {{{"x", x}}, M.constraint(x)};
}

}  // namespace courant
