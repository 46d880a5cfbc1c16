#include "courant/reading/boundary.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/language/declaration.hpp"
#include "courant/manifolds/cotangent_bundle.hpp"

namespace courant {
namespace {

// What a condition may be made of: the words of the model, H, and what has a name besides.
SymbolTable words_at_end(const Model& model, const NamedFormulas& named, const ExprVector& x,
                         const ExprVector& v, const ExprVector& z, const Expr& t) {
  SymbolTable symbols = model.symbols_with_energy(x, v, z, t);
  for (const auto& [name, formula] : named)
    if (symbols.find(name) == nullptr) symbols.add(name, evaluate(formula, symbols));
  return symbols;
}

struct EndVariables {
  explicit EndVariables(const Model& model)
      : x(graph.variables("x", model.system->manifold()->ambient_dimension())),
        v(graph.variables("v", model.system->manifold()->tangent_dimension())),
        z(graph.variables("z", model.system->auxiliary_size())),
        t(graph.variable("t")) {}
  SymbolTable words(const Model& model, const NamedFormulas& named) const {
    return words_at_end(model, named, x, v, z, t);
  }
  ExprVector all_but_time() const { return joined(x, v, z); }

  Graph graph;
  ExprVector x, v, z;
  Expr t;
};

Expr left_side(const BoundaryCondition& condition, const SymbolTable& symbols) {
  return evaluate(condition.formula, symbols) - evaluate(condition.value, symbols);
}

// The formulas of an entry by the key, or, where the key is the name of an array, by the names of its entries; none where
// there are not as many as names.
NamedFormulas keyed_formulas(const std::string& key, const JsonReader& value,
                             const SymbolTable& symbols) {
  const Symbol* symbol = symbols.find(key);
  const auto values = read_formulas(value);
  if (!values) return {};
  std::vector<std::string> names = {key};
  if (symbol && !symbol->shape.empty()) names = Declaration{key, symbol->shape}.element_names();
  if (values->formulas.size() != names.size()) {
    value.problem("has " + std::to_string(values->formulas.size()) + " values; expected " +
                  std::to_string(names.size()) + ", for " + key);
    return {};
  }
  NamedFormulas result;
  for (std::size_t i = 0; i < names.size(); ++i) result.emplace_back(names[i], values->formulas[i]);
  return result;
}

// The key of an entry is a formula, or the name of an array whose entries have the values.
void read_condition(const std::string& key, const JsonReader& value, const EndVariables& at,
                    const SymbolTable& symbols, std::vector<BoundaryCondition>& conditions) {
  for (const auto& [name, formula] : keyed_formulas(key, value, symbols)) {
    const BoundaryCondition condition{name, {name, value.pointer()}, formula};
    Findings of_key;
    if (!check(condition.formula, symbols, of_key)) {
      for (const Problem& problem : of_key.problems()) value.problem("key, " + problem.what);
      return;
    }
    if (!check(condition.value, symbols, value.findings())) return;
    if (!depends(ExprVector{{left_side(condition, symbols)}}, at.all_but_time())) {
      value.problem("key, \"" + key +
                    "\" does not depend on the state; expected a coordinate or a formula of them");
      return;
    }
    conditions.push_back(condition);
  }
}

std::vector<BoundaryCondition> read_conditions(const std::optional<JsonReader>& value,
                                               const Model& model, const NamedFormulas& named) {
  std::vector<BoundaryCondition> conditions;
  const auto entries = value ? value->entries() : std::nullopt;
  if (!entries) return conditions;
  const EndVariables at(model);
  const SymbolTable symbols = at.words(model, named);
  for (const auto& [key, entry] : *entries) read_condition(key, entry, at, symbols, conditions);
  return conditions;
}

std::vector<std::pair<Index, WrittenFormula>> read_guess(const JsonReader& value,
                                                         const Model& model) {
  std::vector<std::pair<Index, WrittenFormula>> guess;
  const auto entries = value.entries();
  if (!entries) return guess;
  const EndVariables at(model);
  const SymbolTable symbols = at.words(model, {});
  Graph graph;
  const SymbolTable of_time = model.vocabulary.of_time().symbols({.t = graph.variable("t")});
  const auto& coordinates = model.system->names().coordinates;
  for (const auto& [key, entry] : *entries)
    for (const auto& [name, formula] : keyed_formulas(key, entry, symbols)) {
      const auto found = std::ranges::find(coordinates, name);
      if (found == coordinates.end())
        entry.problem("key, \"" + key + "\" is no coordinate; expected one");
      else if (check(formula, of_time, entry.findings()))
        guess.emplace_back(found - coordinates.begin(), formula);
    }
  return guess;
}

bool is_true(const JsonReader& value) {
  if (!value.value().is_boolean()) value.expected("true or false");
  return value.value() == true;
}

std::optional<Boundary::Continuation> read_continuation(const JsonReader& value,
                                                        const Model& model) {
  ObjectReader object(value);
  const auto parameter = object.required("parameter"), from_key = object.required("from");
  const auto name = parameter ? parameter->text() : std::nullopt;
  const auto from = from_key ? from_key->number() : std::nullopt;
  if (!name || !from) return std::nullopt;
  const auto& parameters = model.vocabulary.parameters;
  const auto found =
      std::ranges::find_if(parameters, [&](const auto& p) { return p.first == *name; });
  if (found == parameters.end() || !found->second.shape.empty()) {
    parameter->expected("a parameter of the system that is a number");
    return std::nullopt;
  }
  return Boundary::Continuation{*name, *from, found->second.values[0].value()};
}

// The parts of a condition of optimal control.
struct ControlledEnd {
  std::shared_ptr<const CotangentBundle> bundle;
  Index states() const { return bundle->base()->ambient_dimension(); }
};

std::optional<ControlledEnd> controlled_end(const Model& model) {
  if (!model.is_control_problem) return std::nullopt;
  const auto bundle = std::dynamic_pointer_cast<const CotangentBundle>(model.system->manifold());
  if (!bundle) return std::nullopt;
  return ControlledEnd{bundle};
}

// Whether each of the first coordinates is given by its name.
bool are_given(const std::vector<BoundaryCondition>& conditions, const Model& model, Index count) {
  const auto& names = model.system->names().coordinates;
  return std::all_of(names.begin(), names.begin() + count, [&](const std::string& name) {
    return std::ranges::find(conditions, name, &BoundaryCondition::name) != conditions.end();
  });
}

}  // namespace

bool Boundary::has_transversality(const Model& model, bool at_end) const {
  const auto control = controlled_end(model);
  if (!control || is_periodic) return false;
  const EndVariables at(model);
  const SymbolTable symbols = at.words(model, named);
  const ExprVector others = joined(at.x.tail(at.x.size() - control->states()), at.v, at.z);
  return std::ranges::none_of(at_end ? final : initial, [&](const BoundaryCondition& condition) {
    return depends(ExprVector{{left_side(condition, symbols)}}, others);
  });
}

std::optional<Boundary> read_boundary(const JsonReader& value, const Model& model,
                                      NamedFormulas named) {
  ObjectReader object(value);
  if (!value.value().is_object()) return std::nullopt;
  Boundary boundary;
  boundary.named = std::move(named);
  boundary.initial = read_conditions(object.optional("initial"), model, boundary.named);
  boundary.final = read_conditions(object.optional("final"), model, boundary.named);
  if (const auto free = object.optional("free"))
    if (const auto words = free->elements())
      for (const JsonReader& word : *words)
        if (word.word({"T"})) boundary.has_free_time = true;
  if (const auto guess = object.optional("guess")) boundary.guess = read_guess(*guess, model);
  if (const auto periodic = object.optional("periodic")) boundary.is_periodic = is_true(*periodic);
  if (const auto continuation = object.optional("continuation"))
    boundary.continuation = read_continuation(*continuation, model);
  if (const auto segments = object.optional("segments"))
    boundary.segments = static_cast<long>(segments->integer(1).value_or(0));
  if (boundary.initial.empty() && boundary.final.empty() && !boundary.is_periodic &&
      value.findings().clean())
    value.problem("has no conditions; expected \"initial\", \"final\" or \"periodic\"");
  if (model.final_cost && value.findings().clean() && !boundary.has_transversality(model, true))
    value.problem(
        "leaves the final_cost of the system out: conditions at the end contain costates or "
        "controls; expected conditions on states and t alone");
  return boundary;
}

void take_guess(const Boundary& boundary, const Model& model, State& state) {
  const SymbolTable symbols = model.vocabulary.of_time().symbols({.t = Expr(state.t)});
  for (const auto& [coordinate, formula] : boundary.guess)
    state.x[coordinate] = evaluate(formula, symbols).value();
}

EndConditions end_conditions(const Boundary& boundary, const Model& model, bool at_end) {
  const std::vector<BoundaryCondition> conditions = at_end ? boundary.final : boundary.initial;
  EndConditions result;
  for (const BoundaryCondition& condition : conditions)
    result.names.push_back(condition.name + (at_end ? " at the end" : " at the beginning"));
  const auto given = [conditions, model, named = boundary.named](const EndPoint& at) {
    const SymbolTable symbols = words_at_end(model, named, at.x, at.v, at.z, at.t);
    ExprVector g(std::ssize(conditions));
    for (Index i = 0; i < g.size(); ++i)
      g[i] = left_side(conditions[static_cast<std::size_t>(i)], symbols);
    return g;
  };
  const EndVariables variables(model);
  const bool contains_time =
      depends(given({variables.x, variables.v, variables.z, variables.t, ExprVector(0)}),
              ExprVector{{variables.t}});
  const auto control = controlled_end(model);
  const bool adds = boundary.has_transversality(model, at_end);
  const bool of_time = adds && at_end && boundary.has_free_time;
  const bool moves = of_time && contains_time;  // then E is that of ν, which p determines
  const bool of_states = adds && (moves || !are_given(conditions, model, control->states()));
  if (!of_states && !of_time) {
    if (!conditions.empty()) result.formula = given;
    return result;
  }
  result.multipliers = of_states ? std::ssize(conditions) : 0;
  const Manifold& Q = *control->bundle->base();
  const auto& names = model.system->names().coordinates;
  if (of_states)
    for (Index i = 0; i < Q.tangent_dimension(); ++i)
      result.names.push_back("transversality of " +
                             names[static_cast<std::size_t>(Q.ambient_dimension() + i)] +
                             (at_end ? " at the end" : " at the beginning"));
  if (of_time) result.names.emplace_back("transversality of H at the end");
  result.formula = [=, named = boundary.named, bundle = control->bundle](const EndPoint& at) {
    const ExprVector g = given(at);
    Expr weighted =
        at_end && model.final_cost
            ? evaluate(*model.final_cost, words_at_end(model, named, at.x, at.v, at.z, at.t))
            : Expr(0.0);
    for (Index i = 0; i < at.multipliers.size(); ++i)
      weighted = weighted + at.multipliers[i] * g[i];
    ExprVector all = g;
    if (of_states) {
      const ExprVector q = bundle->position(at.x), p = bundle->fibre_part(at.x);
      const ExprVector slope = gradient(weighted, at.x).head(q.size());
      all = joined(all, p + bundle->base()->frame(q).transpose() * slope);
    }
    if (of_time)
      all = joined(all, ExprVector{{*model.system->energy(at.x, at.z, at.t) -
                                    gradient(weighted, ExprVector{{at.t}})[0]}});
    return all;
  };
  return result;
}

}  // namespace courant
