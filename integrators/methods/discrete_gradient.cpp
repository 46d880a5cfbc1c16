#include "courant/integrators/methods/discrete_gradient.hpp"

#include <stdexcept>

namespace courant {
namespace {

std::shared_ptr<const EnergySystem> checked(const std::shared_ptr<const ImplicitSystem>& system) {
  auto with_energy = std::dynamic_pointer_cast<const EnergySystem>(system);
  if (!with_energy)
    throw std::invalid_argument(
        "DiscreteGradient::DiscreteGradient: the system is given by its equations alone; expected "
        "one that knows its energy, such as a Hamiltonian or port-Hamiltonian system or a "
        "network.");
  if (!with_energy->has_explicit_energy())
    throw std::invalid_argument(
        "DiscreteGradient::DiscreteGradient: the energy is that of a family with velocities or "
        "controls, no function on the phase space; expected a Hamiltonian, with constraints or "
        "without.");
  return with_energy;
}

StageStep::Method method(std::shared_ptr<const EnergySystem> system,
                         std::shared_ptr<const DiscretizationMap> map,
                         std::shared_ptr<const DiscreteDifferential> differential, VectorXd units) {
  const Manifold& M = *system->manifold();
  if (units.size() == 0) units = VectorXd::Ones(M.tangent_dimension());
  if (units.size() != M.tangent_dimension() || !(units.array() > 0.0).all())
    throw std::invalid_argument("DiscreteGradient::DiscreteGradient: units has " +
                                std::to_string(units.size()) +
                                " entries, or one that is not positive; expected " +
                                std::to_string(M.tangent_dimension()) + " sizes.");
  return [=](const StageStep::Stage& at) {
    const Manifold& manifold = *system->manifold();
    const Graph& graph = at.h.graph();
    const ExprMatrix projector = manifold.tangent_projector(at.x);
    const ExprVector w = graph.variables("w", manifold.tangent_dimension());
    const auto ends = map->forward(at.x, ExprVector(projector * w));
    const ExprVector alpha = (*differential)({.w = w,
                                              .end = system->generator(ends.second, at.z, at.t),
                                              .start = system->generator(ends.first, at.z, at.t),
                                              .v = at.h * at.v,
                                              .is_symmetric = map->is_symmetric()},
                                             units);
    const ExprVector effort = projector.transpose() * alpha;
    return StageStep::Equations{
        system->equations(at.x, at.v, effort, at.z, at.t, at.end, at.end_time), effort};
  };
}

}  // namespace

DiscreteGradient::DiscreteGradient(std::shared_ptr<const ImplicitSystem> system,
                                   std::shared_ptr<const DiscretizationMap> map,
                                   std::shared_ptr<const DiscreteDifferential> differential,
                                   const Options& options)
    : Integrator(std::move(system)),
      differential_(differential ? std::move(differential)
                                 : throw std::invalid_argument(
                                       "DiscreteGradient::DiscreteGradient: the differential is "
                                       "missing.")),
      step_(name(), this->system(), map,
            method(checked(this->system()), map, differential_, options.units), options.backend) {}

}  // namespace courant
