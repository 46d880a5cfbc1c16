#include "courant/reading/event.hpp"

#include "courant/core/language/declaration.hpp"

namespace courant {
namespace {

Event::Direction direction(ObjectReader& entry) {
  const std::string word = entry.word("direction", "either", {"either", "rising", "falling"});
  if (word == "rising") return Event::Direction::rising;
  if (word == "falling") return Event::Direction::falling;
  return Event::Direction::either;
}

std::optional<Event> read_event(const std::string& name, const JsonReader& value) {
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
  if (!formula) return std::nullopt;
  return Event{name, *formula, sense, stops};
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
    const auto event = read_event(name, value);
    if (!event || !check(event->formula, symbols, value.findings()) || !named) continue;
    if (evaluate(event->formula, symbols).is_constant())
      value.problem("is constant; expected a formula that has zeros");
    else
      list.push_back(*event);
  }
  return list;
}

}  // namespace courant
