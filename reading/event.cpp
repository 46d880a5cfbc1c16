#include "courant/reading/event.hpp"

#include <algorithm>

#include "courant/core/language/declaration.hpp"

namespace courant {
namespace {

Event::Direction direction(ObjectReader& entry) {
  const std::string word = entry.word("direction", "either", {"either", "rising", "falling"});
  if (word == "rising") return Event::Direction::rising;
  if (word == "falling") return Event::Direction::falling;
  return Event::Direction::either;
}

// The entry `key` of "set", of one number or of an array of them.
void read_reset(const std::string& key, const JsonReader& value, const Model& model,
                const SymbolTable& symbols, std::vector<Event::Reset>& resets) {
  const auto formulas = read_formulas(value);
  if (!formulas) return;
  try {
    const Reference reference = parse_reference(key);
    const auto [first, count] = model.vocabulary.coordinates.find(reference);
    if (static_cast<Index>(formulas->formulas.size()) != count)
      return value.problem("has " + std::to_string(formulas->formulas.size()) +
                           " values; expected " + std::to_string(count) + ", for " + key);
    for (Index i = 0; i < count; ++i) {
      if (reference.is_velocity && !model.system->names().momentum_of(first + i))
        return value.problem(
            "is set as a velocity that has no momentum; expected a coordinate of the state");
      const WrittenFormula& formula = formulas->formulas[static_cast<std::size_t>(i)];
      if (!check(formula, symbols, value.findings())) return;
      resets.push_back({first + i, reference.is_velocity, formula});
    }
  } catch (const FormulaError& error) {
    value.problem(std::string("key, ") + error.what());
  }
}

std::optional<Event> read_event(const std::string& name, const JsonReader& value,
                                const Model& model, const SymbolTable& symbols) {
  if (!value.value().is_object()) {
    const auto formula = read_formula(value);
    if (!formula) return std::nullopt;
    return Event{name, *formula};
  }
  ObjectReader entry(value);
  const auto zero = entry.required("zero");
  const auto formula = zero ? read_formula(*zero) : std::nullopt;
  const auto sense = direction(entry);
  bool stops = false;
  if (const auto stop = entry.optional("stop")) {
    stops = stop->value() == true;
    if (!stop->value().is_boolean()) stop->expected("true or false");
  } else {
    entry.default_value("stop", false);
  }
  std::vector<Event::Reset> resets;
  if (const auto set = entry.optional("set")) {
    const auto entries = set->entries();
    if (entries && entries->empty()) set->problem("sets nothing; expected values by name");
    if (entries && stops) set->problem("is for a run that goes on; expected no \"stop\" beside it");
    if (entries)
      for (const auto& [key, formula_of_key] : *entries)
        read_reset(key, formula_of_key, model, symbols, resets);
  }
  if (!formula) return std::nullopt;
  return Event{name, *formula, sense, stops, std::move(resets)};
}

// The name stands in a file between commas, and in expectations.
bool is_name(const std::string& name, const JsonReader& place) {
  try {
    if (parse_declaration(name, SymbolTable()).shape.empty()) return true;
    place.problem("key, \"" + name + "\" has a size; expected a name");
  } catch (const FormulaError& error) {
    place.problem(std::string("key, ") + error.what());
  }
  return false;
}

}  // namespace

bool Event::is_between(double before, double after) const {
  const bool rises = before < 0.0 && after >= 0.0, falls = before > 0.0 && after <= 0.0;
  switch (direction) {
    case Direction::rising:
      return rises;
    case Direction::falling:
      return falls;
    case Direction::either:
      break;
  }
  return rises || falls;
}

bool Event::sets_velocities() const { return std::ranges::any_of(resets, &Reset::is_velocity); }

bool Event::is_beyond(double value) const {
  switch (direction) {
    case Direction::rising:
      return value > 0.0;
    case Direction::falling:
      return value < 0.0;
    case Direction::either:
      break;
  }
  return true;
}

std::vector<Event> read_events(const JsonReader& events, const Model& model) {
  std::vector<Event> list;
  const auto entries = events.entries();
  if (!entries) return list;
  const ImplicitSystem& system = *model.system;
  const Manifold& M = *system.manifold();
  Graph graph;
  const SymbolTable symbols = model.symbols(
      graph.variables("x", M.ambient_dimension()), graph.variables("v", M.tangent_dimension()),
      graph.variables("z", system.auxiliary_size()), graph.variable("t"));
  for (const auto& [name, value] : *entries) {
    const bool named = is_name(name, value);
    const auto event = read_event(name, value, model, symbols);
    if (!event || !check(event->formula, symbols, value.findings()) || !named) continue;
    if (evaluate(event->formula, symbols).is_constant())
      value.problem("is constant; expected a formula that has zeros");
    else
      list.push_back(*event);
  }
  return list;
}

std::optional<std::string> place_of_resets(const std::vector<Event>& events) {
  const auto found = std::ranges::find_if(events, &Event::sets);
  if (found == events.end()) return std::nullopt;
  return "/events/" + found->name + "/set";
}

}  // namespace courant
