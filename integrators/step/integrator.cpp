#include "courant/integrators/step/integrator.hpp"

#include <stdexcept>

namespace courant {

Integrator::Integrator(std::shared_ptr<const ImplicitSystem> system) : system_(std::move(system)) {
  if (!system_) throw std::invalid_argument("Integrator::Integrator: system is null.");
}

State Integrator::advance(State state, double h, long count) const {
  if (count < 1) return state;
  const auto workspace = stepper();
  const double start = state.t;
  workspace->step(state, h, start + h);
  for (long k = 2; k <= count; ++k) workspace->go_on(h, start + static_cast<double>(k) * h);
  return workspace->ended().after;
}

}  // namespace courant
