#include "courant/reading/initial_values.hpp"

#include <limits>

#include "courant/reading/repetition.hpp"

namespace courant {
namespace {

// Where a reference leads: some entries of one of the three vectors.
struct Target {
  PartialVector* vector;
  Index first, count;
};

// Throws FormulaError where the reference leads nowhere.
Target find(const Reference& reference, const Vocabulary& vocabulary, InitialValues& values) {
  if (!reference.is_velocity && vocabulary.unknowns.contains(reference.name)) {
    const auto [first, count] = vocabulary.unknowns.find(reference);
    return {&values.z, first, count};
  }
  const auto [first, count] = vocabulary.coordinates.find(reference);
  return {reference.is_velocity ? &values.velocity : &values.x, first, count};
}

void read_entry(const std::string& key, const JsonReader& value, const SymbolTable& constants,
                const Model& model, InitialValues& values) {
  Target target{};
  try {
    target = find(parse_reference(key), model.vocabulary, values);
  } catch (const FormulaError& error) {
    value.problem(std::string("key, ") + error.what());
    return;
  }
  const auto formulas = read_formulas(value);
  if (!formulas) return;
  if (static_cast<Index>(formulas->formulas.size()) != target.count) {
    value.problem("has " + std::to_string(formulas->formulas.size()) + " values; expected " +
                  std::to_string(target.count) + ", for " + key);
    return;
  }
  const auto numbers = evaluate_constants(*formulas, constants, value.findings());
  if (!numbers) return;
  auto given = target.vector->given.segment(target.first, target.count);
  if (given.any()) {
    value.problem("is given twice");
    return;
  }
  given = true;
  target.vector->values.segment(target.first, target.count) = *numbers;
}

// The entry `"q_C{i}": {"repeat": {"i": [1, "n"]}, "value": "C*{i}"}` for each i.
void read_entries(const std::string& key, const JsonReader& entry, const SymbolTable& constants,
                  const Model& model, InitialValues& values) {
  if (!entry.value().is_object()) {
    const Repetition::Turn once(constants, "");
    if (const auto name = once.filled(key, entry.pointer(), entry.findings()))
      read_entry(*name, entry, constants, model, values);
    return;
  }
  ObjectReader object(entry);
  const auto repeat = object.required("repeat"), value = object.required("value");
  const auto repetition = repeat && value ? Repetition::read(*repeat, constants) : std::nullopt;
  if (!repetition) return;
  repetition->for_each(entry.findings(), [&](const Repetition::Turn& turn, Findings& findings) {
    const auto name = turn.filled(key, entry.pointer(), findings);
    const Json filled = turn.filled(JsonReader(value->value(), value->pointer(), findings));
    if (findings.clean())
      read_entry(*name, JsonReader(filled, value->pointer(), findings), constants, model, values);
  });
}

void read_hold(const JsonReader& name, const Model& model, InitialValues& values) {
  const auto text = name.text();
  if (!text) return;
  try {
    const Target target = find(parse_reference(*text), model.vocabulary, values);
    if (!target.vector->given.segment(target.first, target.count).all())
      name.problem("is to be held, but its value is not given; expected \"" + *text +
                   "\" in \"initial\"");
    target.vector->held.segment(target.first, target.count) = true;
  } catch (const FormulaError& error) {
    name.problem(error.what());
  }
}

void read_weight(const std::string& key, const JsonReader& value, const Model& model,
                 InitialValues& values) {
  const auto weight = value.positive_number();
  if (!weight) return;
  try {
    const Target target = find(parse_reference(key), model.vocabulary, values);
    if (target.vector != &values.x)
      value.problem("is the weight of something that is no coordinate; expected a coordinate");
    else
      values.weight.segment(target.first, target.count).setConstant(*weight);
  } catch (const FormulaError& error) {
    value.problem(error.what());
  }
}

}  // namespace

PartialVector::PartialVector(Index size)
    : values(VectorXd::Zero(size)),
      given(Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(size, false)),
      held(given) {}

std::optional<InitialValues> read_initial_values(const JsonReader& initial,
                                                 const std::optional<JsonReader>& hold,
                                                 const std::optional<JsonReader>& weights,
                                                 const Model& model) {
  const Index N = model.vocabulary.coordinates.size();
  InitialValues values{PartialVector(N), PartialVector(N),
                       PartialVector(model.vocabulary.unknowns.size()), VectorXd::Ones(N)};
  const auto entries = initial.entries();
  if (!entries) return std::nullopt;
  const SymbolTable constants = model.vocabulary.symbols({});
  for (const auto& [key, value] : *entries) read_entries(key, value, constants, model, values);
  if (const auto names = hold ? hold->elements() : std::nullopt)
    for (const JsonReader& name : *names) read_hold(name, model, values);
  if (const auto entries_of_weights = weights ? weights->entries() : std::nullopt)
    for (const auto& [key, value] : *entries_of_weights) read_weight(key, value, model, values);
  if (model.point_problem) {
    const VectorXd x =
        values.x.given.select(values.x.values, std::numeric_limits<double>::quiet_NaN());
    if (const auto problem = model.point_problem(x)) initial.problem(*problem);
  }
  return values;
}

}  // namespace courant
