#include "courant/reading/sensitivities.hpp"

#include <algorithm>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"

namespace courant {
namespace {

// The entries of a coordinate or an array of them; none if nothing is called so.
std::vector<Index> coordinate_entries(const std::string& name, const Model& model) {
  try {
    const Reference reference = parse_reference(name);
    if (reference.is_velocity) return {};
    const auto [first, count] = model.vocabulary.coordinates.find(reference);
    std::vector<Index> entries;
    for (Index i = 0; i < count; ++i) entries.push_back(first + i);
    return entries;
  } catch (const FormulaError&) {
    return {};
  }
}

// The entries of a parameter, with their values; none if nothing is called so.
std::vector<Parameter> parameter_entries(const std::string& name, const Model& model) {
  std::vector<Parameter> entries;
  for (const auto& [parameter, symbol] : model.vocabulary.parameters) {
    const auto names = Declaration{parameter, symbol.shape}.element_names();
    for (std::size_t i = 0; i < names.size(); ++i)
      if (name == parameter || name == names[i])
        entries.push_back({names[i], symbol.values[static_cast<Index>(i)].value()});
  }
  return entries;
}

void refuse_name(const JsonReader& entry, const std::string& name, std::vector<std::string> known,
                 const std::string& expected) {
  entry.problem("is " + in_quotes(name) + did_you_mean(name, known) + "; expected " + expected);
}

std::vector<std::string> parameter_words(const Model& model) {
  std::vector<std::string> names;
  for (const auto& [name, symbol] : model.vocabulary.parameters) names.push_back(name);
  return names;
}

void read_by(const JsonReader& entry, const SensitivityWords& words, Sensitivities& found) {
  const auto name = entry.text();
  if (!name) return;
  const Model& model = words.model;
  std::vector<Sensitivities::By> more;
  for (const Parameter& parameter : parameter_entries(*name, model))
    more.push_back({parameter.name, entry.pointer(), std::nullopt, parameter.value});
  if (more.empty())
    for (const Index i : coordinate_entries(*name, model)) {
      const std::string& coordinate =
          model.system->names().coordinates[static_cast<std::size_t>(i)];
      if (i >= words.initial.x.given.size()) return;  // which could not be read
      if (!words.initial.x.given[i])
        return entry.problem("is about the initial value of " + coordinate +
                             ", which /initial does not give; expected one that is given");
      more.push_back({coordinate, entry.pointer(), i, words.initial.x.values[i]});
    }
  if (more.empty()) {
    std::vector<std::string> known = parameter_words(model);
    for (const Declaration& declaration : model.vocabulary.coordinates.declarations())
      known.push_back(declaration.name);
    return refuse_name(entry, *name, std::move(known),
                       "a parameter of the system, or a coordinate, whose initial value is meant");
  }
  for (Sensitivities::By& by : more) {
    if (std::ranges::find(found.by, by.name, &Sensitivities::By::name) != found.by.end())
      return entry.problem("has " + by.name + " once more; expected each name once");
    found.by.push_back(std::move(by));
  }
}

void read_of(const JsonReader& entry, const SensitivityWords& words, Sensitivities& found) {
  const auto name = entry.text();
  if (!name) return;
  const Model& model = words.model;
  const ImplicitSystem& system = *model.system;
  std::vector<std::string> more;
  for (const Index i : coordinate_entries(*name, model))
    more.push_back(system.names().coordinates[static_cast<std::size_t>(i)]);
  std::vector<std::string> known;
  for (const Declaration& declaration : model.vocabulary.coordinates.declarations())
    known.push_back(declaration.name);
  Graph graph;
  if (system.energy(graph.variables("x", system.manifold()->ambient_dimension()),
                    graph.variables("z", system.auxiliary_size()), graph.variable("t")))
    known.emplace_back("H");
  known.insert(known.end(), words.momenta.begin(), words.momenta.end());
  known.insert(known.end(), words.observables.begin(), words.observables.end());
  if (std::ranges::find(words.others, *name) != words.others.end())
    return entry.problem("is " + in_quotes(*name) +
                         ", which is no function of the state; expected an observable of "
                         "coordinates, velocities, unknowns and t");
  if (more.empty() && std::ranges::find(known, *name) != known.end()) more.push_back(*name);
  if (more.empty())
    return refuse_name(entry, *name, std::move(known),
                       "a coordinate, H, the momentum of a symmetry or an observable");
  for (std::string& quantity : more) {
    if (std::ranges::find(found.of, quantity) != found.of.end())
      return entry.problem("has " + quantity + " once more; expected each name once");
    found.of.push_back(std::move(quantity));
  }
}

}  // namespace

std::vector<Parameter> Sensitivities::parameters() const {
  std::vector<Parameter> found;
  for (const By& one : by)
    if (!one.coordinate) found.push_back({one.name, one.value});
  return found;
}

std::vector<std::string> Sensitivities::columns() const {
  std::vector<std::string> names;
  for (const std::string& quantity : of)
    for (const By& one : by)
      names.push_back("d" + quantity + "/d" + one.name + (one.coordinate ? "(0)" : ""));
  return names;
}

std::optional<Sensitivities> read_sensitivities(const JsonReader& value,
                                                const SensitivityWords& words) {
  ObjectReader object(value);
  const auto by = object.required("by"), of = object.required("of");
  if (!by || !of) return std::nullopt;
  Sensitivities found;
  if (const auto entries = by->elements()) {
    if (entries->empty()) by->expected("names of parameters or coordinates");
    for (const JsonReader& entry : *entries) read_by(entry, words, found);
  }
  if (const auto entries = of->elements()) {
    if (entries->empty()) of->expected("names of coordinates, H or observables");
    for (const JsonReader& entry : *entries) read_of(entry, words, found);
  }
  return found;
}

}  // namespace courant
