#include "courant/integrators/methods/starting_procedure.hpp"

#include <stdexcept>

#include "courant/core/solve/newton.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/step/step_solver.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"

namespace courant {
State starting_procedure(const ImplicitSystem& system, const DiscretizationMap& map,
                         const State& initial, const VectorXd& q1, double h) {
  const auto* bundle = dynamic_cast<const CotangentBundle*>(system.manifold().get());
  if (!bundle || !map.has_inverse())
    throw std::invalid_argument("starting_procedure: the system is on " +
                                system.manifold()->name() + " with the map " + map.name() +
                                "; expected a cotangent bundle and a map with a closed inverse.");
  Graph graph;
  const Index N = bundle->base()->ambient_dimension(), n = bundle->base()->tangent_dimension();
  const ExprVector q0 = constants(initial.x.head(N));
  const ExprVector y = graph.variables("y", 2 * n + system.auxiliary_size());
  ExprVector x0(N + n), x1(N + n);
  x0 << q0, y.head(n);
  x1 << constants(q1), y.segment(n, n);
  const auto stage = map.inverse(x0, x1);
  const Function equations(
      "start", {{"y", y}},
      system.residual(stage.x, stage.v / Expr(h), y.tail(system.auxiliary_size()),
                      Expr(initial.t + map.stage_time() * h)),
      {.differentiate = {"y"}});

  VectorXd solution(y.size());
  solution << initial.x.tail(n), initial.x.tail(n), initial.z;
  const double scale = largest(solution);
  Newton newton(equations, {}, Newton::Options());
  const Newton::Result result = newton.solve(Inputs(solution.data(), {}), &scale);
  // Redundant equations are solved by least squares: that they are solved has to be seen.
  const double residual = largest(equations({solution}));
  if (result.status != Newton::Status::converged || !(residual <= 1e-9 * (1.0 + largest(solution))))
    throw SolveError(SolveError::Reason::diverged, "starting_procedure", initial.t, h,
                     "leads to the second position from no momentum, residual " +
                         number_text(residual) + "; start on the manifold instead.",
                     {residual});
  State state = initial;
  state.x.tail(n) = solution.head(n);
  return state;
}

}  // namespace courant
