#include "courant/integrators/methods/energy_imbalance.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "courant/integrators/step/step_energies.hpp"
#include "courant/structures/explicit_energy.hpp"

namespace courant {

double energy_imbalance(const Integrator& integrator, const IntegratorSetting& setting, double h) {
  const auto system = std::dynamic_pointer_cast<const EnergySystem>(setting.system);
  const auto missing = [] {
    return std::domain_error("the system has no energy that is a function on M");
  };
  if (!system) throw missing();
  Graph graph;
  const ExprVector x = graph.variables("x", system->manifold()->ambient_dimension()),
                   z = graph.variables("z", system->auxiliary_size()), t = graph.variables("t", 1);
  const auto energy = explicit_energy(*system, x, z, t[0]);
  if (!energy) throw missing();
  const Function on_M("energy", {{"x", x}, {"z", z}, {"t", t}}, ExprVector::Constant(1, *energy));
  const StepEnergies energies(system);
  const auto stepper = integrator.stepper();
  stepper->tell_parts();
  State state = setting.initial;
  stepper->prepare(state, h);
  // Multipliers do not count in H.
  const auto H = [&](const State& at) {
    return on_M({at.x, VectorXd(VectorXd::Zero(z.size())), VectorXd::Constant(1, at.t)})[0];
  };
  double worst = 0.0, size = 0.0;
  const int steps = h * setting.step > 0.0 ? 20 : 5;
  for (int k = 0; k < steps; ++k) {
    stepper->step(state, h);
    const Step& step = stepper->last();
    const StepEnergies::Energies through = energies(step);
    const double before = H(step.before), after = H(step.after);
    size = std::max(size, std::abs(before) + std::abs(after) + through.moved);
    const double defect = std::abs(after - before - through.supply() + through.loss());
    if (!(defect <= worst)) worst = defect;
  }
  return size > 0.0 ? worst / size : worst;
}

}  // namespace courant
