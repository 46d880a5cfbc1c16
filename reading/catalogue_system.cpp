#include "courant/reading/catalogue_system.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/core/words/message.hpp"
#include "courant/systems/catalogue_files.hpp"

namespace courant {
namespace {

// "mass (kg)".
std::string sentence_on(const Json& parameter) {
  const std::string unit = parameter.value("unit", "");
  return parameter.at("meaning").get<std::string>() + (unit.empty() ? "" : " (" + unit + ")");
}

std::vector<Key> keys_for(const Json& parameters) {
  std::vector<Key> keys;
  for (const auto& [name, parameter] : parameters.items()) {
    const Json& value = parameter.at("value");
    keys.push_back(default_key(name, value.is_array() ? takes::formulas() : takes::formula(), value,
                               sentence_on(parameter)));
  }
  return system_keys(std::move(keys));
}

// What the experiment adds to an object of names of the system; a problem for each that is there.
void add_to(Json& object, ObjectReader& system, const std::string& key) {
  const auto given = system.optional(key);
  const auto entries = given ? given->entries() : std::nullopt;
  if (!entries) return;
  for (const auto& [name, value] : *entries) {
    if (!object.contains(name))
      object[name] = value.value();
    else if (key == "parameters")
      value.problem("is a parameter of the system; expected it as a key beside \"type\"");
    else
      value.problem("is a name of the system already; expected another");
  }
}

std::vector<CatalogueSystem> compiled_in() {
  std::vector<CatalogueSystem> systems;
  for (const CatalogueFile& file : catalogue_files()) systems.emplace_back(file.name, file.text);
  return systems;
}

}  // namespace

CatalogueSystem::CatalogueSystem(std::string_view name, std::string_view text) try {
  const Json file = Json::parse(text);
  const Json& parameters = file.at("parameters");
  template_ = file.at("system");
  description_.type = name;
  description_.summary = file.at("summary");
  description_.reference = file.at("reference");
  description_.keys = keys_for(parameters);
  description_.example = file.at("example");

  Json keys = {{"type", name}}, values = Json::object();
  for (const auto& [key, parameter] : parameters.items()) {
    keys[key] = parameter.at("value");
    parameters_.push_back(key);
    if (parameter.value("positive", false)) positive_.push_back(key);
  }
  keys.update(description_.example.value("system", Json::object()));
  for (const std::string& parameter : parameters_) values[parameter] = keys[parameter];
  values.update(keys.value("parameters", Json::object()));
  description_.example["system"] = std::move(keys);
  description_.formulas = template_;
  description_.formulas["parameters"] = std::move(values);
} catch (const Json::exception& error) {
  throw std::invalid_argument("CatalogueSystem " + std::string(name) + ": " + error.what());
}

std::optional<Json> CatalogueSystem::filled(ObjectReader& system) const {
  Json whole = template_;
  Json& values = whole["parameters"] = Json::object();
  for (const std::string& name : parameters_) {
    const auto given = system.optional(name);
    values[name] = given ? given->value() : system.declared_default(name);
    if (!given) system.default_value(name, values[name]);
  }
  const std::size_t before = system.place().findings().problems().size();
  for (const char* key : {"parameters", "tables", "definitions"}) {
    Json object = whole.value(key, Json::object());
    add_to(object, system, key);
    if (!object.empty()) whole[key] = std::move(object);
  }
  if (system.place().findings().problems().size() > before) return std::nullopt;
  return whole;
}

bool CatalogueSystem::has_parameter(const std::string& name) const {
  return std::ranges::find(parameters_, name) != parameters_.end();
}

void CatalogueSystem::tell(const Findings& problems, ObjectReader& system) const {
  const std::string here = system.place().pointer();
  for (const Problem& problem : problems.problems()) {
    std::string where = problem.where, what = problem.what;
    const std::string parameters = here + "/parameters/";
    if (where.starts_with(parameters)) {
      const std::string rest = where.substr(parameters.size());
      if (has_parameter(rest.substr(0, rest.find('/')))) where = here + "/" + rest;
    } else if (where.starts_with(here + "/")) {
      const std::string rest = where.substr(here.size());
      const std::string key = rest.substr(1, rest.find('/', 1) - 1);
      if (!system.place().value().contains(key)) {
        where = here;
        what = "with these values " + rest + " of the system in formulas " + what;
      }
    }
    system.place().findings().problem(std::move(where), std::move(what));
  }
}

std::optional<Model> CatalogueSystem::read(ObjectReader& system,
                                           const Registry<Model>& kinds) const {
  const auto whole = filled(system);
  if (!whole) return std::nullopt;
  Findings findings;
  auto model = kinds.read(JsonReader(*whole, system.place().pointer(), findings));
  tell(findings, system);
  if (!model || !findings.clean()) return std::nullopt;

  bool right = true;
  for (const auto& [name, symbol] : model->vocabulary.parameters) {
    if (std::ranges::find(positive_, name) == positive_.end()) continue;
    for (const Expr& value : symbol.values) {
      if (value.value() > 0.0) continue;
      system.place().findings().problem(
          system.place().pointer() + "/" + name,
          "is " + exact_text(value.value()) + "; expected more than 0");
      right = false;
      break;
    }
  }
  if (!right) return std::nullopt;
  model->description = description_.type + ": " + model->description;
  return model;
}

const std::vector<CatalogueSystem>& catalogue_systems() {
  static const std::vector<CatalogueSystem> systems = compiled_in();
  return systems;
}

}  // namespace courant
