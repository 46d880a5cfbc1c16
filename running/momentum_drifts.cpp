#include "courant/running/momentum_drifts.hpp"

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"

namespace courant {

std::optional<VectorXd> momentum_drifts(const Experiment& experiment, const Integrator& integrator,
                                        State state) {
  constexpr Index steps = 20;
  Graph graph;
  const ExprVector x =
      graph.variables("x", experiment.model.system->manifold()->ambient_dimension());
  const auto count = static_cast<Index>(experiment.symmetries.size());
  ExprVector outputs(2 * count);
  for (Index i = 0; i < count; ++i) {
    const Symmetry& symmetry = experiment.symmetries[static_cast<std::size_t>(i)].symmetry;
    const CotangentBundle& T = *symmetry.phase_space();
    const ExprVector q = T.position(x), p = T.momentum(x);
    const ExprVector xi = T.base()->coframe(q) * symmetry.field(q);
    outputs[2 * i] = symmetry.momentum(x);
    outputs[2 * i + 1] = 0.0;
    for (Index k = 0; k < p.size(); ++k) outputs[2 * i + 1] += abs(p[k] * xi[k]);
  }
  const Function momenta("momenta", {{"x", x}}, outputs);
  MatrixXd values(2 * count, steps + 1);
  try {
    const auto stepper = integrator.stepper();
    const double start = state.t, h = experiment.time->step;
    for (Index k = 0; k <= steps; ++k) {
      if (k == 0)
        stepper->prepare(state, h);
      else
        stepper->step(state, h, start + static_cast<double>(k) * h);
      values.col(k) = momenta({state.x});
    }
  } catch (const SolveError&) {  // told by the laws of the method
    return std::nullopt;
  }
  VectorXd drifts(count);
  for (Index i = 0; i < count; ++i) {
    const double drift = (values.row(2 * i).array() - values(2 * i, 0)).abs().maxCoeff();
    drifts[i] = drift == 0.0 ? 0.0 : drift / values.row(2 * i + 1).maxCoeff();
  }
  return drifts;
}

}  // namespace courant
