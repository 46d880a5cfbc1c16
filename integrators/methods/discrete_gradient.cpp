#include "courant/integrators/methods/discrete_gradient.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/integrators/step/stage_step.hpp"
#include "courant/structures/explicit_energy.hpp"

namespace courant {
namespace {

std::shared_ptr<const EnergySystem> checked(const std::shared_ptr<const ImplicitSystem>& system) {
  auto with_energy = std::dynamic_pointer_cast<const EnergySystem>(system);
  if (!with_energy)
    throw std::invalid_argument(
        "DiscreteGradient::DiscreteGradient: the system is given by its equations alone; expected "
        "one that knows its energy, such as a Hamiltonian or port-Hamiltonian system or a "
        "network.");
  Graph graph;
  if (!explicit_energy(*with_energy,
                       graph.variables("x", with_energy->manifold()->ambient_dimension()),
                       graph.variables("z", with_energy->auxiliary_size()), graph.variable("t")))
    throw std::invalid_argument(
        "DiscreteGradient::DiscreteGradient: the energy is that of a family with velocities or "
        "controls that it is not quadratic in, no function on the phase space; expected a "
        "Hamiltonian or a kinetic and a potential energy, with constraints or without.");
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
    const auto energy = [&](const ExprVector& x) {
      return explicit_energy(*system, x, at.z, at.t).value();
    };
    const ExprVector alpha = (*differential)({.w = w,
                                              .end = energy(ends.second),
                                              .start = energy(ends.first),
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
      step_(std::make_shared<const StageStep>(
          name(), this->system(), map,
          method(checked(this->system()), map, differential_, options.units), options.backend)) {}

int DiscreteGradient::order() const {
  return std::min(step_->map().order(), differential_->order());
}

bool DiscreteGradient::is_symmetric() const {
  return step_->map().is_symmetric() && differential_->is_symmetric();
}

bool DiscreteGradient::is_native() const { return step_->is_native(); }

StepProgram DiscreteGradient::program() const { return step_->program(); }

std::unique_ptr<Stepper> DiscreteGradient::do_stepper() const { return step_->stepper(); }

std::vector<StepFormulas> DiscreteGradient::do_formulas() const { return {step_->formulas()}; }

std::shared_ptr<const StepDifferential> DiscreteGradient::do_differential() const {
  return step_->differential();
}

}  // namespace courant
