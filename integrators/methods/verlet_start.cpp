#include "courant/integrators/methods/verlet_start.hpp"

#include <vector>

#include "courant/core/expressions/derivative.hpp"
#include "courant/integrators/methods/verlet_halves.hpp"
#include "courant/integrators/step/step_solver.hpp"

namespace courant {

VerletStart::VerletStart(const VerletTrace& trace, const Manifold& manifold, const Backend& backend)
    : tangents_(trace.tangents) {
  if (trace.codimension == 0) return;
  dimension_ = manifold.dimension();
  const ExprVector& y = trace.consistent_inputs[0].variables;
  std::vector<Function::Input> of_jets = trace.consistent_inputs;
  of_jets[0].variables = y.tail(y.size() - dimension_);
  jets_ = Function(
      "jets", of_jets,
      substitute(trace.consistent, ExprVector(y.head(dimension_)), ExprVector::Zero(dimension_)),
      {.differentiate = {"y"}});
  consistent_ = Function("consistent", trace.consistent_inputs, trace.consistent,
                         {.differentiate = {"y"}, .varying = {"y"}, .backend = backend});
  found_ = Function("start", trace.consistent_inputs, trace.found, {.backend = backend});
}

void VerletStart::find(State& state, double h, const TransportedFrame& basis,
                       const std::string& method, SolverStatistics& statistics) const {
  const Index n = dimension_;
  if (n == 0) return;
  StepSolver solver(consistent_, {n, consistent_.size() - n}, method);
  VectorXd& y = solver.unknown();
  const auto begin = [&] {
    y.setZero();
    basis.coordinates_of(state.v, y.segment(n, n));
    y.segment(tangents_ * n, state.z.size()) = state.z;
  };
  begin();
  const VectorXd x = state.x;
  const double size = largest(x);
  const double scales[] = {size, auxiliary_scale(largest(state.z), size)};
  // What belongs to x as it is; where there is none, x moves, and what belongs to it.
  Newton at_x(jets_, {y.size() - n}, {});
  const Inputs jets(y.data() + n, {x.data(), basis.data(), &state.t});
  const Inputs in(y.data(), {x.data(), basis.data(), &state.t});
  if (at_x.solve(jets, scales + 1).status != Newton::Status::converged || !y.allFinite())
    solver.solve(in, scales, begin, {state.t, h}, statistics);
  VectorXd found(found_.output_size());
  found_.value(in.data(), found.data());
  StateReader(found.data()).take(state, x.size(), state.v.size(), state.z.size());
}

}  // namespace courant
