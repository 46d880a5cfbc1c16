#include "courant/reading/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "courant/core/expressions/function.hpp"
#include "courant/core/language/declaration.hpp"
#include "courant/core/numbers/random_numbers.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"

namespace courant {
namespace {

// What a member has in the place of one value: a number each, or a formula.
struct EnsembleColumn {
  std::string name;
  std::optional<JsonReader> place = {};
  std::vector<double> numbers = {};
  std::optional<WrittenFormula> formula = {};
};

// The columns; nothing where one is wrong.
std::optional<std::vector<EnsembleColumn>> read_columns(const JsonReader& values) {
  const auto entries = values.entries();
  if (!entries) return std::nullopt;
  std::vector<EnsembleColumn> columns;
  bool is_right = true;
  for (const auto& [name, entry] : *entries) {
    EnsembleColumn column{name, entry};
    if (const auto elements = entry.value().is_array() ? entry.elements() : std::nullopt) {
      if (elements->empty()) entry.expected("a number for each member");
      for (const JsonReader& element : *elements)
        if (const auto number = element.number()) column.numbers.push_back(*number);
      is_right = is_right && !elements->empty() && column.numbers.size() == elements->size();
    } else {
      column.formula = read_formula(entry);
      is_right = is_right && column.formula;
    }
    columns.push_back(std::move(column));
  }
  return is_right ? std::optional(std::move(columns)) : std::nullopt;
}

// How many members there are, as the key says or as lists have numbers.
std::optional<Index> member_count(const std::optional<JsonReader>& key, const JsonReader& value,
                                  const std::vector<EnsembleColumn>& columns) {
  std::optional<Index> count = key ? key->integer(1) : std::nullopt;
  if (key && !count) return std::nullopt;
  if (count && *count > Ensemble::kMostMembers) {
    key->expected("at most " + std::to_string(Ensemble::kMostMembers) + " members");
    return std::nullopt;
  }
  for (const EnsembleColumn& column : columns) {
    const Index numbers = std::ssize(column.numbers);
    if (column.formula || numbers == count.value_or(numbers)) {
      if (!column.formula) count = numbers;
      continue;
    }
    column.place->problem("has " + std::to_string(numbers) + " numbers; expected " +
                          std::to_string(*count) + ", one for each member");
    return std::nullopt;
  }
  if (!count)
    value.problem(
        "does not say how many members there are; expected \"members\", a \"table\", or lists of "
        "numbers in \"values\"");
  return count;
}

// {"u": "uniform", "g": "normal"}
std::optional<std::vector<std::pair<std::string, bool>>> read_random(
    const std::optional<JsonReader>& key, SymbolTable& taken) {
  std::vector<std::pair<std::string, bool>> names;
  const auto entries = key ? key->entries() : std::nullopt;
  if (!entries) return key ? std::nullopt : std::optional(names);
  bool is_right = true;
  for (const auto& [name, entry] : *entries) {
    const auto word = entry.word({"uniform", "normal"});
    try {
      if (!parse_declaration(name, taken).shape.empty())
        throw FormulaError(1, "\"" + name + "\" has a size; expected a name");
      taken.add(name, 0.0);
    } catch (const FormulaError& error) {
      entry.problem(std::string("key, ") + error.what());
      is_right = false;
    }
    is_right = is_right && word;
    if (word) names.emplace_back(name, *word == "normal");
  }
  return is_right ? std::optional(names) : std::nullopt;
}

// Formulas of i and the random numbers, for all members.
bool evaluate_formulas(const std::vector<EnsembleColumn>& columns, std::uint64_t seed,
                       const std::vector<std::pair<std::string, bool>>& random, const Model& model,
                       Findings& findings, MatrixXd& values) {
  Graph graph;
  SymbolTable symbols = model.vocabulary.symbols({});
  ExprVector arguments(1 + std::ssize(random));
  const auto add = [&](Index k, const std::string& name) {
    arguments[k] = graph.variable(name);
    symbols.add(name, arguments[k]);
  };
  add(0, "i");
  for (std::size_t k = 0; k < random.size(); ++k) add(static_cast<Index>(k) + 1, random[k].first);
  std::vector<Expr> formulas;
  std::vector<std::size_t> places;
  bool is_right = true;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (!columns[k].formula) continue;
    if (!check(*columns[k].formula, symbols, findings)) {
      is_right = false;
      continue;
    }
    formulas.push_back(evaluate(*columns[k].formula, symbols));
    places.push_back(k);
  }
  if (!is_right) return false;
  ExprVector outputs(std::ssize(formulas));
  std::ranges::copy(formulas, outputs.begin());
  const Function of_member("ensemble", {{"member", arguments}}, outputs);
  VectorXd in(arguments.size());
  for (Index i = 0; i < values.rows(); ++i) {
    in[0] = static_cast<double>(i);
    for (std::size_t k = 0; k < random.size(); ++k) {
      RandomNumbers numbers(seed, random[k].first, static_cast<std::uint64_t>(i));
      in[static_cast<Index>(k) + 1] = random[k].second ? numbers.normal() : numbers.uniform();
    }
    const VectorXd row = of_member({in});
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double value = row[static_cast<Index>(k)];
      values(i, static_cast<Index>(places[k])) = value;
      if (std::isfinite(value)) continue;
      columns[places[k]].place->problem("is " + number_text(value) + " for member " +
                                        std::to_string(i) + "; expected a finite number");
      return false;
    }
  }
  return true;
}

std::string elements_text(const std::vector<Index>& indices, std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) text += "[" + std::to_string(indices[k]) + "]";
  return text;
}

// Where the value of this name stands, or comes to stand, in the document; nothing, and a problem, if nowhere.
std::optional<std::string> pointer_of(const EnsembleColumn& column, const Json& document,
                                      const Model& model) {
  const auto refuse = [&](const std::string& what) {
    column.place->problem(what);
    return std::nullopt;
  };
  Reference reference;
  try {
    reference = parse_reference(column.name);
  } catch (const FormulaError& error) {
    return refuse(std::string("key, ") + error.what());
  }
  const Json system = document.value("system", Json());
  const Json parameters = system.is_object() ? system.value("parameters", Json()) : Json();
  const bool is_parameter =
      !reference.is_velocity && parameters.is_object() && parameters.contains(reference.name);
  const Vocabulary& words = model.vocabulary;
  std::vector<std::string> known;
  if (parameters.is_object())
    for (const auto& entry : parameters.items()) known.push_back(entry.key());
  for (const NameList* list : {&words.coordinates, &words.unknowns})
    for (const std::string& name : list->element_names()) known.push_back(name);
  const std::string key = reference.name + (reference.is_velocity ? "'" : "");
  static const Json nothing;
  const auto initial = document.find("initial");
  const Json& values = is_parameter ? parameters : initial != document.end() ? *initial : nothing;
  const bool is_object = values.is_object();
  if (!is_parameter) {
    const bool is_coordinate =
        words.coordinates.contains(reference.name) || words.unknowns.contains(reference.name);
    const bool is_given = is_object && (values.contains(key) || values.contains(column.name));
    if (!is_coordinate && !is_given)
      return refuse("is neither an initial value nor a parameter of the experiment" +
                    did_you_mean(column.name, known));
    if (is_coordinate) try {
        const NameList& list =
            words.coordinates.contains(reference.name) ? words.coordinates : words.unknowns;
        if (list.find(reference).second != 1)
          return refuse("is an array; expected one of its elements, such as " + reference.name +
                        "[0]");
      } catch (const FormulaError& error) {
        return refuse(std::string("key, ") + error.what());
      }
  }
  const std::string above = is_parameter ? "/system/parameters/" : "/initial/";
  // The element of an array that is given as one.
  if (is_object && values.contains(key) && (!reference.indices.empty() || is_parameter)) {
    const Json* part = &values.at(key);
    std::string pointer = above + pointer_token(key);
    for (std::size_t k = 0; k < reference.indices.size(); ++k) {
      const auto index = static_cast<std::size_t>(reference.indices[k]);
      const std::string whole = key + elements_text(reference.indices, k);
      if (!part->is_array())
        return refuse("is an element of " + whole +
                      ", which is not written as an array; expected an array there");
      if (index >= part->size())
        return refuse("has the index " + std::to_string(index) + "; " + whole + " has " +
                      std::to_string(part->size()) + " elements");
      pointer += "/" + std::to_string(index);
      part = &part->at(index);
    }
    if (part->is_array())
      return refuse("is an array; expected one of its elements, such as " + column.name + "[0]");
    return pointer;
  }
  return above + pointer_token(column.name);
}

}  // namespace

std::optional<Ensemble> read_ensemble(const JsonReader& value, const Json& document,
                                      const Model& model) {
  ObjectReader object(value);
  if (!value.value().is_object()) return std::nullopt;
  if (const auto table = object.optional("table")) {
    table->problem("is in a file, which only the command reads; expected \"values\"");
    return std::nullopt;
  }
  const auto members_key = object.optional("members"), seed_key = object.optional("seed"),
             random_key = object.optional("random"), values_key = object.optional("values");
  SymbolTable taken = model.vocabulary.symbols({});
  if (taken.find("i") == nullptr) {
    taken.add("i", 0.0);
  } else {
    value.problem(
        "numbers its members by i, which is a parameter here; expected another name for that");
    return std::nullopt;
  }
  const auto random = read_random(random_key, taken);
  const auto seed = seed_key ? seed_key->integer(0) : std::optional<Index>(0);
  if (random_key && !seed_key)
    random_key->problem("needs a seed, so that its numbers are the same again; expected \"seed\"");
  const Json no_values = Json::object();
  const auto columns = read_columns(
      values_key.value_or(JsonReader(no_values, value.pointer() + "/values", value.findings())));
  if (!columns || !random || !seed) return std::nullopt;
  const auto count = member_count(members_key, value, *columns);
  Ensemble ensemble;
  for (const EnsembleColumn& column : *columns)
    if (const auto pointer = pointer_of(column, document, model)) {
      ensemble.names.push_back(column.name);
      ensemble.pointers.push_back(*pointer);
    }
  if (!count || ensemble.names.size() != columns->size()) return std::nullopt;
  ensemble.values.resize(*count, std::ssize(*columns));
  for (std::size_t k = 0; k < columns->size(); ++k)
    if (!(*columns)[k].formula)
      ensemble.values.col(static_cast<Index>(k)) =
          Eigen::Map<const VectorXd>((*columns)[k].numbers.data(), *count);
  if (!evaluate_formulas(*columns, static_cast<std::uint64_t>(*seed), *random, model,
                         value.findings(), ensemble.values))
    return std::nullopt;
  return ensemble;
}

}  // namespace courant
