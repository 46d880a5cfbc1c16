#include "courant/integrators/step_energies.hpp"

#include <cmath>
#include <stdexcept>

#include "courant/core/derivative.hpp"
#include "courant/core/expr_vectors.hpp"

namespace courant {

StepEnergies::StepEnergies(std::shared_ptr<const EnergySystem> system, Backend backend)
    : size_(system->manifold()->ambient_dimension()) {
  const EnergySystem& S = *system;
  const Manifold& M = *S.manifold();
  Graph graph;
  const ExprVector x = graph.variables("x", M.ambient_dimension());
  const ExprVector v = graph.variables("v", M.tangent_dimension());
  const ExprVector alpha = graph.variables("alpha", M.tangent_dimension());
  const ExprVector z = graph.variables("z", S.auxiliary_size());
  const ExprVector t = graph.variables("t", 1);
  const EnergySystem::Powers powers = S.powers(x, v, alpha, z, t[0]);
  std::vector<Expr> all;
  for (const PortPower& port : powers.supplied) {
    suppliers_.push_back(port.port);
    all.push_back(port.power);
  }
  for (const PortPower& port : powers.dissipated) {
    dissipators_.push_back(port.port);
    all.push_back(port.power);
  }
  Expr moved = 0.0;
  for (const Expr& power : all) moved = moved + abs(power);
  for (Index i = 0; i < v.size(); ++i) moved = moved + abs(alpha[i] * v[i]);
  all.push_back(moved);
  const ExprVector rates = Eigen::Map<const ExprVector>(all.data(), std::ssize(all));
  const ExprVector E = ExprVector::Constant(1, S.generator(x, z, t[0]));
  has_time_ = depends(E, t);
  if (has_time_) suppliers_.push_back("time");
  const ExprVector differential = S.effort(x, z, t[0]);
  powers_ = Function("powers", {{"x", x}, {"v", v}, {"alpha", alpha}, {"z", z}, {"t", t}}, rates,
                     {.differentiate = {}, .backend = backend});
  powers_at_stage_ =
      Function("powers", {{"x", x}, {"v", v}, {"z", z}, {"t", t}},
               substitute(rates, alpha, differential), {.differentiate = {}, .backend = backend});
  effort_ = Function("effort", {{"x", x}, {"z", z}, {"t", t}}, differential,
                     {.differentiate = {}, .backend = backend});
  generator_ = Function("energy", {{"x", x}, {"z", z}, {"t", t}}, E,
                        {.differentiate = {}, .backend = backend});
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
  energies.moved = 0.0;
  workspace.resize(powers_.output_size());
  if (step.parts.empty()) return add(step, energies, workspace);
  for (const Step& part : step.parts) add(part, energies, workspace);
}

void StepEnergies::add(const Step& step, Energies& energies, VectorXd& powers) const {
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
  const Index ports = powers.size() - losses - 1;
  energies.supplied.head(ports) += step.h * powers.head(ports);
  energies.dissipated += step.h * powers.segment(ports, losses);
  energies.moved += std::fabs(step.h) * powers[powers.size() - 1];
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
