#include "courant/integrators/step/step_energies.hpp"

#include <cmath>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"

namespace courant {

StepEnergies::Formulas::Formulas(const EnergySystem& S) {
  const Manifold& M = *S.manifold();
  const Graph graph;
  x = graph.variables("x", M.ambient_dimension());
  v = graph.variables("v", M.tangent_dimension());
  alpha = graph.variables("alpha", M.tangent_dimension());
  z = graph.variables("z", S.auxiliary_size());
  t = graph.variables("t", 1);
  const EnergySystem::Powers of = S.powers(x, v, alpha, z, t[0]);
  std::vector<Expr> all;
  for (const PortPower& port : of.supplied) {
    suppliers.push_back(port.port);
    all.push_back(port.power);
  }
  for (const PortPower& port : of.dissipated) {
    dissipators.push_back(port.port);
    all.push_back(port.power);
  }
  Expr moved = 0.0;
  for (const Expr& power : all) moved = moved + abs(power);
  for (Index i = 0; i < v.size(); ++i) moved = moved + abs(alpha[i] * v[i]);
  all.push_back(moved);
  all.push_back(ExprVector(alpha.cwiseProduct(v)).sum());
  powers = Eigen::Map<const ExprVector>(all.data(), std::ssize(all));
  generator = ExprVector::Constant(1, S.generator(x, z, t[0]));
  has_time = depends(generator, t);
  if (has_time) suppliers.push_back("time");
  effort = S.effort(x, z, t[0]);
}

ExprVector StepEnergies::Formulas::powers_at_stage() const {
  return substitute(powers, alpha, effort);
}

StepEnergies::StepEnergies(const Formulas& of, Backend backend)
    : suppliers_(of.suppliers),
      dissipators_(of.dissipators),
      has_time_(of.has_time),
      size_(of.x.size()) {
  const Function::Options compiled = {.differentiate = {}, .backend = backend};
  powers_ =
      Function("powers", {{"x", of.x}, {"v", of.v}, {"alpha", of.alpha}, {"z", of.z}, {"t", of.t}},
               of.powers, compiled);
  powers_at_stage_ = Function("powers", {{"x", of.x}, {"v", of.v}, {"z", of.z}, {"t", of.t}},
                              of.powers_at_stage(), compiled);
  effort_ = Function("effort", {{"x", of.x}, {"z", of.z}, {"t", of.t}}, of.effort, compiled);
  generator_ = Function("energy", {{"x", of.x}, {"z", of.z}, {"t", of.t}}, of.generator, compiled);
}

VectorXd StepEnergies::effort(const Step& step) const {
  if (step.effort.size() > 0) return step.effort;
  const State& at = step.stage;
  VectorXd alpha(effort_.output_size());
  const double* in[] = {at.x.data(), at.z.data(), &at.t};
  effort_.value(in, alpha.data());
  return alpha;
}

double StepEnergies::energy(const State& state) const {
  double E = 0.0;
  const double* in[] = {state.x.data(), state.z.data(), &state.t};
  generator_.value(in, &E);
  return E;
}

StepEnergies::Energies StepEnergies::operator()(const Step& step) const {
  Energies energies;
  VectorXd workspace;
  measure(step, energies, workspace);
  return energies;
}

void StepEnergies::measure(const Step& step, Energies& energies, VectorXd& workspace) const {
  energies.supplied.setZero(std::ssize(suppliers_));
  energies.dissipated.setZero(std::ssize(dissipators_));
  energies.moved = energies.stage_balance = 0.0;
  workspace.resize(powers_.output_size());
  add(step, energies, workspace);
}

void StepEnergies::add(const Step& step, Energies& energies, VectorXd& powers) const {
  for (const Step& part : step.parts) add(part, energies, powers);
  if (!step.parts.empty()) return;
  const State& at = step.stage;
  if (at.x.size() != size_)
    throw std::invalid_argument("StepEnergies: the stage of the step has " +
                                std::to_string(at.x.size()) + " entries, expected " +
                                std::to_string(size_) +
                                ". A stepper knows the parts of a step after tell_parts().");
  if (step.effort.size() > 0) {
    const double* in[] = {at.x.data(), at.v.data(), step.effort.data(), at.z.data(), &at.t};
    powers_.value(in, powers.data());
  } else {
    const double* in[] = {at.x.data(), at.v.data(), at.z.data(), &at.t};
    powers_at_stage_.value(in, powers.data());
  }
  const Index losses = energies.dissipated.size();
  const Index ports = powers.size() - losses - 2;
  energies.supplied.head(ports) += step.duration() * powers.head(ports);
  energies.dissipated += step.duration() * powers.segment(ports, losses);
  energies.moved += std::fabs(step.duration()) * powers[ports + losses];
  energies.stage_balance +=
      step.duration() *
      (powers[ports + losses + 1] - powers.head(ports).sum() + powers.segment(ports, losses).sum());
  if (!has_time_) return;
  const auto E = [&](const State& state, double t) {
    double value = 0.0;
    const double* in[] = {state.x.data(), at.z.data(), &t};
    generator_.value(in, &value);
    return value;
  };
  const double by_time = E(step.after, step.after.t) - E(step.after, at.t) + E(step.before, at.t) -
                         E(step.before, step.before.t);
  energies.supplied[ports] += by_time;
  energies.moved += std::fabs(by_time);
}

}  // namespace courant
