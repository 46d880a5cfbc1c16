#include "courant/reading/experiment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "courant/core/declaration.hpp"
#include "courant/core/message.hpp"
#include "courant/reading/json_document.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// A number, or a formula of constants such as "2*pi/100"; NaN, and a problem, if it is neither.
double read_constant(const JsonReader& value, const SymbolTable& constants) {
  const auto formula = read_formula(value);
  if (!formula) return kUnknown;
  const auto number = evaluate_constants({{}, {*formula}}, constants, value.findings());
  return number ? (*number)[0] : kUnknown;
}

// The number of steps must be whole: a last step of another size would be another method.
std::optional<TimeSpan> read_time(const JsonReader& value, const SymbolTable& constants) {
  ObjectReader object(value);
  TimeSpan time;
  if (const auto start_key = object.optional("start"))
    time.start = read_constant(*start_key, constants);
  else
    object.default_value("start", 0.0);
  const auto step_key = object.required("step");
  time.step = step_key ? read_constant(*step_key, constants) : kUnknown;
  if (time.step <= 0.0) {
    step_key->expected("a number greater than 0");
    time.step = kUnknown;
  }
  const auto end_key = object.required("end");
  const double end = end_key ? read_constant(*end_key, constants) : kUnknown;
  if (std::isnan(time.start) || std::isnan(time.step) || std::isnan(end)) return std::nullopt;
  const double steps = (end - time.start) / time.step;
  if (!(steps >= 0.0 && steps <= 1e15)) {
    end_key->expected("a time after the start, at most 1e15 steps later");
    return std::nullopt;
  }
  time.steps = std::lround(steps);
  if (std::abs(steps - static_cast<double>(time.steps)) > 1e-9 * std::max(1.0, steps)) {
    end_key->problem("is " + exact_text(steps) +
                     " steps after the start; expected a whole number of them");
    return std::nullopt;
  }
  return time;
}

// Whether a name stands for a number that has no column of its own.
bool observable(const std::string& name, const ImplicitSystem& system, const SymbolTable& symbols) {
  const Symbol* symbol = symbols.find(name);
  const auto& coordinates = system.names().coordinates;
  return symbol != nullptr && symbol->shape.empty() && name != "H" && name != "constraint" &&
         name != "t" &&
         std::find(coordinates.begin(), coordinates.end(), name) == coordinates.end();
}

std::vector<Observable> read_observables(const JsonReader& value, const Model& model) {
  std::vector<Observable> observables;
  const auto entries = value.entries();
  if (!entries) return observables;
  const ImplicitSystem& system = *model.system;
  const Manifold& M = *system.manifold();
  Graph graph;
  const ExprVector x = graph.variables("x", M.ambient_dimension());
  const ExprVector z = graph.variables("z", system.auxiliary_size());
  const Expr t = graph.variable("t");
  const SymbolTable symbols = model.symbols(x, graph.variables("v", M.tangent_dimension()), z, t);
  SymbolTable taken = symbols;
  if (taken.find("H") == nullptr && system.energy(x, z, t)) taken.add("H", 0.0);
  taken.add("constraint", 0.0);
  for (const auto& [name, entry] : *entries) {
    const auto formula = read_formula(entry);
    // A quantity that has this name already is written under it.
    if (formula && formula->text == name && observable(name, *model.system, symbols)) {
      observables.push_back({name, *formula});
      continue;
    }
    try {
      if (!parse_declaration(name, taken).shape.empty())
        throw FormulaError(1, "\"" + name + "\" has a size; expected a name");
    } catch (const FormulaError& error) {
      entry.problem(std::string("key, ") + error.what());
      continue;
    }
    if (formula && check(*formula, symbols, value.findings()))
      observables.push_back({name, *formula});
  }
  return observables;
}

// Coordinates, H where there is an energy, observables: what expectations can be about.
std::vector<std::string> quantities(const Model& model,
                                    const std::vector<Observable>& observables) {
  const ImplicitSystem& system = *model.system;
  std::vector<std::string> names = system.names().coordinates;
  Graph graph;
  if (system.energy(graph.variables("x", system.manifold()->ambient_dimension()),
                    graph.variables("z", system.auxiliary_size()), graph.variable("t")))
    names.push_back("H");
  for (const Observable& observable : observables) names.push_back(observable.name);
  return names;
}

}  // namespace

Experiment read_experiment(std::string_view text) {
  return read_experiment_document(parse_json(text));
}

Json without_comments(const Json& value) {
  if (value.is_array()) {
    Json result = Json::array();
    for (const Json& entry : value) result.push_back(without_comments(entry));
    return result;
  }
  if (!value.is_object()) return value;
  Json result = Json::object();
  auto& entries = static_cast<Json::object_t::Container&>(result.get_ref<Json::object_t&>());
  for (const auto& [key, entry] : value.items())
    if (!key.starts_with("//")) entries.emplace_back(key, without_comments(entry));
  return result;
}

Experiment read_experiment_document(const Json& written) {
  const Json document = without_comments(written);
  Findings findings;
  Experiment experiment;
  {
    ObjectReader object(JsonReader(document, "", findings));
    if (const auto schema = object.optional("$schema")) schema->text();
    if (const auto run = object.optional("$run")) run->text();
    experiment.title = object.text("title", "");
    if (const auto description = object.optional("description")) description->text();
    const auto system = object.required("system");
    const auto model = system ? system_kinds().read(*system) : std::nullopt;
    const auto initial = object.required("initial");
    const auto hold = object.optional("hold");
    const auto method = object.optional("method");
    if (method) experiment.method = method_kinds().read(*method);
    const auto time = object.optional("time");
    if (time)
      experiment.time = read_time(*time, model ? model->vocabulary.symbols({}) : SymbolTable());
    if (method && !time) object.required("time");
    if (time && !method) object.required("method");
    experiment.examine = static_cast<long>(object.integer("examine", 0, 0));
    const auto weights = object.optional("weights");
    const auto observe = object.optional("observe");
    const auto events = object.optional("events");
    if (events && !time) events->problem("need a trajectory; expected \"method\" and \"time\"");
    const auto expect = object.optional("expect");
    const Json no_output = Json::object();
    const auto output = object.optional("output");
    if (!output) object.default_value("output", no_output);

    if (model) {
      experiment.model = *model;
      if (initial)
        if (const auto values = read_initial_values(*initial, hold, weights, *model))
          experiment.initial = *values;
      if (observe) experiment.observe = read_observables(*observe, *model);
      if (events) experiment.events = read_events(*events, *model);
      std::vector<std::string> event_names;
      for (const Event& event : experiment.events) event_names.push_back(event.name);
      if (expect)
        experiment.expect =
            read_expectations(*expect, model->vocabulary, quantities(*model, experiment.observe),
                              event_names, experiment.time, method || time);
    }
    experiment.output =
        read_output(output.value_or(JsonReader(no_output, "/output", findings)),
                    model ? model->vocabulary.symbols({}) : SymbolTable(),
                    model ? std::optional(quantities(*model, experiment.observe)) : std::nullopt,
                    experiment.time);
  }
  findings.require_clean();
  experiment.document = findings.completed(document);
  return experiment;
}

}  // namespace courant
