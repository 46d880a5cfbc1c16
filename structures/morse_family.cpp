#include "courant/structures/morse_family.hpp"

#include <stdexcept>
#include <vector>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"

namespace courant {
namespace {

// Whether those rows of ∂_λ(∂_x E, ∂_λ E) that are constant have rank k. On a curved manifold ∂_x is
// along the frame, so that only momenta of flat ones count.
bool is_morse_everywhere(const CotangentBundle& phase_space, Index k,
                         const MorseFamily::Formula& formula) {
  if (k == 0) return true;
  Graph graph;
  const ExprVector x = graph.variables("x", phase_space.ambient_dimension());
  const ExprVector lambda = graph.variables("lambda", k);
  const Expr E = formula(x, lambda, graph.variable("t"));
  ExprVector slopes = gradient(E, lambda);
  const Manifold& Q = *phase_space.base();
  if (Q.dimension() == Q.tangent_dimension()) {
    const ExprVector rate = gradient(E, phase_space.momentum(x));
    slopes.conservativeResize(k + rate.size());
    slopes.tail(rate.size()) = rate;
  }
  const ExprMatrix condition = jacobian(slopes, lambda).dense();
  std::vector<Index> constant_rows;
  for (Index i = 0; i < condition.rows(); ++i) {
    bool is_constant = true;
    for (Index j = 0; j < k; ++j) is_constant = is_constant && condition(i, j).is_constant();
    if (is_constant) constant_rows.push_back(i);
  }
  if (constant_rows.empty()) return false;
  const MatrixXd rows = values(ExprMatrix(condition(constant_rows, Eigen::all)));
  return decide_rank(rows, {.data_error = 1e-11}).rank == k;
}

}  // namespace

MorseFamily::MorseFamily(std::shared_ptr<const Manifold> manifold, Index k, Formula formula,
                         Formula energy, std::optional<bool> is_morse)
    : GeneratingFamily(std::move(manifold), k),
      formula_(std::move(formula)),
      energy_(std::move(energy)),
      is_morse_(is_morse) {
  if (!formula_)
    throw std::invalid_argument("MorseFamily::MorseFamily: the formula is missing; expected E.");
}

std::shared_ptr<const MorseFamily> pontryagin_family(
    const std::shared_ptr<const CotangentBundle>& phase_space, const ControlProblem& problem) {
  if (!phase_space || !problem.cost || !problem.dynamics)
    throw std::invalid_argument(
        "pontryagin_family: the phase space, the cost or the dynamics is missing; expected all "
        "three.");
  const MorseFamily::Formula family =
      [phase_space, problem](const ExprVector& x, const ExprVector& u, const Expr& t) -> Expr {
    const ExprVector q = phase_space->position(x), p = phase_space->momentum(x);
    const ExprVector f = problem.dynamics(q, u, t);
    if (f.size() != p.size())
      throw std::invalid_argument("pontryagin_family: the dynamics has " +
                                  std::to_string(f.size()) + " entries; expected " +
                                  std::to_string(p.size()) + ", a tangent vector.");
    return p.dot(f) - problem.cost_multiplier * problem.cost(q, u, t);
  };
  return std::make_shared<MorseFamily>(
      phase_space, problem.controls, family, MorseFamily::Formula(),
      is_morse_everywhere(*phase_space, problem.controls, family) ? std::optional(true)
                                                                  : std::nullopt);
}

}  // namespace courant
