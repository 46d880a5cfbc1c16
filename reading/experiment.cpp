#include "courant/reading/experiment.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "courant/core/language/declaration.hpp"
#include "courant/core/words/message.hpp"
#include "courant/reading/branch.hpp"
#include "courant/reading/energy_words.hpp"
#include "courant/reading/expectation_entries.hpp"
#include "courant/reading/json_document.hpp"
#include "courant/reading/method_in_units.hpp"
#include "courant/reading/repetition.hpp"
#include "courant/reading/substepping.hpp"
#include "courant/reading/system_kinds.hpp"
#include "courant/reading/transformed_time.hpp"
#include "courant/reading/unused_parameters.hpp"
#include "courant/structures/energy_system.hpp"

namespace courant {
namespace {

// A step that a tolerance chooses is not longer than this part of the run.
constexpr double kLongestSteps = 1000.0;

constexpr double kUnread = std::numeric_limits<double>::quiet_NaN();

// A number, or a formula of constants such as "2*pi/100"; NaN, and a problem, if it is neither.
double read_constant(const JsonReader& value, const SymbolTable& constants) {
  const auto formula = read_formula(value);
  if (!formula) return kUnread;
  const auto number = evaluate_constants({{}, {*formula}}, constants, value.findings());
  return number ? (*number)[0] : kUnread;
}

// A step > 0, or a period and how many steps it has. NaN, and a problem, if it is neither.
double read_step(const JsonReader& value, const SymbolTable& constants) {
  const auto positive = [&](const JsonReader& entry) {
    const double number = read_constant(entry, constants);
    if (!(number <= 0.0)) return number;
    entry.expected("a number greater than 0");
    return kUnread;
  };
  if (!value.value().is_object()) return positive(value);
  ObjectReader object(value);
  const auto period = object.required("period"), steps = object.required("steps");
  const auto count = steps ? steps->integer(1) : std::nullopt;
  const double time = period ? positive(*period) : kUnread;
  return count ? time / static_cast<double>(*count) : kUnread;
}

// The number of steps must be whole: a last step of another size would be another method. In transformed
// time steps are of all sizes.
std::optional<TimeSpan> read_time(const JsonReader& value, const SymbolTable& constants,
                                  const std::optional<JsonReader>& interval) {
  ObjectReader object(value);
  TimeSpan time;
  if (const auto start_key = object.optional("start"))
    time.start = read_constant(*start_key, constants);
  else
    object.default_value("start", 0.0);
  if (const auto tolerance = object.optional("tolerance"))
    time.tolerance = tolerance->positive_number();
  const auto step_key = time.tolerance ? object.optional("step") : object.required("step");
  time.is_chosen = step_key.has_value();
  time.step = step_key ? read_step(*step_key, constants) : kUnread;
  const auto rate_key = object.optional("transformation");
  if (rate_key) time.rate = read_formula(*rate_key);
  if (rate_key && !time.rate) return std::nullopt;
  time.division = read_division(object, constants);
  const auto end_key = object.required("end");
  const double end = end_key ? read_constant(*end_key, constants) : kUnread;
  if (!time.is_chosen) {
    if (rate_key) object.required("step");  // which is one of another time
    time.step = interval ? read_constant(*interval, constants) : (end - time.start) / kLongestSteps;
    // So that a whole number of them makes the run.
    const double count = std::round((end - time.start) / time.step);
    if (count >= 1.0) time.step = (end - time.start) / count;
  }
  if (std::isnan(time.start) || std::isnan(time.step) || std::isnan(end)) return std::nullopt;
  if (time.rate) {
    time.until = end;
    time.steps = end > time.start ? std::numeric_limits<long>::max() : 0;
    if (end >= time.start && std::isfinite(end)) return time;
    end_key->expected("a time after the start");
    return std::nullopt;
  }
  const double steps = (end - time.start) / time.step;
  if (!(steps >= 0.0 && steps <= 1e15)) {
    end_key->expected("a time after the start, at most 1e15 steps later");
    return std::nullopt;
  }
  time.steps = std::lround(steps);
  const double latest = std::max(std::abs(time.start), std::abs(end));
  const double apart = std::nextafter(latest, std::numeric_limits<double>::infinity()) - latest;
  if (step_key && time.steps > 0 && time.step < apart) {
    step_key->problem("is " + exact_text(time.step) + "; at t = " + exact_text(latest) +
                      " numbers are " + exact_text(apart) + " apart, expected a longer step");
    return std::nullopt;
  }
  if (std::abs(steps - static_cast<double>(time.steps)) > 1e-9 * std::max(1.0, steps)) {
    const double whole = std::max(1.0, std::round(steps));
    end_key->problem("is " + exact_text(steps) +
                     " steps after the start; expected a whole number of them, as with a step of " +
                     exact_text((end - time.start) / whole));
    return std::nullopt;
  }
  return time;
}

// The method in the time of a formula of coordinates and t.
void transform_time(const WrittenFormula& rate, const Model& model, Findings& findings,
                    Experiment& experiment) {
  Graph graph;
  const ExprVector x = graph.variables("x", model.system->manifold()->ambient_dimension());
  const SymbolTable symbols = model.vocabulary.symbols({.x = x, .t = graph.variable("t")});
  if (check(rate, symbols, findings) && experiment.method)
    experiment.method = in_transformed_time(std::move(*experiment.method), rate);
}

// Whether a name stands for a number that has no column of its own.
bool observable(const std::string& name, const ImplicitSystem& system, const SymbolTable& symbols) {
  const Symbol* symbol = symbols.find(name);
  const auto& coordinates = system.names().coordinates;
  return symbol != nullptr && symbol->shape.empty() && name != "H" && name != "constraint" &&
         name != "t" &&
         std::find(coordinates.begin(), coordinates.end(), name) == coordinates.end();
}

// The formula of an observable, or {"formula": …, "at": "node" or "stage"}.
std::optional<Observable> read_observable(const std::string& name, const JsonReader& entry,
                                          const SymbolTable& constants) {
  const auto read = [&](const JsonReader& value) {
    auto formula = read_formula(value);
    const auto text = formula ? Repetition::Turn(constants, "")
                                    .filled(formula->text, formula->pointer, value.findings())
                              : std::nullopt;
    if (!text) return std::optional<WrittenFormula>();
    formula->text = *text;
    return formula;
  };
  if (!entry.value().is_object()) {
    const auto formula = read(entry);
    return formula ? std::optional(Observable{name, *formula}) : std::nullopt;
  }
  ObjectReader object(entry);
  const auto key = object.required("formula");
  const auto formula = key ? read(*key) : std::nullopt;
  const bool at_stage = object.word("at", "node", {"node", "stage"}) == "stage";
  return formula ? std::optional(Observable{name, *formula, at_stage}) : std::nullopt;
}

// Whether a formula has one of the names in it.
bool is_made_of(const WrittenFormula& formula, const NameList& names) {
  try {
    const auto used = names_used(formula.text);
    return std::any_of(used.begin(), used.end(),
                       [&](const std::string& name) { return names.contains(name); });
  } catch (const FormulaError&) {  // is told of later
    return false;
  }
}

bool is_energy_column(const std::string& name) {
  return name == "supplied" || name == "dissipated" || name == "balance";
}

// The words for energies that no observable is called by.
NameList left_words(const NameList& words, const std::vector<Observable>& observables) {
  NameList left;
  for (const Declaration& declaration : words.declarations()) {
    const bool is_used =
        std::any_of(observables.begin(), observables.end(), [&](const Observable& observable) {
          return observable.name == declaration.name && observable.formula.text != declaration.name;
        });
    if (is_used)
      left.append_unnamed(declaration.size());
    else
      left.append(declaration);
  }
  return left;
}

std::vector<Observable> read_observables(const JsonReader& value, const Model& model,
                                         Experiment& experiment) {
  NameList& energies = experiment.energies;
  std::vector<Observable> observables;
  const auto entries = value.entries();
  if (!entries) return observables;
  std::vector<Observable> written;
  std::vector<JsonReader> places;
  const SymbolTable constants = model.vocabulary.symbols({});
  for (const auto& [name, entry] : *entries)
    if (auto observable = read_observable(name, entry, constants)) {
      written.push_back(std::move(*observable));
      places.push_back(entry);
    }
  energies = left_words(energies, written);
  const ImplicitSystem& system = *model.system;
  const Manifold& M = *system.manifold();
  Graph graph;
  const ExprVector x = graph.variables("x", M.ambient_dimension());
  const ExprVector z = graph.variables("z", system.auxiliary_size());
  const Expr t = graph.variable("t");
  const ExprVector v = graph.variables("v", M.tangent_dimension());
  const SymbolTable at_stage = model.symbols(x, v, z, t);
  SymbolTable symbols = at_stage;
  energies.add_to(symbols, graph.variables("energies", energies.size()));
  SymbolTable taken = symbols;
  for (const Defect defect : experiment.defects) taken.add(column_of(defect), 0.0);
  if (taken.find("H") == nullptr && system.energy(x, z, t)) taken.add("H", 0.0);
  taken.add("constraint", 0.0);
  for (const DeclaredSymmetry& symmetry : experiment.symmetries) taken.add(symmetry.name, 0.0);
  for (std::size_t i = 0; i < written.size(); ++i) {
    Observable& entry = written[i];
    const std::string& name = entry.name;
    entry.uses_energies = !entry.at_stage && is_made_of(entry.formula, energies);
    const SymbolTable& known = entry.at_stage ? at_stage : symbols;
    if (name == "balance") experiment.writes_balance = false;
    // A quantity that has this name already is written under it.
    if (entry.formula.text == name && observable(name, *model.system, known)) {
      if (entry.at_stage || !experiment.writes_energies || !is_energy_column(name) ||
          !energies.contains(name))
        observables.push_back(entry);
      continue;
    }
    try {
      if (!parse_declaration(name, taken).shape.empty())
        throw FormulaError(1, "\"" + name + "\" has a size; expected a name");
    } catch (const FormulaError& error) {
      places[i].problem(std::string("key, ") + error.what());
      continue;
    }
    if (check(entry.formula, known, value.findings())) observables.push_back(entry);
  }
  return observables;
}

// The defects that have columns, by their words.
std::vector<Defect> read_defects(const JsonReader& value, const Model& model,
                                 const std::vector<DeclaredSymmetry>& symmetries) {
  std::vector<Defect> defects;
  const auto entries = value.elements();
  if (!entries) return defects;
  if (entries->empty()) value.expected("\"symplecticity\", \"volume\" or both");
  const ImplicitSystem& system = *model.system;
  Graph graph;
  const SymbolTable symbols =
      model.symbols(graph.variables("x", system.manifold()->ambient_dimension()),
                    graph.variables("v", system.manifold()->tangent_dimension()),
                    graph.variables("z", system.auxiliary_size()), graph.variable("t"));
  for (const JsonReader& entry : *entries) {
    const auto word = entry.word({"symplecticity", "volume"});
    if (!word) continue;
    const Defect defect = *word == "volume" ? Defect::volume : Defect::symplecticity;
    const std::string column = column_of(defect);
    if (std::ranges::find(defects, defect) != defects.end())
      entry.problem("is there twice; expected each defect once");
    else if (symbols.find(column) != nullptr ||
             std::ranges::find(symmetries, column, &DeclaredSymmetry::name) != symmetries.end())
      entry.problem("has the column " + column +
                    ", but the experiment has this name already; expected another name there");
    else
      defects.push_back(defect);
  }
  return defects;
}

// Coordinates, H where there is an energy, energies of steps, defects, momenta of symmetries, observables,
// sensitivities: what expectations can be about.
std::vector<std::string> quantities(const Experiment& experiment) {
  const ImplicitSystem& system = *experiment.model.system;
  std::vector<std::string> names = system.names().coordinates;
  Graph graph;
  if (system.energy(graph.variables("x", system.manifold()->ambient_dimension()),
                    graph.variables("z", system.auxiliary_size()), graph.variable("t")))
    names.push_back("H");
  for (const char* name : {"supplied", "dissipated"})
    if (experiment.writes_energies && experiment.energies.contains(name)) names.push_back(name);
  if (experiment.writes_balance) names.push_back("balance");
  for (const Defect defect : experiment.defects) names.push_back(column_of(defect));
  for (const DeclaredSymmetry& symmetry : experiment.symmetries) names.push_back(symmetry.name);
  for (const Observable& observable : experiment.observe) names.push_back(observable.name);
  if (experiment.sensitivities)
    for (std::string& column : experiment.sensitivities->columns())
      names.push_back(std::move(column));
  return names;
}

// What runs of many starts cannot be about: rows that members have at different times, and starts that are sought.
void require_ensemble_fits(const JsonReader& place, bool has_boundary, bool has_trajectory,
                           const Experiment& experiment) {
  if (!has_trajectory) place.problem("needs trajectories; expected \"method\" and \"time\"");
  if (has_boundary)
    place.problem("is of given starts, and \"boundary\" seeks one; expected one of the two");
  if (!experiment.time) return;
  if (experiment.time->is_transformed())
    place.problem(
        "is for steps of one size in t; expected no \"transformation\" of time beside it");
  if (!experiment.time->is_chosen)
    place.problem("is for one step of all members; expected \"step\" in \"time\"");
}

// The observables that a state has.
NamedFormulas formulas_of_state(const Experiment& experiment) {
  NamedFormulas named;
  for (const Observable& observable : experiment.observe)
    if (!observable.at_stage && !observable.uses_energies)
      named.emplace_back(observable.name, observable.formula);
  return named;
}

// What looks at a run as one smooth map of its start.
void require_resets_fit(const Experiment& experiment, bool has_boundary, Findings& findings) {
  const std::optional<std::string> place = place_of_resets(experiment.events);
  if (!place) return;
  const auto refuse = [&](bool is_there, const std::string& what) {
    if (is_there) findings.problem(*place, "jumps, and " + what + "; expected one of the two");
  };
  refuse(experiment.sensitivities.has_value(), "\"sensitivities\" are derivatives without jumps");
  refuse(!experiment.defects.empty(), "\"defects\" are of a map without jumps");
  refuse(has_boundary, "\"boundary\" is solved by a flow without jumps");
  refuse(experiment.time && experiment.time->is_transformed(),
         "\"transformation\" of time goes on without jumps");
}

}  // namespace

std::string column_of(Defect defect) {
  return defect == Defect::volume ? "volume_defect" : "symplecticity_defect";
}

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

namespace {

// `given`: the system, or null where the document describes it.
Experiment read_document(const Json& written, const Model* given) {
  const Json document = without_comments(written);
  Findings findings;
  Experiment experiment;
  {
    ObjectReader object(JsonReader(document, "", findings));
    if (const auto schema = object.optional("$schema")) schema->text();
    if (const auto run = object.optional("$run")) run->text();
    experiment.title = object.text("title", "");
    if (const auto description = object.optional("description")) description->text();
    const auto system = given ? std::nullopt : object.required("system");
    auto model = given    ? std::optional(*given)
                 : system ? system_kinds().read(*system)
                          : std::nullopt;
    const auto branch = object.optional("branch");
    if (model && branch) choose_branch(*branch, *model);
    const auto initial = object.required("initial");
    const auto hold = object.optional("hold");
    if (const auto start = object.optional("start")) start->word({"nearest"});
    const auto method = object.optional("method");
    if (method) experiment.method = method_kinds().read(*method);
    const auto time = object.optional("time");
    const auto output = object.optional("output");
    if (time)
      experiment.time = read_time(*time, model ? model->vocabulary.symbols({}) : SymbolTable(),
                                  interval_of(output));
    if (method && !time) object.required("time");
    if (time && !method) object.required("method");
    experiment.examine = static_cast<long>(object.integer("examine", 0, 0));
    const auto weights = object.optional("weights");
    const auto nominal = object.optional("nominal");
    const auto symmetries = object.optional("symmetries");
    const auto defects = object.optional("defects");
    if (defects && !method && !time)
      defects->problem("need a trajectory; expected \"method\" and \"time\"");
    const auto observe = object.optional("observe");
    const auto sensitivities = object.optional("sensitivities");
    if (sensitivities && !(method && time))
      sensitivities->problem("need a trajectory; expected \"method\" and \"time\"");
    if (sensitivities && experiment.time && experiment.time->is_transformed())
      sensitivities->problem(
          "are those of steps that know their differential, and steps in transformed time do not; "
          "expected no \"transformation\" of time");
    const auto events = object.optional("events");
    if (events && !time) events->problem("need a trajectory; expected \"method\" and \"time\"");
    const auto boundary = object.optional("boundary");
    if (boundary && !(method && time))
      boundary->problem("needs a trajectory; expected \"method\" and \"time\"");
    if (boundary && experiment.time && experiment.time->is_transformed())
      boundary->problem(
          "is for steps of one size in t; expected no \"transformation\" of time beside it");
    if (boundary && experiment.time && !experiment.time->is_transformed() &&
        experiment.time->steps < 1)
      boundary->problem("needs a trajectory; expected an end of the time after its start");
    if (boundary && sensitivities)
      sensitivities->problem(
          "are those of a run from initial values, and \"boundary\" makes other ones; expected one "
          "of the two");
    const auto ensemble = object.optional("ensemble");
    if (ensemble)
      require_ensemble_fits(*ensemble, boundary.has_value(), method && time, experiment);
    const auto expect = object.optional("expect");
    const Json no_output = Json::object();
    if (!output) object.default_value("output", no_output);

    if (model && experiment.time && experiment.time->rate)
      transform_time(*experiment.time->rate, *model, findings, experiment);
    if (experiment.method && experiment.time && experiment.time->division)
      experiment.method = with_substeps(std::move(*experiment.method), *experiment.time->division);
    if (model) {
      experiment.model = *model;
      if (initial)
        if (const auto values = read_initial_values(*initial, hold, weights, nominal, *model))
          experiment.initial = *values;
      if (nominal && experiment.time && experiment.time->is_transformed())
        nominal->problem("is for steps in t; expected no \"transformation\" of time beside it");
      else if (experiment.method && experiment.initial.nominal.any())
        experiment.method =
            with_nominal_sizes(*std::move(experiment.method), experiment.initial.nominal);
      if (method || time) experiment.energies = energy_words(*model);
      experiment.writes_energies = has_ports(experiment.energies);
      experiment.writes_balance =
          experiment.writes_energies && model->vocabulary.symbols({}).find("balance") == nullptr;
      if (symmetries) experiment.symmetries = read_symmetries(*symmetries, *model);
      if (defects) experiment.defects = read_defects(*defects, *model, experiment.symmetries);
      if (observe) experiment.observe = read_observables(*observe, *model, experiment);
      if (sensitivities && initial)
        experiment.sensitivities = read_sensitivities(*sensitivities, *model, experiment.initial,
                                                      experiment.symmetries, experiment.observe);
      if (events) experiment.events = read_events(*events, *model);
      if (events) require_resets_fit(experiment, boundary.has_value(), findings);
      // What is not given of a guess is 0.
      if (boundary) experiment.model.starts_at_zero = true;
      if (boundary)
        experiment.boundary = read_boundary(*boundary, *model, formulas_of_state(experiment));
      if (ensemble) experiment.ensemble = read_ensemble(*ensemble, document, *model);
      std::vector<std::string> event_names;
      for (const Event& event : experiment.events) event_names.push_back(event.name);
      if (expect)
        experiment.expect = read_expectations(
            *expect, model->vocabulary, quantities(experiment), event_names, experiment.time,
            method || time, experiment.boundary.has_value(), ensemble.has_value(),
            std::dynamic_pointer_cast<const EnergySystem>(model->system) != nullptr);
    }
    experiment.output =
        read_output(output.value_or(JsonReader(no_output, "/output", findings)),
                    model ? model->vocabulary.symbols({}) : SymbolTable(),
                    model ? std::optional(quantities(experiment)) : std::nullopt,
                    model ? model->system->names().coordinates.size() : 0, experiment.time);
  }
  findings.require_clean();
  experiment.document = findings.completed(document);
  experiment.remarks = unused_parameters(document);
  return experiment;
}

}  // namespace

Experiment read_experiment_document(const Json& document) {
  return read_document(document, nullptr);
}

Experiment read_experiment_document(const Json& document, const Model& model) {
  return read_document(document, &model);
}

}  // namespace courant
