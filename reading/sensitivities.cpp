#include "courant/reading/sensitivities.hpp"

#include <algorithm>

#include "courant/core/language/declaration.hpp"
#include "courant/core/words/spelling.hpp"

namespace courant {
namespace {

using Variable = Sensitivities::Variable;

// What may be varied, and where it is.
class Variables {
 public:
  Variables(const Model& model, const InitialValues& initial)
      : vocabulary_(model.vocabulary), initial_(initial) {
    for (const auto& [name, symbol] : vocabulary_.parameters)
      parameters_.append({name, symbol.shape});
  }

  // The elements of what the word names; none, and a problem, where it is nothing that can be varied.
  std::vector<Variable> named(const std::string& word, const JsonReader& place) const {
    const auto& quantities = initial_.quantities;
    const auto quantity = std::ranges::find_if(
        quantities, [&](const GivenQuantity& given) { return given.formula.text == word; });
    if (quantity != quantities.end())
      return {{.kind = Variable::Kind::quantity,
               .name = word,
               .pointer = place.pointer(),
               .index = quantity - quantities.begin(),
               .value = quantity->value}};
    try {
      const Reference reference = parse_reference(word);
      if (!reference.is_velocity && parameters_.contains(reference.name))
        return elements_of_parameter(reference, place);
      return given(reference, place);
    } catch (const FormulaError& error) {
      place.problem(error.what());
    }
    return {};
  }

 private:
  std::vector<Variable> elements_of_parameter(const Reference& reference,
                                              const JsonReader& place) const {
    const auto [first, count] = parameters_.find(reference);
    const Index whole = parameters_.find({reference.name, {}, false}).first;
    const auto parameter = std::ranges::find_if(
        vocabulary_.parameters, [&](const auto& p) { return p.first == reference.name; });
    const auto names = Declaration{reference.name, parameter->second.shape}.element_names();
    std::vector<Variable> elements;
    for (Index i = first - whole; i < first - whole + count; ++i)
      elements.push_back({.kind = Variable::Kind::parameter,
                          .name = names[static_cast<std::size_t>(i)],
                          .pointer = place.pointer(),
                          .parameter = reference.name,
                          .index = i,
                          .value = parameter->second.values[i].value()});
    return elements;
  }

  std::vector<Variable> given(const Reference& reference, const JsonReader& place) const {
    const bool is_unknown = !reference.is_velocity && vocabulary_.unknowns.contains(reference.name);
    const NameList& list = is_unknown ? vocabulary_.unknowns : vocabulary_.coordinates;
    if (!list.contains(reference.name)) {
      std::vector<std::string> known;
      for (const NameList* names : {&parameters_, &vocabulary_.coordinates, &vocabulary_.unknowns})
        for (const Declaration& declaration : names->declarations())
          known.push_back(declaration.name);
      place.problem("unknown name \"" + reference.name + "\"" +
                    did_you_mean(reference.name, known) +
                    "; expected a parameter of the system, or a value that \"initial\" has");
      return {};
    }
    const auto [first, count] = list.find(reference);
    const PartialVector& values = is_unknown              ? initial_.z
                                  : reference.is_velocity ? initial_.velocity
                                                          : initial_.x;
    const auto kind = is_unknown              ? Variable::Kind::unknown
                      : reference.is_velocity ? Variable::Kind::velocity
                                              : Variable::Kind::coordinate;
    const std::vector<std::string> names = list.element_names();
    std::vector<Variable> variables;
    for (Index i = first; i < first + count; ++i) {
      const std::string name =
          names[static_cast<std::size_t>(i)] + (reference.is_velocity ? "'" : "");
      if (values.given.size() <= i || !values.given[i]) {
        place.problem(
            "the initial value of " + name +
            " is not given, but follows from others; expected a value that \"initial\" has");
        return {};
      }
      variables.push_back({.kind = kind,
                           .name = name,
                           .pointer = place.pointer(),
                           .index = i,
                           .value = values.values[i]});
    }
    return variables;
  }

  const Vocabulary& vocabulary_;
  const InitialValues& initial_;
  NameList parameters_;
};

// The elements of what a word names among the coordinates, or the quantity of a state.
class Quantities {
 public:
  Quantities(const Model& model, const std::vector<DeclaredSymmetry>& symmetries,
             const std::vector<Observable>& observables)
      : model_(model), observables_(observables) {
    const ImplicitSystem& system = *model.system;
    const ExprVector x = graph_.variables("x", system.manifold()->ambient_dimension()),
                     v = graph_.variables("v", system.manifold()->tangent_dimension()),
                     z = graph_.variables("z", system.auxiliary_size());
    symbols_ = words_of_state(model, symmetries, observables, x, v, z, graph_.variable("t"));
  }

  std::vector<Sensitivities::Quantity> named(const std::string& word,
                                             const JsonReader& place) const {
    const auto& names = model_.system->names().coordinates;
    std::vector<Sensitivities::Quantity> found;
    try {
      const Reference reference = parse_reference(word);
      const std::string name = reference.name + (reference.is_velocity ? "'" : "");
      const Symbol* symbol = reference.is_velocity ? symbols_.find_velocity(reference.name)
                                                   : symbols_.find(reference.name);
      if (!symbol) return unknown(word, place);
      std::vector<std::string> elements = {word};
      if (reference.indices.empty() && !symbol->shape.empty()) {
        elements = Declaration{reference.name, symbol->shape}.element_names();
        if (reference.is_velocity)
          for (std::string& element : elements) element += '\'';
      }
      for (const std::string& element : elements) {
        const auto coordinate = std::ranges::find(names, element);
        if (coordinate != names.end())
          found.push_back({element, coordinate - names.begin()});
        else if (check(WrittenFormula{element, place.pointer()}, symbols_, place.findings()))
          found.push_back({element});
      }
    } catch (const FormulaError&) {
      return unknown(word, place);
    }
    return found;
  }
  std::vector<Sensitivities::Quantity> coordinates() const {
    std::vector<Sensitivities::Quantity> all;
    for (const std::string& name : model_.system->names().coordinates)
      all.push_back({name, std::ssize(all)});
    return all;
  }

 private:
  std::vector<Sensitivities::Quantity> unknown(const std::string& word,
                                               const JsonReader& place) const {
    const bool is_of_run =
        std::ranges::find(observables_, word, &Observable::name) != observables_.end();
    place.problem(is_of_run ? "\"" + word +
                                  "\" is observed at a stage, or of energies since the beginning; "
                                  "expected a quantity of states"
                            : "\"" + word +
                                  "\" is no quantity of the run; expected a coordinate, H, or the "
                                  "name of an entry of \"observe\"");
    return {};
  }

  const Model& model_;
  const std::vector<Observable>& observables_;
  Graph graph_;
  SymbolTable symbols_;
};

// What is read of each word of a list; a problem for what is there twice.
template <class Read, class Entry>
void read_words(const JsonReader& list, const Read& read, std::vector<Entry>& entries) {
  const auto elements = list.elements();
  if (!elements) return;
  for (const JsonReader& element : *elements) {
    const auto word = element.text();
    if (!word) continue;
    for (Entry& entry : read(*word, element)) {
      if (std::ranges::find(entries, entry.name, &Entry::name) != entries.end())
        element.problem("has " + entry.name + ", which is there twice; expected each once");
      else
        entries.push_back(std::move(entry));
    }
  }
}

}  // namespace

std::vector<Parameter> Sensitivities::parameters() const {
  std::vector<Parameter> found;
  for (const Variable& variable : by)
    if (variable.kind == Variable::Kind::parameter)
      found.push_back({variable.name, variable.value});
  return found;
}

std::vector<std::string> Sensitivities::columns() const {
  std::vector<std::string> names;
  for (const Quantity& quantity : of)
    for (const Variable& variable : by)
      names.push_back("d(" + quantity.name + ")/d(" + variable.name + ")");
  return names;
}

SymbolTable words_of_state(const Model& model, const std::vector<DeclaredSymmetry>& symmetries,
                           const std::vector<Observable>& observables, const ExprVector& x,
                           const ExprVector& v, const ExprVector& z, const Expr& t) {
  SymbolTable symbols = model.symbols_with_energy(x, v, z, t);
  for (const DeclaredSymmetry& declared : symmetries)
    if (symbols.find(declared.name) == nullptr)
      symbols.add(declared.name, declared.symmetry.momentum(x));
  for (const Observable& observable : observables)
    if (!observable.at_stage && !observable.uses_energies &&
        symbols.find(observable.name) == nullptr)
      symbols.add(observable.name, evaluate(observable.formula, symbols));
  return symbols;
}

std::optional<Sensitivities> read_sensitivities(const JsonReader& value, const Model& model,
                                                const InitialValues& initial,
                                                const std::vector<DeclaredSymmetry>& symmetries,
                                                const std::vector<Observable>& observables) {
  ObjectReader object(value);
  if (!value.value().is_object()) return std::nullopt;
  Sensitivities result;
  const Variables variables(model, initial);
  const Quantities quantities(model, symmetries, observables);
  const auto by = object.optional("by"), of = object.optional("of"),
             exponents = object.optional("lyapunov");
  if (by)
    read_words(
        *by,
        [&](const std::string& word, const JsonReader& place) {
          return variables.named(word, place);
        },
        result.by);
  if (of)
    read_words(
        *of,
        [&](const std::string& word, const JsonReader& place) {
          return quantities.named(word, place);
        },
        result.of);
  else
    result.of = quantities.coordinates();
  if (exponents) {
    if (!exponents->value().is_boolean()) exponents->expected("true or false");
    result.has_exponents = exponents->value() == true;
  }
  if (value.findings().clean() && result.by.empty() && !result.has_exponents)
    value.problem(
        "asks for nothing; expected \"by\", an array of names of parameters and initial values");
  return result;
}

}  // namespace courant
