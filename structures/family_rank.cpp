#include "courant/structures/family_rank.hpp"

#include "courant/core/expressions/function.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"

namespace courant {

RankDecision family_rank(const GeneratingFamily& family, const FamilyPoint& at) {
  const Manifold& M = *family.manifold();
  const Index n = M.dimension(), k = family.parameter_size();
  Graph graph;
  const ExprVector x = graph.variables("x", M.ambient_dimension());
  const ExprVector lambda = graph.variables("lambda", k), t = graph.variables("t", 1);
  const ExprVector d_x = family.differential(x, lambda, t[0]);
  ExprVector both(d_x.size() + k);
  both << d_x, family.stationarity(x, lambda, t[0]);
  const Function derivatives("derivatives", {{"x", x}, {"lambda", lambda}, {"t", t}}, both,
                             {.differentiate = {"lambda"}});
  const MatrixXd J = derivatives.jacobian({at.x, at.lambda, VectorXd::Constant(1, at.t)});
  MatrixXd condition(n + k, k);
  condition << M.tangent_basis(at.x).transpose() * J.topRows(d_x.size()), J.bottomRows(k);
  return decide_rank(condition, {.data_error = 1e-11});
}

}  // namespace courant
