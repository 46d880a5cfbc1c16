#include "courant/structures/morse_family.hpp"

#include <stdexcept>

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

}  // namespace courant
