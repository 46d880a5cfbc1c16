#include "courant/running/observed_quantities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/numbers/uncertain.hpp"

namespace courant {
namespace {

// The variables that quantities are functions of.
struct Arguments {
  ExprVector x, v, z;
  Expr t;
};

// Whether a value of the function is more than its round-off, or not known.
bool is_seen(const Function& function, const std::array<VectorXd, 4>& point) {
  std::array<std::vector<Uncertain>, 4> numbers;
  std::array<const Uncertain*, 4> in;
  for (std::size_t g = 0; g < point.size(); ++g) {
    numbers[g].assign(point[g].begin(), point[g].end());
    in[g] = numbers[g].data();
  }
  std::vector<Uncertain> found(static_cast<std::size_t>(function.output_size()));
  function.taylor_with_jacobian(in.data(), 0, found.data());
  return std::ranges::any_of(found, [](const Uncertain& slope) {
    return slope.is_nonzero() || !std::isfinite(slope.value) || !std::isfinite(slope.error);
  });
}

// The same function without z if it does not depend on z though z is in it, as the energy ⟨∂L/∂w,
// w⟩ - L of L = ⟨α(q), w⟩ - H(q): its derivative by z is round-off at random arguments. There z = 0
// gives H(q) itself, without cancellation. L = |w| has no derivative there and stays as it is.
Expr without_idle(const Expr& quantity, const Arguments& at, const Manifold& manifold) {
  const ExprVector derivative = gradient(quantity, at.z);
  const std::vector<Function::Input> inputs = {
      {"x", at.x}, {"v", at.v}, {"z", at.z}, {"t", ExprVector::Constant(1, at.t)}};
  const Function slopes("slopes", inputs, derivative);
  const Function value("value", inputs, ExprVector::Constant(1, quantity));
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  const auto random = [&](Index size) {
    return VectorXd::NullaryExpr(size, [&] { return normal(generator); }).eval();
  };
  for (int trial = 0; trial < 3; ++trial) {
    const std::array<VectorXd, 4> point = {manifold.random_point(generator), random(at.v.size()),
                                           random(at.z.size()), random(1)};
    if (is_seen(slopes, point)) return quantity;
    const VectorXd at_zero = value({manifold.random_point(generator), random(at.v.size()),
                                    VectorXd::Zero(at.z.size()), random(1)});
    if (!std::isfinite(at_zero[0])) return quantity;
  }
  return substitute(quantity, at.z, ExprVector::Zero(at.z.size()));
}

// The equations that contain nothing but x and t, each with the derivatives that vanish on M_f too.
struct Constraints {
  std::vector<Expr> zeros;
  std::vector<Expr> equations;  // those of zeros that are no derivatives
};
Constraints constraints(const ImplicitSystem& system, const std::vector<int>& differentiations,
                        const Arguments& at) {
  ExprVector vz(at.v.size() + at.z.size()), xt(at.x.size() + 1), rate(at.x.size() + 1);
  vz << at.v, at.z;
  xt << at.x, at.t;
  rate << system.manifold()->frame(at.x) * at.v, Expr(1.0);
  Constraints found;
  const ExprVector equations = system.residual(at.x, at.v, at.z, at.t);
  const std::vector<bool> contains_vz = each_depends(equations, vz);
  for (Index i = 0; i < equations.size(); ++i) {
    const ExprVector equation = equations.segment(i, 1);
    const auto index = static_cast<std::size_t>(i);
    if (equation[0].is_constant() || contains_vz[index]) continue;
    found.zeros.push_back(equation[0]);
    found.equations.push_back(equation[0]);
    if (index < differentiations.size() && differentiations[index] > 1)
      found.zeros.push_back(tangent(equation, xt, rate)[0]);
  }
  return found;
}

// Whether M_f has more constraints than these: whether its codimension is higher than the rank of
// the equations among them, plus one for each derivative.
bool are_some_missing(const Constraints& found, const ConstraintLadder& ladder,
                      const Manifold& manifold, const Arguments& at) {
  if (ladder.verdict != Verdict::regular && ladder.verdict != Verdict::gauge) return false;
  const Index codimension = manifold.dimension() - ladder.degrees_of_freedom;
  const auto count = static_cast<Index>(found.equations.size());
  Index rank = static_cast<Index>(found.zeros.size()) - count;
  if (count > 0) {
    const ExprVector equations = Eigen::Map<const ExprVector>(found.equations.data(), count);
    const Function function("constraints", {{"x", at.x}, {"t", ExprVector::Constant(1, at.t)}},
                            equations, {.differentiate = {"x"}});
    const VectorXd& x = ladder.point.x;
    const MatrixXd gradients = function.jacobian({x, VectorXd::Constant(1, ladder.point.t)}) *
                               manifold.frame(x) * manifold.tangent_basis(x);
    rank += decide_rank(gradients, {.data_error = 1e-11}).rank;
  }
  return rank < codimension;
}

}  // namespace

ObservedQuantities::ObservedQuantities(const Experiment& experiment, const ConstraintLadder& ladder)
    : names(experiment.model.system->names().coordinates),
      coordinate_count(names.size()),
      defects(experiment.defects) {
  const ImplicitSystem& system = *experiment.model.system;
  const Manifold& M = *system.manifold();
  Graph graph;
  const Arguments at{graph.variables("x", M.ambient_dimension()),
                     graph.variables("v", M.tangent_dimension()),
                     graph.variables("z", system.auxiliary_size()), graph.variable("t")};
  const ExprVector t = ExprVector::Constant(1, at.t);
  const ExprVector energies = graph.variables("energies", experiment.energies.size());
  std::vector<Expr> found_quantities, found_staged;
  const auto add = [&](std::string name, const Expr& quantity) {
    names.push_back(std::move(name));
    found_quantities.push_back(quantity);
  };
  if (const auto energy = system.energy(at.x, at.z, at.t)) {
    H = static_cast<Index>(names.size());
    add("H", without_idle(*energy, at, M));
  }
  for (const Index i : {0, 1}) {
    const char* name = i == 0 ? "supplied" : "dissipated";
    if (experiment.writes_energies && experiment.energies.contains(name)) add(name, energies[i]);
  }
  if (experiment.writes_balance) {
    balance = static_cast<Index>(names.size());
    add("balance", 0.0);
  }
  for (const Defect defect : defects) {
    defect_places.push_back(static_cast<Index>(names.size()));
    add(column_of(defect), 0.0);
  }
  for (const DeclaredSymmetry& declared : experiment.symmetries)
    add(declared.name, declared.symmetry.momentum(at.x));
  SymbolTable symbols = experiment.model.symbols(at.x, at.v, at.z, at.t);
  experiment.energies.add_to(symbols, energies);
  const ExprVector effort = graph.variables("effort", M.tangent_dimension());
  const auto with_energy = std::dynamic_pointer_cast<const EnergySystem>(experiment.model.system);
  const SymbolTable at_stage =
      with_energy ? experiment.model.symbols(at.x, at.v, at.z, at.t, effort) : symbols;
  for (const Observable& observable : experiment.observe) {
    if (observable.at_stage) {
      stage_places.push_back(static_cast<Index>(names.size()));
      found_staged.push_back(evaluate(observable.formula, at_stage));
    }
    add(observable.name, observable.at_stage ? Expr(0.0) : evaluate(observable.formula, symbols));
  }
  first_sensitivity = static_cast<Index>(names.size());
  if (experiment.sensitivities)
    for (std::string& column : experiment.sensitivities->columns()) add(std::move(column), 0.0);
  sensitivity_count = static_cast<Index>(names.size()) - first_sensitivity;
  first_constraint = names.size();
  auto add_constraint = [&, count = 0](const Expr& zero) mutable {
    add("constraint[" + std::to_string(count++) + "]", zero);
  };
  const Constraints found = constraints(system, ladder.differentiations, at);
  for (const Expr& zero : found.zeros) add_constraint(zero);
  ExprVector left_out(0);
  if (are_some_missing(found, ladder, M, at)) {
    field.emplace(experiment.model.system, ladder, VectorFieldFormulas::Freedom::gauge);
    left_out = graph.variables("left_out", field->left_out.size());
    for (const Expr& zero : left_out) add_constraint(zero);
  }
  written_count = names.size();

  first_event = names.size();
  for (const Event& event : experiment.events)
    add("event[" + event.name + "]", evaluate(event.formula, symbols));
  first_reset = names.size();
  const ExprVector velocity = M.frame(at.x) * at.v;
  for (const Event& event : experiment.events) {
    const std::string name = "set[" + event.name + "]";
    for (const Event::Reset& reset : event.resets) add(name, evaluate(reset.value, symbols));
    if (!event.sets_velocities()) continue;
    for (const Expr& component : velocity) add(name, component);
  }
  const SymbolTable closed_forms = experiment.model.vocabulary.symbols({.t = at.t});
  forms.resize(static_cast<Index>(experiment.expect.deviations.size()));
  for (const Expectations::Deviation& deviation : experiment.expect.deviations) {
    forms[std::ssize(deviating)] = evaluate(deviation.form, closed_forms);
    deviating.push_back(std::ranges::find(names, deviation.quantity) - names.begin());
    names.push_back(deviation.name);
  }
  time = {"t", t};
  inputs = {{"x", at.x},           {"v", at.v}, {"z", at.z}, {"t", t}, {"left_out", left_out},
            {"energies", energies}};
  quantities = Eigen::Map<ExprVector>(found_quantities.data(), std::ssize(found_quantities));
  staged = Eigen::Map<ExprVector>(found_staged.data(), std::ssize(found_staged));
  stage_inputs = {{"x", at.x}, {"v", at.v}, {"z", at.z}, {"t", t}, {"effort", effort}};
  const bool uses_energies =
      std::any_of(experiment.observe.begin(), experiment.observe.end(),
                  [](const Observable& observable) { return observable.uses_energies; });
  if (experiment.writes_energies || uses_energies || staged.size() > 0 ||
      experiment.expect.imbalance)
    account = with_energy;
  is_field = ladder.verdict == Verdict::regular &&
             (depends(quantities, at.v) || depends(quantities, at.z));
  if (is_field && !field)
    field.emplace(experiment.model.system, ladder, VectorFieldFormulas::Freedom::none);
}

}  // namespace courant
