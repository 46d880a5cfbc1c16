#include "courant/running/varied_system.hpp"

#include <cmath>
#include <random>

#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/linear/qr_decomposition.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/methods/discrete_flow.hpp"
#include "courant/integrators/step/parameter_projector.hpp"

namespace courant {
namespace {

using Variable = Sensitivities::Variable;

[[noreturn]] void refuse_variable(const Variable& variable, const std::string& why) {
  throw ExperimentError(variable.pointer, variable.name + " cannot be varied: " + why);
}

// Where the number of a parameter stands in the document.
Json& place_of_parameter(Json& document, const Variable& variable) {
  Json* place = nullptr;
  if (document.contains("system")) {
    Json& system = document["system"];
    if (system.contains("parameters") && system["parameters"].contains(variable.parameter))
      place = &system["parameters"][variable.parameter];
    else if (system.is_object() && system.contains(variable.parameter))
      place = &system[variable.parameter];
  }
  if (!place) refuse_variable(variable, "the experiment has no place for its value");
  std::vector<Json*> elements = {place};
  while (elements.front()->is_array()) {
    std::vector<Json*> inside;
    for (Json* element : elements)
      for (Json& entry : *element) inside.push_back(&entry);
    elements = std::move(inside);
    if (elements.empty()) break;
  }
  if (static_cast<std::size_t>(variable.index) >= elements.size())
    refuse_variable(variable, "its value is not one number of an array");
  return *elements[static_cast<std::size_t>(variable.index)];
}

bool is_same_time(const TimeSpan& a, const TimeSpan& b) {
  return a.start == b.start && a.step == b.step && a.steps == b.steps && a.until == b.until;
}

bool has_same_sizes(const Experiment& a, const Experiment& b) {
  const ImplicitSystem &s = *a.model.system, &r = *b.model.system;
  return s.names().coordinates == r.names().coordinates &&
         s.auxiliary_size() == r.auxiliary_size() && s.equation_count() == r.equation_count() &&
         s.manifold()->tangent_dimension() == r.manifold()->tangent_dimension() &&
         (a.initial.x.given == b.initial.x.given).all();
}

// Points near the start, with velocities and unknowns of any size.
std::vector<State> points_nearby(const Manifold& M, const State& start) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  const auto random = [&](Index size) {
    return VectorXd::NullaryExpr(size, [&] { return normal(generator); }).eval();
  };
  std::vector<State> points;
  for (const double size : {0.0, 0.01, 0.1, 0.1}) {
    State at = start;
    const VectorXd w = size * random(M.tangent_dimension());
    at.x = M.retract(start.x, (M.tangent_projector(start.x) * w).eval());
    at.v = random(M.tangent_dimension());
    at.z = start.z + random(start.z.size());
    at.t = start.t + size;
    points.push_back(at);
  }
  return points;
}

bool differs(const VectorXd& a, const VectorXd& b) {
  constexpr double round_off = 1e-9;
  if (!a.allFinite() || !b.allFinite()) return false;
  return (a - b).size() > 0 &&
         (a - b).lpNorm<Eigen::Infinity>() > round_off * (1.0 + a.lpNorm<Eigen::Infinity>());
}

VectorXd energy_of(const ImplicitSystem& system, const State& at) {
  const auto H = system.energy(constants(at.x), constants(at.z), Expr(at.t));
  return H && H->is_constant() ? VectorXd::Constant(1, H->value()) : VectorXd();
}

// Compares the extended system with the one that is read with another number.
void require_formulas(const Experiment& experiment, const Variable& variable, Index parameter,
                      const ParameterExtension& extension, const State& start) {
  const double other = variable.value == 0.0 ? 1e-2 : 1.01 * variable.value;
  const auto read = [&] {
    try {
      return with_number(experiment, variable, other);
    } catch (const ExperimentError& error) {
      refuse_variable(variable, "the experiment is none with " + number_text(other) +
                                    " in its place (" + error.problems().front().where + " " +
                                    error.problems().front().what + ")");
    }
  };
  const Experiment changed = read();
  if (!has_same_sizes(experiment, changed))
    refuse_variable(variable, "it decides how many coordinates, equations or unknowns there are");
  if (!is_same_time(*experiment.time, *changed.time))
    refuse_variable(
        variable, "the times of the steps are made of it, and derivatives by these are not known");
  const ImplicitSystem& system = *changed.model.system;
  const Manifold &M = *experiment.model.system->manifold(), &N = *system.manifold();
  const auto refuse_number = [&](const std::string& what) {
    refuse_variable(variable, what +
                                  " of the system is made of it as a number when the file is read, "
                                  "and its derivative by it is not known");
  };
  for (const State& at : points_nearby(M, start)) {
    if (M.name() != N.name() || N.point_defect(at.x) > 1e-9 * (1.0 + at.x.norm()))
      refuse_number("the space");
    State all = extension.to_extended(at);
    all.x[at.x.size() + parameter] = other;
    const VectorXd F = extension.extended()->residual(all.x, all.v, all.z, all.t);
    VectorXd own(F.size() - extension.count());
    const Index first = extension.first_rate();
    own << F.head(first), F.tail(own.size() - first);
    if (differs(system.residual(at.x, at.v, at.z, at.t), own)) refuse_number("an equation");
    if (differs(energy_of(system, at), energy_of(*extension.extended(), all)))
      refuse_number("the energy");
  }
}

void require_same_certificate(const Experiment& experiment, const ConstraintLadder& own,
                              const ConstraintLadder& extended, Index count) {
  if (extended.verdict == own.verdict &&
      extended.degrees_of_freedom == own.degrees_of_freedom + count)
    return;
  throw ExperimentError("/sensitivities/by",
                        "has parameters near which the certificate is another one: with them as "
                        "coordinates the system is " +
                            to_string(extended.verdict) + " with " +
                            std::to_string(extended.degrees_of_freedom) +
                            " degrees of freedom; expected " + to_string(own.verdict) + " with " +
                            std::to_string(own.degrees_of_freedom + count) + " for " +
                            std::to_string(experiment.sensitivities->by.size()) + " names");
}

}  // namespace

Experiment with_number(const Experiment& experiment, const Variable& variable, double value) {
  if (variable.kind == Variable::Kind::parameter) {
    Json document = experiment.document;
    place_of_parameter(document, variable) = value;
    return read_experiment_document(document);
  }
  Experiment changed = experiment;
  InitialValues& initial = changed.initial;
  switch (variable.kind) {
    case Variable::Kind::coordinate:
      initial.x.values[variable.index] = value;
      break;
    case Variable::Kind::velocity:
      initial.velocity.values[variable.index] = value;
      break;
    case Variable::Kind::unknown:
      initial.z.values[variable.index] = value;
      break;
    default:
      initial.quantities[static_cast<std::size_t>(variable.index)].value = value;
  }
  return changed;
}

VariedSystem::VariedSystem(const Experiment& experiment, const ConstraintLadder& ladder)
    : system_(experiment.model.system), ladder_(ladder) {
  if (ladder.verdict != Verdict::regular)
    throw ExperimentError(
        "/sensitivities",
        "need a regular system, of which a point says how it moves; the verdict is \"" +
            to_string(ladder.verdict) + "\"");
  if (const auto parameters = experiment.sensitivities->parameters(); !parameters.empty()) {
    extension_.emplace(system_, parameters);
    system_ = extension_->extended();
    Index place = 0;
    for (const Variable& variable : experiment.sensitivities->by)
      if (variable.kind == Variable::Kind::parameter)
        require_formulas(experiment, variable, place++, *extension_, ladder.point);
    ladder_ = extended_ladder(*extension_, ladder.point);
    require_same_certificate(experiment, ladder, ladder_, count());
  }
  VectorField field(system_, ladder_, Backend::interpreter);
  VectorFieldDifferential differential(field.formulas());
  field_ = std::make_shared<const Field>(Field{std::move(field), std::move(differential)});
}

State VariedSystem::extended(const State& state) const {
  return extension_ ? extension_->to_extended(state) : state;
}

Step VariedSystem::extended(const Step& step) const {
  if (!extension_) return step;
  Step all = step;
  for (State* state : {&all.before, &all.after, &all.stage}) *state = extended(*state);
  all.parts.clear();
  for (const Step& part : step.parts) all.parts.push_back(extended(part));
  return all;
}

MatrixXd VariedSystem::directions(const State& at) const {
  const Manifold& M = *system_->manifold();
  const Index codimension = M.dimension() - ladder_.degrees_of_freedom;
  if (codimension == 0) return orthonormalized(consistent_directions(M, MatrixXd(), at.x));
  VectorField::Evaluation evaluation(field_->field);
  VectorXd rate(at.x.size());
  evaluation(at, rate);
  const MatrixXd inside = field_->differential.constrained_directions(
      {at.x, at.t, evaluation.unknowns(), evaluation.basis()}, codimension);
  return orthonormalized((M.frame(at.x) * evaluation.basis()).matrix() * inside);
}

VariedSystem::Rates VariedSystem::rates(const State& at, const MatrixXd& V) const {
  VectorField::Evaluation evaluation(field_->field);
  VectorXd rate(at.x.size());
  evaluation(at, rate);
  return {evaluation.v(), evaluation.z(),
          field_->differential({at.x, at.t, evaluation.unknowns(), evaluation.basis()}, V)};
}

}  // namespace courant
