// Where steps by Verlet with constraints begin.
#pragma once

#include <string>

#include "courant/core/solve/equation_system.hpp"
#include "courant/integrators/methods/verlet_trace.hpp"
#include "courant/integrators/step/stepper.hpp"
#include "courant/integrators/step/transported_frame.hpp"

namespace courant {

// Takes a state to M_f, with the v and z that belong to x. Immutable; does nothing where M_f is M.
class VerletStart {
 public:
  VerletStart() = default;
  VerletStart(const VerletTrace& trace, const Manifold& manifold, const Backend& backend);

  // `basis`: at state.x. x stays where it is if v and z belong to it. Throws SolveError, which names `method` and h.
  void find(State& state, double h, const TransportedFrame& basis, const std::string& method,
            SolverStatistics& statistics) const;

 private:
  Index dimension_ = 0;        // of the manifold; 0 where there is nothing to do
  Index tangents_ = 0;         // so many of ξ, ξ', … are unknowns
  EquationSystem jets_;        // jets; x₀, basis, t ↦ the equations of S_f at x₀
  EquationSystem consistent_;  // (ξ, jets); x₀, basis, t ↦ the same, and those of M_f
  Function found_;             // the same ↦ x, v, z
};

}  // namespace courant
