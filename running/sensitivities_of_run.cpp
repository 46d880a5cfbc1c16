#include "courant/running/sensitivities_of_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/linear/rank_decision.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/methods/discrete_flow.hpp"
#include "courant/integrators/step/parameter_projector.hpp"
#include "courant/integrators/step/vector_field_differential.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/start_stages.hpp"

namespace courant {
namespace {

const std::string kSensitivities = "/sensitivities";

// Directions that are independent are so up to this part of their size.
constexpr double kIndependent = 1e-9;
// The first step is compared with differences of order 4, of this part of the value, which know its derivative to about ten
// digits where the value is a usual one for the formulas.
constexpr double kDifference = 1e-3;
constexpr double kSameDerivative = 1e-5;

Step extended(const ParameterExtension& with, const Step& step) {
  Step all = step;
  all.before = with.to_extended(step.before);
  all.after = with.to_extended(step.after);
  if (step.stage.x.size() > 0) all.stage = with.to_extended(step.stage);
  if (step.effort.size() > 0) {
    all.effort = VectorXd::Zero(step.effort.size() + with.count());
    all.effort.head(step.effort.size()) = step.effort;
  }
  for (Step& part : all.parts)
    if (part.h != 0.0) part = extended(with, part);
  return all;
}

// The c for which the rows of each condition in turn are as near to what they are to be as the conditions before leave
// them, of those the least one.
class Preferences {
 public:
  explicit Preferences(Index size)
      : c_(VectorXd::Zero(size)), free_(MatrixXd::Identity(size, size)) {}
  void ask(const MatrixXd& rows, const VectorXd& wanted) {
    if (rows.rows() == 0 || free_.cols() == 0) return;
    const FundamentalSubspaces spaces(rows * free_, {.data_error = kIndependent});
    c_ += free_ * spaces.pseudo_solve(wanted - rows * c_);
    free_ = (free_ * spaces.kernel()).eval();
  }
  const VectorXd& found() const { return c_; }

 private:
  VectorXd c_;
  MatrixXd free_;
};

std::vector<Index> entries_that_are(const Eigen::Array<bool, Eigen::Dynamic, 1>& flags,
                                    bool value) {
  std::vector<Index> list;
  for (Index i = 0; i < flags.size(); ++i)
    if (flags[i] == value) list.push_back(i);
  return list;
}

// Where a parameter stands in the document; empty where it does not.
Json::json_pointer place_of(const std::string& parameter, const Json& document) {
  std::string tail = parameter;
  std::replace(tail.begin(), tail.end(), '[', '/');
  std::erase(tail, ']');
  for (const char* head : {"/system/parameters/", "/system/"}) {
    const Json::json_pointer pointer(head + tail);
    if (document.contains(pointer)) return pointer;
  }
  return Json::json_pointer();
}

// The experiment up to its first step, with another value of what is differentiated by.
class ChangedExperiment {
 public:
  ChangedExperiment(const Experiment& experiment, const Sensitivities::By& by)
      : experiment_(experiment), by_(by) {
    size_ = kDifference * (by.value != 0.0 ? std::fabs(by.value) : 1.0);
    if (by.coordinate) return;
    document_ = experiment.document;
    pointer_ = place_of(by.name, document_);
    if (pointer_.empty())
      throw ExperimentError(by.pointer, "is " + in_quotes(by.name) +
                                            ", whose value stands nowhere in the experiment; "
                                            "expected a parameter that is written there");
    for (const char* key :
         {"expect", "events", "observe", "sensitivities", "defects", "output", "symmetries"})
      document_.erase(key);
    const TimeSpan& time = *experiment.time;
    Json& span = document_["time"];
    for (const char* key : {"step", "end", "start"})
      if (span.contains(key) && span[key].is_string() && is_made_of(span[key].get<std::string>()))
        throw ExperimentError(by.pointer, "is " + in_quotes(by.name) + ", which /time/" + key +
                                              " depends on; expected times that stay");
    span.erase("tolerance");
    span["step"] = time.step;
    span["end"] = time.start + time.step;
  }

  double size() const { return size_; }
  Experiment with(double change) const {
    const double value = by_.value + change;
    if (by_.coordinate) {
      Experiment changed = experiment_;
      changed.initial.x.values[*by_.coordinate] = value;
      return changed;
    }
    Json document = document_;
    document[pointer_] = value;
    return read_experiment_document(document);
  }

 private:
  bool is_made_of(const std::string& formula) const {
    const std::string name = by_.name.substr(0, by_.name.find('['));
    try {
      return std::ranges::count(names_used(formula), name) > 0;
    } catch (const FormulaError&) {
      return false;
    }
  }

  const Experiment& experiment_;
  const Sensitivities::By& by_;
  Json document_;
  Json::json_pointer pointer_;
  double size_ = 0.0;
};

// What is given at the start, as one vector.
VectorXd given(const InitialValues& initial) {
  VectorXd all(initial.x.values.size() + initial.velocity.values.size() + initial.z.values.size());
  all << initial.x.values, initial.velocity.values, initial.z.values;
  return all;
}

// By how much what is given changes with what is differentiated by: by differences of order 8, which are exact for
// polynomials of that degree.
VectorXd slope_of_given(const ChangedExperiment& changed, const Sensitivities::By& by,
                        const InitialValues& initial) {
  VectorXd slope = VectorXd::Zero(given(initial).size());
  if (by.coordinate) {
    slope[*by.coordinate] = 1.0;
    return slope;
  }
  constexpr std::array weights = {4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0};
  const double size = 10.0 * changed.size();
  if (given(changed.with(size).initial) == given(initial)) return slope;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double change = static_cast<double>(i + 1) * size;
    slope += weights[i] / size *
             (given(changed.with(change).initial) - given(changed.with(-change).initial));
  }
  return slope;
}

VectorXd first_point(const Experiment& experiment) {
  const ConsistentStart ladder = consistent_start(experiment);
  const PreparedMethod method =
      experiment.method->prepare({.system = experiment.model.system,
                                  .ladder = ladder,
                                  .initial = ladder.point,
                                  .step = experiment.time->step,
                                  .backend = Backend::interpreter,
                                  .vocabulary = &experiment.model.vocabulary});
  return method.integrator->advance(method.initial, experiment.time->step).x;
}

class Making {
 public:
  Making(const Experiment& experiment, const ConstraintLadder& ladder, const PreparedMethod& method)
      : experiment_(experiment), ladder_(ladder), method_(method), all_(*experiment.sensitivities) {
    if (ladder.gauge_dimension > 0)
      throw ExperimentError(kSensitivities,
                            "are not defined with gauge freedom, where a step is no function of "
                            "the state; expected a regular system");
    if (!experiment.initial.quantities.empty())
      throw ExperimentError(kSensitivities,
                            "need a start that is given by coordinates, velocities and unknowns; "
                            "/initial gives " +
                                in_quotes(experiment.initial.quantities.front().formula.text));
    if (method.initial.x != ladder.point.x)
      throw ExperimentError(kSensitivities,
                            "need a run that begins at the consistent point; expected the start "
                            "\"on-manifold\"");
  }

  SensitivitiesOfRun make() {
    extend();
    parts_->differential = differential();
    take_quantities();
    parts_->start.resize(system().manifold()->ambient_dimension(), std::ssize(all_.by));
    for (std::size_t j = 0; j < all_.by.size(); ++j) take_start(j);
    SensitivitiesOfRun sensitivities(parts_);
    compare_first_step(sensitivities);
    return sensitivities;
  }

 private:
  const ImplicitSystem& system() const {
    return parts_->extension ? *parts_->extension->extended() : *experiment_.model.system;
  }
  std::shared_ptr<const ImplicitSystem> shared_system() const {
    return parts_->extension ? parts_->extension->extended() : experiment_.model.system;
  }
  const ConstraintLadder& ladder() const { return extended_ ? *extended_ : ladder_; }
  State start() const {
    return parts_->extension ? parts_->extension->to_extended(ladder_.point) : ladder_.point;
  }

  void extend() {
    const std::vector<Parameter> parameters = all_.parameters();
    if (parameters.empty()) return;
    parts_->extension = std::make_shared<ParameterExtension>(experiment_.model.system, parameters);
    extended_ = extended_ladder(*parts_->extension, ladder_.point);
    if (extended_->verdict != ladder_.verdict ||
        extended_->degrees_of_freedom != ladder_.degrees_of_freedom + std::ssize(parameters))
      throw ExperimentError(kSensitivities + "/by",
                            "has parameters near whose values the constraint algorithm finds "
                            "something else: " +
                                extended_->reason);
    extended_->point = start();
  }

  std::shared_ptr<const StepDifferential> differential() const {
    const auto own = method_.integrator->differential();
    if (!own)
      throw ExperimentError(kSensitivities,
                            "need a method that knows the differential of its steps, which " +
                                method_.integrator->name() + " does not");
    if (!parts_->extension) return own;
    const MethodSetting setting{.system = experiment_.model.system,
                                .ladder = ladder_,
                                .initial = ladder_.point,
                                .step = experiment_.time->step,
                                .backend = Backend::interpreter,
                                .vocabulary = &experiment_.model.vocabulary};
    const PreparedMethod method =
        experiment_.method->prepare({.system = parts_->extension->extended(),
                                     .ladder = *extended_,
                                     .initial = start(),
                                     .step = experiment_.time->step,
                                     .backend = Backend::interpreter,
                                     .vocabulary = &experiment_.model.vocabulary,
                                     .own = &setting,
                                     .parameters = parts_->extension});
    auto found = method.integrator->differential();
    if (!found)
      throw ExperimentError(kSensitivities,
                            "need a method that knows the differential of its steps by "
                            "parameters, which " +
                                method.integrator->name() + " does not");
    return found;
  }

  void take_quantities() {
    const ImplicitSystem& own = *experiment_.model.system;
    const Manifold& M = *own.manifold();
    Graph graph;
    std::vector<std::string> names;
    for (const Parameter& parameter : all_.parameters()) names.push_back(parameter.name);
    const ExprVector theta = add_parameters(graph, names);
    const ExprVector x = graph.variables("x", M.ambient_dimension()),
                     v = graph.variables("v", M.tangent_dimension()),
                     z = graph.variables("z", own.auxiliary_size()), t = graph.variables("t", 1);
    const SymbolTable symbols = experiment_.model.symbols(x, v, z, t[0]);
    ExprVector all(std::ssize(all_.of));
    for (Index i = 0; i < all.size(); ++i)
      all[i] = quantity(all_.of[static_cast<std::size_t>(i)], x, z, t[0], symbols);
    parts_->quantities =
        Function("sensitivities", {{"x", x}, {"theta", theta}, {"v", v}, {"z", z}, {"t", t}}, all,
                 {.differentiate = {"x", "theta", "v", "z"}});
    if (depends(all, joined(v, z)) || experiment_.initial.velocity.given.any() ||
        experiment_.initial.z.given.any())
      take_field();
  }

  Expr quantity(const std::string& name, const ExprVector& x, const ExprVector& z, const Expr& t,
                const SymbolTable& symbols) const {
    const ImplicitSystem& own = *experiment_.model.system;
    const auto& coordinates = own.names().coordinates;
    if (const auto at = std::ranges::find(coordinates, name); at != coordinates.end())
      return x[at - coordinates.begin()];
    for (const DeclaredSymmetry& declared : experiment_.symmetries)
      if (declared.name == name) return declared.symmetry.momentum(x);
    for (const Observable& observable : experiment_.observe)
      if (observable.name == name) return evaluate(observable.formula, symbols);
    return own.energy(x, z, t).value();
  }

  void take_field() {
    VectorFieldFormulas formulas(shared_system(), ladder(), VectorFieldFormulas::Freedom::none);
    parts_->field_differential = std::make_shared<VectorFieldDifferential>(formulas);
    parts_->field = std::make_shared<VectorField>(std::move(formulas), Backend::interpreter);
  }

  // The direction in which the start moves.
  void take_start(std::size_t j) {
    const Sensitivities::By& by = all_.by[j];
    const InitialValues& initial = experiment_.initial;
    const Index N = initial.x.values.size();
    const MatrixXd T = consistent_directions(*system().manifold(), ladder().conormals(), start().x);
    const VectorXd slope = slope_of_given(ChangedExperiment(experiment_, by), by, initial);
    Preferences preferences(T.cols());
    const Index p = T.rows() - N;
    VectorXd theta = VectorXd::Zero(p);
    const std::vector<Parameter> parameters = all_.parameters();
    for (Index i = 0; i < p; ++i)
      if (!by.coordinate && parameters[static_cast<std::size_t>(i)].name == by.name) theta[i] = 1.0;
    preferences.ask(T.bottomRows(p), theta);
    const Manifold& M = *experiment_.model.system->manifold();
    const Index n = M.tangent_dimension(), m = experiment_.model.system->auxiliary_size();
    // (x, v, z) along the directions, and as it is asked to change. On curved spaces velocities are asked for as ẋ.
    MatrixXd along = MatrixXd::Zero(N + n + m, T.cols());
    VectorXd wanted = VectorXd::Zero(N + n + m);
    along.topRows(N) = T.topRows(N);
    wanted.head(N) = slope.head(N);
    const Index named = initial.z.values.size();
    wanted.segment(N + n, named) = slope.tail(named);
    InitialGuess guess{.t = experiment_.start(), .x = initial.x.values};
    const bool has_velocities = initial.velocity.given.any();
    MatrixXd rates;
    if (parts_->field && (has_velocities || initial.z.given.any())) {
      const State at = start();
      VectorField::Evaluation evaluation(*parts_->field);
      VectorXd rate(at.x.size());
      evaluation(at, rate);
      const auto images =
          (*parts_->field_differential)({at.x, at.t, evaluation.unknowns(), evaluation.basis()}, T);
      along.middleRows(N, n) = images.v.topRows(n);
      along.bottomRows(m) = images.z;
      rates = images.rate;
    }
    if (has_velocities && M.has_identity_frame()) {
      guess.v = initial.velocity.values;
      wanted.segment(N, n) = slope.segment(N, N);
    }
    for (const NearestStart::Stage& stage : start_stages(experiment_, guess)) {
      const LeastChange change = stage(ladder_.point);
      const MatrixXd root(change.root), rows = along(change.rows, Eigen::all);
      const VectorXd values = wanted(change.rows);
      preferences.ask(root * rows, root * values);
    }
    if (has_velocities && !M.has_identity_frame()) {
      const std::vector<Index> of_v = entries_that_are(initial.velocity.given, true);
      preferences.ask(rates(of_v, Eigen::all), slope.segment(N, N)(of_v));
    }
    const std::vector<Index> others = entries_that_are(initial.x.given, false);
    preferences.ask(T(others, Eigen::all), VectorXd::Zero(std::ssize(others)));
    parts_->start.col(static_cast<Index>(j)) = T * preferences.found();
  }

  void compare_first_step(SensitivitiesOfRun sensitivities) const {
    const double h = experiment_.time->step;
    const auto stepper = method_.integrator->stepper();
    stepper->tell_parts();
    State state = method_.initial;
    try {
      stepper->prepare(state, h);
      stepper->step(state, h);
    } catch (const SolveError&) {  // of which the run tells
      return;
    }
    sensitivities.begin();
    sensitivities.advance(stepper->last());
    for (std::size_t j = 0; j < all_.by.size(); ++j) {
      const Sensitivities::By& by = all_.by[j];
      const ChangedExperiment changed(experiment_, by);
      const double d = changed.size();
      const auto at = [&](double change) { return first_point(changed.with(change)); };
      VectorXd measured;
      try {
        measured = (8.0 * (at(d) - at(-d)) - (at(2.0 * d) - at(-2.0 * d))) / (12.0 * d);
      } catch (const SolveError&) {  // the value is at the edge of where steps can be made
        continue;
      }
      const VectorXd found =
          sensitivities.memory().images.col(static_cast<Index>(j)).head(state.x.size());
      const double size =
          std::max(measured.lpNorm<Eigen::Infinity>(), found.lpNorm<Eigen::Infinity>()) +
          1e-6 * state.x.lpNorm<Eigen::Infinity>() / (by.value != 0.0 ? std::fabs(by.value) : 1.0);
      Index worst = 0;
      if ((measured - found).cwiseAbs().maxCoeff(&worst) <= kSameDerivative * size) continue;
      throw ExperimentError(
          by.pointer,
          "is " + in_quotes(by.name) + ", by which the first step changes " +
              system().names().coordinates[static_cast<std::size_t>(worst)] + " by " +
              number_text(measured[worst]) + ", but the formulas of the step say " +
              number_text(found[worst]) +
              (by.coordinate
                   ? "; expected initial values that need not move to be consistent"
                   : "; expected a parameter that stands in formulas of the equations alone"));
    }
  }

  const Experiment& experiment_;
  const ConstraintLadder& ladder_;
  const PreparedMethod& method_;
  const Sensitivities& all_;
  std::shared_ptr<SensitivitiesOfRun::Parts> parts_ = std::make_shared<SensitivitiesOfRun::Parts>();
  std::optional<ConstraintLadder> extended_;
};

}  // namespace

SensitivitiesOfRun::SensitivitiesOfRun(std::shared_ptr<const Parts> parts)
    : parts_(std::move(parts)) {
  begin();
}

void SensitivitiesOfRun::advance(const Step& step) {
  memory_.images = (*parts_->differential)(
      parts_->extension ? extended(*parts_->extension, step) : step, memory_.images);
}

VectorXd SensitivitiesOfRun::derivatives(const State& state) const {
  const MatrixXd& X = memory_.images;
  const Index N = state.x.size(), p = X.rows() - N;
  State at = state;
  if (parts_->extension) at = parts_->extension->to_extended(state);
  const Index n = parts_->quantities.input_size(2), m = parts_->quantities.input_size(3);
  VectorXd v = VectorXd::Zero(n), z = VectorXd::Zero(m);
  MatrixXd all = X;
  if (parts_->field) {
    VectorField::Evaluation evaluation(*parts_->field);
    VectorXd rate(at.x.size());
    evaluation(at, rate);
    v = evaluation.v().head(n);
    z = evaluation.z();
    const auto images =
        (*parts_->field_differential)({at.x, at.t, evaluation.unknowns(), evaluation.basis()}, X);
    all.resize(X.rows() + n + m, X.cols());
    all << X, images.v.topRows(n), images.z;
  }
  const MatrixXd J = parts_->quantities.jacobian(
      {state.x, VectorXd(at.x.tail(p)), v, z, VectorXd::Constant(1, state.t)});
  const MatrixXd derivatives = J.leftCols(all.rows()) * all;
  return derivatives.transpose().reshaped();
}

void SensitivitiesOfRun::recall(const Memory& memory) {
  if (memory.images.rows() != parts_->start.rows() || memory.images.cols() != parts_->start.cols())
    throw std::invalid_argument("SensitivitiesOfRun::recall: the memory is " +
                                size_text(memory.images.rows(), memory.images.cols()) +
                                "; expected " +
                                size_text(parts_->start.rows(), parts_->start.cols()) + ".");
  memory_ = memory;
}

std::optional<SensitivitiesOfRun> sensitivities_of_run(const Experiment& experiment,
                                                       const ConstraintLadder& ladder,
                                                       const PreparedMethod& method) {
  if (!experiment.sensitivities) return std::nullopt;
  try {
    return Making(experiment, ladder, method).make();
  } catch (const ExperimentError&) {  // has its own place
    throw;
  } catch (const std::invalid_argument& error) {
    throw ExperimentError(kSensitivities, without_place(error.what()));
  } catch (const std::domain_error& error) {
    throw ExperimentError(kSensitivities,
                          "the first step has no tangent map: " + without_place(error.what()));
  }
}

}  // namespace courant
