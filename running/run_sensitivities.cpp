#include "courant/running/run_sensitivities.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/linear/fundamental_subspaces.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/step/solve_error.hpp"
#include "courant/running/varied_start.hpp"

namespace courant {
namespace {

const std::string kSensitivities = "/sensitivities";

[[noreturn]] void refuse_method(const std::string& why) {
  throw ExperimentError(kSensitivities, why);
}

// The differential of the steps of the run, by parameters too.
std::shared_ptr<const StepDifferential> differential_of_run(const Experiment& experiment,
                                                            const ConstraintLadder& ladder,
                                                            const PreparedMethod& method,
                                                            const VariedSystem& system) {
  const auto none = [&](const std::string& by) {
    refuse_method("are not known of " + experiment.method->description +
                  ", whose steps do not know their differential" + by +
                  "; expected another method, such as \"constrain-first\" with \"midpoint\"");
  };
  if (system.count() == 0) {
    auto differential = method.integrator->differential();
    if (!differential) none("");
    return differential;
  }
  const MethodSetting plain{.system = experiment.model.system,
                            .ladder = ladder,
                            .initial = ladder.point,
                            .step = experiment.time->step,
                            .backend = Backend::interpreter,
                            .vocabulary = &experiment.model.vocabulary};
  const PreparedMethod extended =
      experiment.method->prepare({.system = system.system(),
                                  .ladder = system.ladder(),
                                  .initial = system.extended(ladder.point),
                                  .step = plain.step,
                                  .backend = Backend::interpreter,
                                  .vocabulary = plain.vocabulary,
                                  .plain = &plain,
                                  .extension = system.extension()});
  auto differential = extended.integrator->differential();
  if (!differential) none(" by parameters");
  return differential;
}

}  // namespace

RunSensitivities::RunSensitivities(const Experiment& experiment, const ConstraintLadder& ladder,
                                   const PreparedMethod& method)
    : asked_(*experiment.sensitivities),
      system_(std::make_shared<VariedSystem>(experiment, ladder)),
      differential_(differential_of_run(experiment, ladder, method, *system_)) {
  if (method.initial.x != ladder.point.x)
    refuse_method(
        "are those of a run that begins at the consistent point, and the method begins beside it; "
        "expected \"start\": \"on-manifold\"");
  const MatrixXd varied = asked_.by.empty() ? MatrixXd(ladder.point.x.size() + system_->count(), 0)
                                            : varied_start(experiment, *system_, ladder.point);
  MatrixXd growing(varied.rows(), 0);
  if (asked_.has_exponents) {
    // Of T M_f(θ) with θ as it is.
    const MatrixXd D = system_->directions(system_->extended(ladder.point));
    growing =
        system_->count() == 0
            ? D
            : MatrixXd(D * kernel(MatrixXd(D.bottomRows(system_->count())), {.data_error = 1e-10}));
  }
  start_.resize(varied.rows(), varied.cols() + growing.cols());
  start_ << varied, growing;
  memory_.values = VectorXd::Zero(std::ssize(asked_.of) * std::ssize(asked_.by));
  make_quantities(experiment);
}

void RunSensitivities::make_quantities(const Experiment& experiment) {
  Quantities made;
  for (std::size_t i = 0; i < asked_.of.size(); ++i)
    if (!asked_.of[i].coordinate) made.places.push_back(static_cast<Index>(i));
  if (made.places.empty()) return;
  const ImplicitSystem& system = *experiment.model.system;
  std::vector<std::string> names;
  for (const Parameter& parameter : asked_.parameters()) names.push_back(parameter.name);
  Graph graph;
  const ExprVector theta = add_parameters(graph, names);
  const ExprVector x = graph.variables("x", system.manifold()->ambient_dimension()),
                   v = graph.variables("v", system.manifold()->tangent_dimension()),
                   z = graph.variables("z", system.auxiliary_size());
  const Expr t = graph.variable("t");
  const SymbolTable symbols =
      words_of_state(experiment.model, experiment.symmetries, experiment.observe, x, v, z, t);
  ExprVector formulas(std::ssize(made.places));
  for (Index i = 0; i < formulas.size(); ++i) {
    const Index place = made.places[static_cast<std::size_t>(i)];
    formulas[i] =
        evaluate(WrittenFormula{asked_.of[static_cast<std::size_t>(place)].name, ""}, symbols);
  }
  needs_rates_ = depends(formulas, v) || depends(formulas, z);
  made.values =
      Function("sensitivities",
               {{"x", joined(x, theta)}, {"v", v}, {"z", z}, {"t", ExprVector::Constant(1, t)}},
               formulas, {.differentiate = {"x", "v", "z"}});
  quantities_ = std::make_shared<const Quantities>(std::move(made));
}

void RunSensitivities::begin(const State& state) {
  memory_ = {.images = start_,
             .growth = VectorXd::Zero(start_.cols() - std::ssize(asked_.by)),
             .time = 0.0,
             .values = memory_.values};
  take_values(state);
}

void RunSensitivities::advance(const Step& step) {
  const auto refuse = [&](const std::exception& error) {
    return std::domain_error(
        "The step to t = " + number_text(step.after.t) +
        " has no derivative, which the sensitivities are made of: " + without_place(error.what()));
  };
  try {
    memory_.images = (*differential_)(system_->extended(step), memory_.images);
  } catch (const std::domain_error& error) {
    throw refuse(error);
  } catch (const std::invalid_argument& error) {
    throw refuse(error);
  }
  if (const Index k = memory_.growth.size(); k > 0) {
    const MatrixXd grown = memory_.images.rightCols(k);
    const MatrixXd orthonormal = orthonormalized(grown);
    const MatrixXd factors = orthonormal.transpose() * grown;
    for (Index i = 0; i < k; ++i) memory_.growth[i] += std::log(std::fabs(factors(i, i)));
    memory_.images.rightCols(k) = orthonormal;
    memory_.time += std::fabs(step.h);
  }
  take_values(step.after);
}

// Coordinates are those of the images; v and z at the state are found anew, so that a run which goes on from it has the same.
void RunSensitivities::take_values(const State& state) {
  const Index k = std::ssize(asked_.by);
  if (k == 0) return;
  const auto varied = memory_.images.leftCols(k);
  for (std::size_t i = 0; i < asked_.of.size(); ++i)
    if (const auto& coordinate = asked_.of[i].coordinate)
      memory_.values.segment(static_cast<Index>(i) * k, k) = varied.row(*coordinate).transpose();
  if (!quantities_) return;
  const State all = system_->extended(state);
  const Index N = all.x.size(), n = state.v.size(), m = state.z.size();
  VectorXd v = state.v, z = state.z;
  MatrixXd dv = MatrixXd::Zero(n, k), dz = MatrixXd::Zero(m, k);
  if (needs_rates_) {
    const auto rates = system_->rates(all, varied);
    v = rates.v.head(n);
    z = rates.z;
    dv = rates.changes.v.topRows(n);
    dz = rates.changes.z;
  }
  const MatrixXd J = quantities_->values.jacobian({all.x, v, z, VectorXd::Constant(1, state.t)});
  const MatrixXd changes = J.leftCols(N) * varied + J.middleCols(N, n) * dv + J.rightCols(m) * dz;
  for (std::size_t i = 0; i < quantities_->places.size(); ++i)
    memory_.values.segment(quantities_->places[i] * k, k) =
        changes.row(static_cast<Index>(i)).transpose();
}

VectorXd RunSensitivities::exponents() const {
  if (!(memory_.time > 0.0)) return {};
  VectorXd exponents = memory_.growth / memory_.time;
  std::sort(exponents.begin(), exponents.end(), std::greater<>());
  return exponents;
}

Json RunSensitivities::summary(const VectorXd& last) const {
  Json json = {{"final", Json::object()}};
  Index place = 0;
  for (const Sensitivities::Quantity& quantity : asked_.of)
    for (const Sensitivities::Variable& variable : asked_.by)
      json["final"][quantity.name][variable.name] = last[place++];
  if (const VectorXd rates = exponents(); rates.size() > 0)
    json["lyapunov_exponents"] = std::vector<double>(rates.begin(), rates.end());
  return json;
}

void RunSensitivities::recall(const Memory& memory) {
  if (memory.images.rows() != start_.rows() || memory.images.cols() != start_.cols())
    throw std::invalid_argument("RunSensitivities::recall: the memory has " +
                                size_text(memory.images.rows(), memory.images.cols()) +
                                " numbers; expected " + size_text(start_.rows(), start_.cols()) +
                                ".");
  memory_ = memory;
}

std::optional<RunSensitivities> sensitivities_of_run(const Experiment& experiment,
                                                     const ConstraintLadder& ladder,
                                                     const PreparedMethod& method) {
  if (!experiment.sensitivities) return std::nullopt;
  try {
    RunSensitivities sensitivities(experiment, ladder, method);
    const auto stepper = method.integrator->stepper();
    stepper->tell_parts();
    State state = method.initial;
    sensitivities.begin(state);
    try {
      stepper->prepare(state, experiment.time->step);
      stepper->step(state, experiment.time->step);
    } catch (const SolveError&) {  // is told of by the run
      return sensitivities;
    }
    sensitivities.advance(stepper->last());
    return sensitivities;
  } catch (const ExperimentError&) {  // has its own place
    throw;
  } catch (const std::invalid_argument& error) {
    refuse_method("are not known: " + without_place(error.what()));
  } catch (const std::domain_error& error) {
    refuse_method("are not known: " + without_place(error.what()));
  }
}

}  // namespace courant
