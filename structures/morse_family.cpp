#include "courant/structures/morse_family.hpp"

#include <stdexcept>

#include "courant/core/derivative.hpp"

namespace courant {

MorseFamily::MorseFamily(std::shared_ptr<const Manifold> manifold, Index k, Formula formula,
                         Formula energy)
    : GeneratingFamily(std::move(manifold), k),
      formula_(std::move(formula)),
      energy_(std::move(energy)) {
  if (!formula_)
    throw std::invalid_argument("MorseFamily::MorseFamily: the formula is missing; expected E.");
}

std::shared_ptr<const MorseFamily> pontryagin_family(
    const std::shared_ptr<const CotangentBundle>& phase_space, const ControlProblem& problem) {
  if (!phase_space || !problem.cost || !problem.dynamics)
    throw std::invalid_argument(
        "pontryagin_family: the phase space, the cost or the dynamics is missing; expected all "
        "three.");
  return std::make_shared<MorseFamily>(
      phase_space, problem.controls,
      [phase_space, problem](const ExprVector& x, const ExprVector& u, const Expr& t) {
        const ExprVector q = phase_space->position(x), p = phase_space->momentum(x);
        const ExprVector f = problem.dynamics(q, u, t);
        if (f.size() != p.size())
          throw std::invalid_argument("pontryagin_family: the dynamics has " +
                                      std::to_string(f.size()) + " entries; expected " +
                                      std::to_string(p.size()) + ", a tangent vector.");
        return p.dot(f) - problem.cost_multiplier * problem.cost(q, u, t);
      });
}

RankDecision morse_rank(const GeneratingFamily& family, const VectorXd& x, const VectorXd& lambda,
                        double t) {
  const Manifold& M = *family.manifold();
  const Index k = family.parameter_size(), n = M.tangent_dimension();
  Graph graph;
  const ExprVector parameters = graph.variables("lambda", k);
  ExprVector derivatives(n + k);
  derivatives << family.differential(constants(x), parameters, Expr(t)),
      family.stationarity(constants(x), parameters, Expr(t));
  const ExprMatrix hessian = jacobian(derivatives, parameters).dense();
  const ExprVector entries =
      substitute(ExprVector(Eigen::Map<const ExprVector>(hessian.data(), hessian.size())),
                 parameters, constants(lambda));
  MatrixXd A(n + k, k);
  A.reshaped() = values(entries);
  const MatrixXd basis = M.tangent_basis(x);
  MatrixXd B(basis.cols() + k, k);
  B << basis.transpose() * A.topRows(n), A.bottomRows(k);
  return decide_rank(B.transpose(), {.data_error = 1e-12});
}

}  // namespace courant
