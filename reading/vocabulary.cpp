#include "courant/reading/vocabulary.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"

namespace courant {
namespace {

// The key of a parameter or definition as a new name; nothing, and a problem, if it cannot be one.
bool is_new_name(const std::string& name, const std::string& pointer, const SymbolTable& taken,
                 Findings& findings) {
  try {
    if (!parse_declaration(name, taken).shape.empty())
      throw FormulaError(
          1, in_quotes(name) + " has a size; expected a name, the size is that of the value");
    return true;
  } catch (const FormulaError& error) {
    findings.problem(pointer, std::string("key, ") + error.what());
    return false;
  }
}

bool is_available(const Definition& definition, const SymbolTable& symbols) {
  for (const WrittenFormula& formula : definition.formulas.formulas)
    for (const std::string& name : names_used(formula.text)) {
      const bool known = name.back() == '\''
                             ? symbols.find_velocity({name.data(), name.size() - 1}) != nullptr
                             : symbols.find(name) != nullptr;
      if (!known) return false;
    }
  return true;
}

// Throws ExperimentError, with the place, where a formula cannot be read.
ExprVector value_of(const Definition& definition, const SymbolTable& symbols) {
  try {
    return evaluate(definition.formulas, symbols);
  } catch (const FormulaError&) {
    Findings findings;
    check(definition.formulas, symbols, findings);
    throw ExperimentError(findings.problems());
  }
}

// That of the first argument which is no constant.
Graph graph_in(const Vocabulary::Arguments& arguments) {
  for (const auto* vector : {&arguments.x, &arguments.velocity, &arguments.z, &arguments.effort})
    if (*vector)
      if (const Graph graph = graph_of(**vector); !graph.is_none()) return graph;
  return arguments.t ? graph_of(ExprVector{{*arguments.t}}) : Graph::none();
}

// The time derivatives of definitions, one after the other, where there is a velocity. In a later definition an earlier
// one is a variable, and its rate another: a chain of definitions takes the work of its links, and not of their square.
class DefinitionRates {
 public:
  DefinitionRates(const Vocabulary& vocabulary, const Vocabulary::Arguments& arguments) {
    if (!arguments.x || !arguments.velocity || !arguments.t) return;
    const ExprVector t{{*arguments.t}}, one{{Expr(1.0)}};
    graph_ = fresh_graph({*arguments.x, *arguments.velocity, t});
    extended_ = quantity(joined(*arguments.x, t), joined(*arguments.velocity, one));
    Vocabulary plain = vocabulary;
    plain.definitions.clear();
    const Index n = vocabulary.coordinates.size();
    known_ = plain.symbols({.x = extended_.at.head(n), .t = extended_.at[n]});
  }
  // Adds name' to the table, which has the definition, if this is one of coordinates and t.
  void add(const Definition& definition, SymbolTable& symbols) {
    if (extended_.at.size() == 0 || !is_available(definition, known_)) return;
    const ExprVector formulas = value_of(definition, known_);
    std::vector<ExprVector> at{extended_.at}, along{extended_.along}, value{extended_.value},
        rate{extended_.rate};
    for (const std::string& name : earlier_in(definition)) {
      const Quantity& used = earlier_.at(name);
      at.push_back(used.at);
      along.push_back(used.along);
      value.push_back(used.value);
      rate.push_back(used.rate);
    }
    const ExprVector derivative = tangent(formulas, joined(at), joined(along));
    const Quantity here = quantity(symbols.find(definition.name)->values,
                                   substitute(derivative, joined(joined(at), joined(along)),
                                              joined(joined(value), joined(rate))));
    symbols.add_velocity(definition.name, definition.formulas.shape, here.rate);
    known_.add(definition.name, definition.formulas.shape, here.at);
    earlier_.emplace(definition.name, here);
  }

 private:
  // A value and its rate, and the variables that stand for these.
  struct Quantity {
    ExprVector value, rate, at, along;
  };
  Quantity quantity(const ExprVector& value, const ExprVector& rate) {
    return {value, rate, graph_.variables("at", value.size()),
            graph_.variables("along", value.size())};
  }
  // The earlier definitions that one is made of, each once.
  std::set<std::string> earlier_in(const Definition& definition) const {
    std::set<std::string> names;
    for (const WrittenFormula& formula : definition.formulas.formulas)
      for (const std::string& name : names_used(formula.text))
        if (earlier_.contains(name)) names.insert(name);
    return names;
  }

  Graph graph_;
  Quantity extended_;  // (x, t)
  std::map<std::string, Quantity> earlier_;
  SymbolTable known_;  // at the variables
};

// Whether the formulas consist of words that formulas have; a problem for each that does not.
bool has_words(const WrittenFormulas& formulas, Findings& findings) {
  bool right = true;
  for (const WrittenFormula& formula : formulas.formulas) try {
      names_used(formula.text);
    } catch (const FormulaError& error) {
      findings.problem(formula.pointer, error.what());
      right = false;
    }
  return right;
}

// Whether one of the formulas has names in it.
bool has_names(const WrittenFormulas& formulas) {
  return std::ranges::any_of(formulas.formulas, [](const WrittenFormula& formula) {
    return !names_used(formula.text).empty();
  });
}

void read_parameters(ObjectReader& system, const std::vector<std::string>& reserved,
                     Vocabulary& vocabulary) {
  std::vector<std::pair<std::string, Symbol>>& parameters = vocabulary.parameters;
  const auto object = system.optional("parameters");
  const auto entries = object ? object->entries() : std::nullopt;
  if (!entries) return;
  SymbolTable known;    // names that are taken
  SymbolTable earlier;  // parameters
  known.add("t", 0.0);
  for (const std::string& name : reserved) known.add(name, 0.0);
  for (const auto& [name, value] : *entries) {
    if (!is_new_name(name, value.pointer(), known, value.findings())) continue;
    Symbol symbol{{}, ExprVector::Ones(1)};
    if (const auto formulas = read_formulas(value))
      if (const auto values = evaluate_constants(*formulas, earlier, value.findings())) {
        symbol = {formulas->shape, constants(*values)};
        if (has_names(*formulas)) vocabulary.parameter_formulas.emplace_back(name, *formulas);
      }
    known.add(name, symbol.shape, symbol.values);
    earlier.add(name, symbol.shape, symbol.values);
    parameters.emplace_back(name, std::move(symbol));
  }
}

// Tables, whose names are none of those of parameters.
std::vector<std::pair<std::string, Table>> read_named_tables(
    ObjectReader& system, const std::vector<std::string>& reserved,
    const std::vector<std::pair<std::string, Symbol>>& parameters) {
  std::vector<std::pair<std::string, Table>> tables;
  const auto object = system.optional("tables");
  if (!object) return tables;
  SymbolTable known;
  known.add("t", 0.0);
  for (const std::string& name : reserved) known.add(name, 0.0);
  for (const auto& [name, symbol] : parameters) known.add(name, symbol.shape, symbol.values);
  for (auto& [name, table] : read_tables(*object)) {
    if (!is_new_name(name, object->pointer() + "/" + name, known, object->findings())) continue;
    known.add(name, 0.0);
    tables.emplace_back(name, std::move(table));
  }
  return tables;
}

std::vector<Definition> read_definitions(ObjectReader& system) {
  std::vector<Definition> definitions;
  const auto object = system.optional("definitions");
  const auto entries = object ? object->entries() : std::nullopt;
  if (!entries) return definitions;
  for (const auto& [name, value] : *entries)
    if (auto formulas = read_formulas(value)) {
      if (!has_words(*formulas, value.findings()))
        for (WrittenFormula& formula : formulas->formulas) formula.text = "1";
      definitions.push_back({name, value.pointer(), std::move(*formulas)});
    }
  return definitions;
}

}  // namespace

void NameList::append(Declaration declaration) {
  if (!declaration.name.empty())
    places_.try_emplace(declaration.name, Place{declarations_.size(), size_});
  size_ += declaration.size();
  declarations_.push_back(std::move(declaration));
}

void NameList::append_unnamed(Index count) {
  if (count > 0) append({"", {count}});
}

bool NameList::contains(const std::string& name) const { return places_.contains(name); }

std::vector<std::string> NameList::element_names() const {
  std::vector<std::string> names;
  for (const Declaration& declaration : declarations_)
    for (std::string& name : declaration.element_names()) names.push_back(std::move(name));
  return names;
}

std::pair<Index, Index> NameList::find(const Reference& reference) const {
  const auto place = places_.find(reference.name);
  if (place == places_.end()) {
    std::vector<std::string> known;
    for (const Declaration& declaration : declarations_)
      if (!declaration.name.empty()) known.push_back(declaration.name);
    throw FormulaError(
        1, "unknown name " + in_quotes(reference.name) + did_you_mean(reference.name, known));
  }
  const Declaration& declaration = declarations_[place->second.declaration];
  const Shape& shape = declaration.shape;
  if (reference.indices.size() > shape.size())
    throw FormulaError(1, in_quotes(reference.name) + " takes " + std::to_string(shape.size()) +
                              " indices, found " + std::to_string(reference.indices.size()));
  Index first = place->second.first, count = declaration.size();
  for (std::size_t axis = 0; axis < reference.indices.size(); ++axis) {
    const Index index = reference.indices[axis];
    if (index >= shape[axis])
      throw FormulaError(1, "index of " + reference.name + " is " + std::to_string(index) +
                                "; expected at most " + std::to_string(shape[axis] - 1));
    count /= shape[axis];
    first += index * count;
  }
  return {first, count};
}

void NameList::add_to(SymbolTable& symbols, const ExprVector& values) const {
  Index first = 0;
  for (const Declaration& declaration : declarations_) {
    if (!declaration.name.empty())
      symbols.add(declaration.name, declaration.shape, values.segment(first, declaration.size()));
    first += declaration.size();
  }
}

void NameList::add_to(SymbolTable& symbols, const ExprVector& values,
                      const std::vector<std::string>& names) const {
  for (const std::string& name : names) {
    const auto place = places_.find(name);
    if (place == places_.end() || symbols.find(name)) continue;
    const Declaration& declaration = declarations_[place->second.declaration];
    symbols.add(name, declaration.shape, values.segment(place->second.first, declaration.size()));
  }
}

void NameList::add_velocities_to(SymbolTable& symbols, const ExprVector& values) const {
  Index first = 0;
  for (const Declaration& declaration : declarations_) {
    symbols.add_velocity(declaration.name, declaration.shape,
                         values.segment(first, declaration.size()));
    first += declaration.size();
  }
}

std::vector<std::pair<std::string, Symbol>> Vocabulary::parameters_in(const Graph& graph) const {
  if (parameter_names(graph).empty()) return parameters;
  std::vector<std::pair<std::string, Symbol>> all;
  SymbolTable earlier;
  for (const auto& [name, symbol] : parameters) {
    Symbol here = symbol;
    const auto formulas = std::ranges::find(parameter_formulas, name,
                                            &std::pair<std::string, WrittenFormulas>::first);
    if (formulas != parameter_formulas.end()) here.values = evaluate(formulas->second, earlier);
    const std::vector<std::string> elements = Declaration{name, symbol.shape}.element_names();
    for (std::size_t i = 0; i < elements.size(); ++i) {
      Expr& value = here.values[static_cast<Index>(i)];
      value = parameter_of(graph, elements[i], value);
    }
    earlier.add(name, here.shape, here.values);
    all.emplace_back(name, std::move(here));
  }
  return all;
}

SymbolTable Vocabulary::symbols(const Arguments& arguments) const {
  SymbolTable symbols;
  for (const auto& [name, symbol] : parameters_in(graph_in(arguments)))
    symbols.add(name, symbol.shape, symbol.values);
  if (arguments.t) symbols.add("t", *arguments.t);
  if (arguments.t)
    for (const auto& [name, table] : tables) symbols.add(name, table.at(*arguments.t));
  if (arguments.x) coordinates.add_to(symbols, *arguments.x);
  if (arguments.velocity) coordinates.add_velocities_to(symbols, *arguments.velocity);
  if (arguments.z) unknowns.add_to(symbols, *arguments.z);
  for (const Derived& quantities : derived) {
    if (const auto values = quantities.values(arguments)) quantities.names.add_to(symbols, *values);
    if (const auto rates = quantities.rates ? quantities.rates(arguments) : std::nullopt)
      quantities.names.add_velocities_to(symbols, *rates);
  }
  if (definitions.empty()) return symbols;
  DefinitionRates rates(*this, arguments);
  for (const Definition& definition : definitions)
    if (is_available(definition, symbols)) {
      symbols.add(definition.name, definition.formulas.shape, value_of(definition, symbols));
      rates.add(definition, symbols);
    }
  return symbols;
}

Vocabulary Vocabulary::of_time() const {
  Vocabulary result;
  result.parameters = parameters;
  result.parameter_formulas = parameter_formulas;
  result.tables = tables;
  return result;
}

std::vector<Parameter> Vocabulary::numbers() const {
  std::vector<Parameter> found;
  for (const auto& [name, symbol] : parameters) {
    const std::vector<std::string> elements = Declaration{name, symbol.shape}.element_names();
    for (std::size_t i = 0; i < elements.size(); ++i)
      found.push_back({elements[i], symbol.values[static_cast<Index>(i)].value()});
  }
  return found;
}

SymbolTable Vocabulary::symbols_of(const std::vector<std::string>& names, const ExprVector& x,
                                   const Expr& t) const {
  const auto is_one_of = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const Definition& definition : definitions)
    if (is_one_of(definition.name)) return symbols({.x = x, .t = t});
  SymbolTable symbols;
  Graph graph =
      graph_of(x);  // of x as it is: each element of a network asks, and a copy has all coordinates
  if (graph.is_none()) graph = graph_of(ExprVector{{t}});
  for (const auto& [name, symbol] : parameters_in(graph))
    if (is_one_of(name)) symbols.add(name, symbol.shape, symbol.values);
  symbols.add("t", t);
  for (const auto& [name, table] : tables)
    if (is_one_of(name)) symbols.add(name, table.at(t));
  coordinates.add_to(symbols, x, names);
  return symbols;
}

bool read_names(const JsonReader& value, SymbolTable& taken, NameList& names) {
  const auto elements = value.elements();
  if (!elements) return false;
  bool right = true;
  for (const JsonReader& element : *elements) {
    const auto text = element.text();
    if (!text) {
      right = false;
      continue;
    }
    try {
      Declaration declaration = parse_declaration(*text, taken);
      taken.add(declaration.name, declaration.shape,
                ExprVector::Constant(declaration.size(), Expr(1.0)));
      names.append(std::move(declaration));
    } catch (const FormulaError& error) {
      element.problem(error.what());
      right = false;
    }
  }
  return right;
}

bool take_new_names(const NameList& names, const std::string& whose, SymbolTable& taken,
                    const JsonReader& place) {
  for (const Declaration& declaration : names.declarations()) {
    if (taken.find(declaration.name)) {
      place.problem(whose + " have the name \"" + declaration.name +
                    "\", which has a meaning already; expected another name in its place");
      return false;
    }
    taken.add(declaration.name, declaration.shape, ExprVector::Ones(declaration.size()));
  }
  return true;
}

Vocabulary read_vocabulary(ObjectReader& system, const std::vector<std::string>& reserved) {
  Vocabulary vocabulary;
  read_parameters(system, reserved, vocabulary);
  vocabulary.tables = read_named_tables(system, reserved, vocabulary.parameters);
  vocabulary.definitions = read_definitions(system);
  return vocabulary;
}

void check_definitions(Vocabulary& vocabulary, Findings& findings) {
  std::vector<Definition> checked;
  std::swap(checked, vocabulary.definitions);
  Graph graph;
  const Index N = vocabulary.coordinates.size();
  const Vocabulary::Arguments all{.x = graph.variables("x", N),
                                  .velocity = graph.variables("v", N),
                                  .z = graph.variables("z", vocabulary.unknowns.size()),
                                  .t = graph.variable("t")};
  SymbolTable symbols = vocabulary.symbols(all);
  DefinitionRates rates(vocabulary, all);
  for (Definition& definition : checked) {
    if (!is_new_name(definition.name, definition.pointer, symbols, findings)) continue;
    WrittenFormulas& formulas = definition.formulas;
    if (!check(formulas, symbols, findings))
      for (WrittenFormula& formula : formulas.formulas) formula.text = "1";
    symbols.add(definition.name, formulas.shape, evaluate(formulas, symbols));
    rates.add(definition, symbols);
    vocabulary.definitions.push_back(std::move(definition));
  }
}

}  // namespace courant
