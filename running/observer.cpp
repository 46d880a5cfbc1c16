#include "courant/running/observer.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "courant/core/derivative.hpp"
#include "courant/core/expr_vectors.hpp"
#include "courant/core/rank_decision.hpp"

namespace courant {
namespace {

// The variables that quantities are functions of.
struct Arguments {
  ExprVector x, v, z;
  Expr t;
};

// The same function without z if it does not depend on z though z is in it, as the energy ⟨∂L/∂w,
// w⟩ - L of L = ⟨α(q), w⟩ - H(q): its derivative by z is round-off at random arguments. There z = 0
// gives H(q) itself, without cancellation. L = |w| has no derivative there and stays as it is.
Expr without_idle(const Expr& quantity, const Arguments& at, const Manifold& manifold) {
  const ExprVector derivative = gradient(quantity, at.z);
  const Function sizes(
      "idle", {{"x", at.x}, {"v", at.v}, {"z", at.z}, {"t", ExprVector::Constant(1, at.t)}},
      (ExprVector(1 + derivative.size()) << quantity, derivative).finished());
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  const auto random = [&](Index size) {
    return VectorXd::NullaryExpr(size, [&] { return normal(generator); }).eval();
  };
  for (int trial = 0; trial < 3; ++trial) {
    const VectorXd found = sizes(
        {manifold.random_point(generator), random(at.v.size()), random(at.z.size()), random(1)});
    const double derivatives = found.tail(derivative.size()).cwiseAbs().sum();
    if (!(derivatives <= 1e-13 * (1.0 + std::abs(found[0])))) return quantity;
    const VectorXd at_zero = sizes({manifold.random_point(generator), random(at.v.size()),
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
  for (Index i = 0; i < equations.size(); ++i) {
    const ExprVector equation = equations.segment(i, 1);
    if (equation[0].is_constant() || depends(equation, vz)) continue;
    found.zeros.push_back(equation[0]);
    found.equations.push_back(equation[0]);
    const auto index = static_cast<std::size_t>(i);
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

Observer::Observer(const Experiment& experiment, const ConstraintLadder& ladder, Backend backend)
    : names_(experiment.model.system->names().coordinates), coordinate_count_(names_.size()) {
  const ImplicitSystem& system = *experiment.model.system;
  const Manifold& M = *system.manifold();
  Graph graph;
  const Arguments at{graph.variables("x", M.ambient_dimension()),
                     graph.variables("v", M.tangent_dimension()),
                     graph.variables("z", system.auxiliary_size()), graph.variable("t")};
  const ExprVector t = ExprVector::Constant(1, at.t);
  const ExprVector energies = graph.variables("energies", experiment.energies.size());
  std::vector<Expr> quantities, staged;
  const auto add = [&](std::string name, const Expr& quantity) {
    names_.push_back(std::move(name));
    quantities.push_back(quantity);
  };
  if (const auto energy = system.energy(at.x, at.z, at.t)) {
    H_ = static_cast<Index>(names_.size());
    add("H", without_idle(*energy, at, M));
  }
  for (const Index i : {0, 1}) {
    const char* name = i == 0 ? "supplied" : "dissipated";
    if (experiment.writes_energies && experiment.energies.contains(name)) add(name, energies[i]);
  }
  if (experiment.writes_balance) {
    balance_ = static_cast<Index>(names_.size());
    add("balance", 0.0);
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
      stage_places_.push_back(static_cast<Index>(names_.size()));
      staged.push_back(evaluate(observable.formula, at_stage));
    }
    add(observable.name, observable.at_stage ? Expr(0.0) : evaluate(observable.formula, symbols));
  }
  first_constraint_ = names_.size();
  auto add_constraint = [&, count = 0](const Expr& zero) mutable {
    add("constraint[" + std::to_string(count++) + "]", zero);
  };
  const Constraints found = constraints(system, ladder.differentiations, at);
  for (const Expr& zero : found.zeros) add_constraint(zero);
  ExprVector left_out(0);
  if (are_some_missing(found, ladder, M, at)) {
    field_ = std::make_unique<VectorField>(experiment.model.system, ladder, backend,
                                           VectorField::Freedom::gauge);
    left_out = graph.variables("left_out", field_->left_out_count());
    for (const Expr& zero : left_out) add_constraint(zero);
  }
  written_count_ = names_.size();

  first_event_ = names_.size();
  for (const Event& event : experiment.events)
    add("event[" + event.name + "]", evaluate(event.formula, symbols));
  const SymbolTable closed_forms = experiment.model.vocabulary.symbols({.t = at.t});
  ExprVector forms(static_cast<Index>(experiment.expect.deviations.size()));
  for (const Expectations::Deviation& deviation : experiment.expect.deviations) {
    forms[std::ssize(deviating_)] = evaluate(deviation.form, closed_forms);
    deviating_.push_back(place(deviation.quantity));
    names_.push_back(deviation.name);
  }
  const Backend together = backend.together();
  forms_ = Function("closed forms", {{"t", t}}, forms, {.differentiate = {}, .backend = together});
  form_.resize(forms.size());

  const ExprVector outputs =
      Eigen::Map<ExprVector>(quantities.data(), static_cast<Index>(quantities.size()));
  quantities_ = Function("observe",
                         {{"x", at.x},
                          {"v", at.v},
                          {"z", at.z},
                          {"t", t},
                          {"left_out", left_out},
                          {"energies", energies}},
                         outputs, {.differentiate = {}, .backend = together});
  together.compile();
  const ExprVector stage_outputs =
      Eigen::Map<ExprVector>(staged.data(), static_cast<Index>(staged.size()));
  // Evaluated once a step; to compile it, and the account, takes seconds where ports are many.
  at_stage_ = Function("observe stages",
                       {{"x", at.x}, {"v", at.v}, {"z", at.z}, {"t", t}, {"effort", effort}},
                       stage_outputs);
  stage_.resize(stage_outputs.size());
  const bool uses_energies =
      std::any_of(experiment.observe.begin(), experiment.observe.end(),
                  [](const Observable& observable) { return observable.uses_energies; });
  if (with_energy && (experiment.writes_energies || uses_energies || !staged.empty() ||
                      experiment.expect.imbalance))
    account_.emplace(StepEnergies(with_energy));
  energies_ = VectorXd::Zero(energies.size());

  is_field_ =
      ladder.verdict == Verdict::regular && (depends(outputs, at.v) || depends(outputs, at.z));
  if (is_field_ && !field_)
    field_ = std::make_unique<VectorField>(experiment.model.system, ladder, backend);
  if (field_) evaluate_field_.emplace(*field_);
  row_ = VectorXd::Zero(static_cast<Index>(names_.size()));
}

Index Observer::place(const std::string& name) const {
  return std::find(names_.begin(), names_.end(), name) - names_.begin();
}

const VectorXd& Observer::row(const State& state) {
  const Index N = state.x.size();
  row_.head(N) = state.x;
  const double* v = state.v.data();
  const double* z = state.z.data();
  const double* left_out = nullptr;
  if (evaluate_field_) {
    if (is_field_)
      (*evaluate_field_)(state.x, rate_, state.t);
    else
      (*evaluate_field_)(state, rate_);
    left_out = evaluate_field_->left_out().data();
  }
  if (is_field_) {
    v = evaluate_field_->v().data();
    z = evaluate_field_->z().data();
  }
  const double* in[] = {state.x.data(), v, z, &state.t, left_out, energies_.data()};
  quantities_.value(in, row_.data() + N);
  if (balance_) row_[*balance_] = account_->balance();
  for (Index i = 0; i < stage_.size(); ++i)
    row_[stage_places_[static_cast<std::size_t>(i)]] = stage_[i];
  const double* time[] = {&state.t};
  forms_.value(time, form_.data());
  const Index first = row_.size() - form_.size();
  for (Index i = 0; i < form_.size(); ++i)
    row_[first + i] = std::fabs(row_[deviating_[static_cast<std::size_t>(i)]] - form_[i]);
  return row_;
}

void Observer::observe_stage(const State& at, const VectorXd& effort) {
  const double* in[] = {at.x.data(), at.v.data(), at.z.data(), &at.t, effort.data()};
  at_stage_.value(in, stage_.data());
}

const VectorXd& Observer::begin(const State& state) {
  if (stage_.size() > 0) {
    const Step none{.after = state, .stage = state};
    observe_stage(state, account_ ? account_->energies().effort(none) : VectorXd());
  }
  energies_.setZero();
  const VectorXd& first = row(state);
  if (account_) account_->open(first[*H_]);
  return first;
}

const VectorXd& Observer::advance(const Step& step) {
  if (account_) {
    account_->enter(step);
    take_energies();
  }
  if (stage_.size() > 0)
    observe_stage(step.stage, account_ ? account_->energies().effort(step) : VectorXd());
  row(step.after);
  if (account_) {
    account_->settle(row_[*H_]);
    if (balance_) row_[*balance_] = account_->balance();
  }
  return row_;
}

void Observer::take_energies() {
  const PowerAccount::Memory& memory = account_->memory();
  if (energies_.size() > 0)
    energies_ << account_->supplied(), account_->dissipated(), memory.supplied, memory.dissipated;
}

void Observer::recall(const PowerAccount::Memory& memory) {
  if (!account_) return;
  account_->recall(memory);
  take_energies();
}

void Observer::restart(const State& state) {
  if (!evaluate_field_) return;
  evaluate_field_->forget();
  evaluate_field_->start(state);
}

}  // namespace courant
