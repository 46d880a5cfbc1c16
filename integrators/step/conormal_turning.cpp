#include "courant/integrators/step/conormal_turning.hpp"

#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"

namespace courant {
namespace {

// What an evaluation is solved to, next to the entries of its Jacobian.
constexpr double kFoundTo = 1e-12;

}  // namespace

ConormalTurning::ConormalTurning(const VectorFieldFormulas& formulas) {
  const ExprVector &y = formulas.inputs[0].variables, &x = formulas.inputs[1].variables;
  if (formulas.inputs[2].variables.size() > 0)
    throw std::invalid_argument(
        "ConormalTurning::ConormalTurning: the basis of tangent vectors depends on the point; "
        "expected a space whose tangent vectors are dx/dt.");
  const std::vector<Function::Input> inputs = {formulas.inputs[0], formulas.inputs[1],
                                               formulas.inputs[3]};
  equations_ = Function("equations of S_f", inputs, formulas.all, {.differentiate = {"y", "x"}});
  const ExprVector lambda = graph_of(x).variables("lambda", formulas.all.size());
  Expr weighted(0.0);
  for (Index i = 0; i < lambda.size(); ++i) weighted = weighted + lambda[i] * formulas.all[i];
  slopes_ = Function("slopes of S_f", {{"lambda", lambda}, inputs[0], inputs[1], inputs[2]},
                     gradient(weighted, joined(y, x)), {.differentiate = {"y", "x"}});
}

MatrixXd ConormalTurning::operator()(const VectorFieldDifferential::Place& at,
                                     const VectorXd& alpha, const MatrixXd& directions) const {
  const VectorXd t = VectorXd::Constant(1, at.t);
  const Index unknowns = at.unknowns.size(), N = at.x.size();
  const MatrixXd J = equations_.jacobian({at.unknowns, at.x, t});
  const MatrixXd by_y = J.leftCols(unknowns), by_x = J.rightCols(N);
  const FundamentalSubspaces spaces(by_y, {.data_error = kFoundTo});
  const MatrixXd left = spaces.left_kernel();
  const VectorXd lambda =
      left * CompleteOrthogonalDecomposition(by_x.transpose() * left, kFoundTo).solve(alpha);
  const MatrixXd inverse =
      spaces.pseudo_solve(MatrixXd::Identity(by_y.rows(), by_y.rows()));  // of ∂F/∂y
  MatrixXd moves(unknowns + N, directions.cols());
  moves << -inverse * (by_x * directions), directions;
  const MatrixXd turned = slopes_.jacobian({lambda, at.unknowns, at.x, t}) * moves;
  const MatrixXd delta = -inverse.transpose() * turned.topRows(unknowns);
  return turned.bottomRows(N) + by_x.transpose() * delta;
}

}  // namespace courant
