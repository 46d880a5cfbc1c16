#include "courant/running/measured_invariants.hpp"

#include <utility>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/integrators/step/vector_field.hpp"

namespace courant {

std::vector<MeasuredInvariant> measured_invariants(const Experiment& experiment,
                                                   const ConstraintLadder& ladder,
                                                   const std::vector<VectorXd>& states) {
  if (ladder.verdict != Verdict::regular) return {};
  const ImplicitSystem& system = *experiment.model.system;
  const Manifold& M = *system.manifold();
  Graph graph;
  const ExprVector x = graph.variables("x", M.ambient_dimension());
  const ExprVector v = graph.variables("v", M.tangent_dimension());
  const ExprVector z = graph.variables("z", system.auxiliary_size());
  const Expr t = graph.variable("t");
  std::vector<std::pair<std::string, Expr>> quantities;
  if (const auto energy = system.energy(x, z, t)) quantities.emplace_back("H", *energy);
  for (const DeclaredSymmetry& declared : experiment.symmetries)
    quantities.emplace_back(declared.name, declared.symmetry.momentum(x));
  const SymbolTable symbols = experiment.model.symbols(x, v, z, t);
  for (const Observable& observable : experiment.observe)
    if (!observable.uses_energies)
      quantities.emplace_back(observable.name, evaluate(observable.formula, symbols));
  if (quantities.empty()) return {};

  ExprVector outputs(3 * static_cast<Index>(quantities.size()));
  const ExprVector velocity = M.frame(x) * v;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const Expr& quantity = quantities[i].second;
    const ExprVector slope = gradient(quantity, x);
    Expr rate = 0.0, size = 0.0, other = 0.0;
    for (Index k = 0; k < x.size(); ++k) {
      rate += slope[k] * velocity[k];
      size += abs(slope[k] * velocity[k]);
    }
    for (const Expr& d : gradient(quantity, v)) other += abs(d);
    for (const Expr& d : gradient(quantity, z)) other += abs(d);
    other += abs(gradient(quantity, ExprVector::Constant(1, t))[0]);
    outputs.segment(3 * static_cast<Index>(i), 3) << rate, size, other;
  }
  const Function function(
      "invariants", {{"x", x}, {"v", v}, {"z", z}, {"t", ExprVector::Constant(1, t)}}, outputs);
  const VectorField field(experiment.model.system, ladder, Backend::interpreter);
  VectorField::Evaluation evaluation(field);
  VectorXd rate(x.size());
  MatrixXd worst = MatrixXd::Zero(3, static_cast<Index>(quantities.size()));
  std::vector<VectorXd> points{ladder.point.x};
  points.insert(points.end(), states.begin(), states.end());
  for (const VectorXd& at : points) {
    evaluation(at, rate, experiment.start());
    const VectorXd values =
        function({at, evaluation.v(), evaluation.z(), VectorXd::Constant(1, experiment.start())});
    worst = worst.cwiseMax(values.cwiseAbs().reshaped(3, worst.cols()));
  }
  std::vector<MeasuredInvariant> result;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const auto k = static_cast<Index>(i);
    // What depends on v, z or t changes with them too: nothing is said of it.
    if (!(worst(2, k) == 0.0)) continue;
    result.push_back({.name = quantities[i].first,
                      .rate = worst(0, k),
                      .scale = worst(1, k),
                      .is_invariant = worst(0, k) <= 1e-9 * worst(1, k) + 1e-14});
  }
  return result;
}

}  // namespace courant
