#include "courant/reading/initial_values.hpp"

#include <algorithm>
#include <limits>

#include "courant/core/expressions/derivative.hpp"
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

// All that may be observed of a model.
class Observables {
 public:
  explicit Observables(const Model& model) {
    const ImplicitSystem& system = *model.system;
    const Manifold& M = *system.manifold();
    symbols_ = model.symbols(graph_.variables("x", M.ambient_dimension()),
                             graph_.variables("v", M.tangent_dimension()),
                             graph_.variables("z", system.auxiliary_size()), graph_.variable("t"));
  }
  // Whether the name is that of a quantity which depends on the state.
  bool has(const std::string& name) const {
    Findings findings;
    const WrittenFormula formula{name, ""};
    return check(formula, symbols_, findings) && !evaluate(formula, symbols_).is_constant();
  }

 private:
  Graph graph_;
  SymbolTable symbols_;
};

void read_quantity(const std::string& key, const JsonReader& value, const SymbolTable& constants,
                   InitialValues& values) {
  const auto formula = read_formula(value);
  if (!formula) return;
  const auto number = evaluate_constants({{}, {*formula}}, constants, value.findings());
  if (number) values.quantities.push_back({{key, value.pointer()}, (*number)[0]});
}

void read_entry(const std::string& key, const JsonReader& value, const SymbolTable& constants,
                const Model& model, InitialValues& values) {
  Target target{};
  try {
    target = find(parse_reference(key), model.vocabulary, values);
  } catch (const FormulaError& error) {
    if (Observables(model).has(key))
      read_quantity(key, value, constants, values);
    else
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
  for (GivenQuantity& quantity : values.quantities)
    if (quantity.formula.text == *text) {
      quantity.held = true;
      return;
    }
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

// Of an equation c (x_j' - x_k) = 0: j and k.
std::optional<std::pair<Index, Index>> velocity_in(const Expr& equation, const ExprVector& x,
                                                   const ExprVector& v, const ExprVector& others) {
  const ExprVector one{{equation}};
  const SparseExprMatrix of_x = jacobian(one, x), of_v = jacobian(one, v);
  const auto is_constant = [](const SparseExprMatrix& row) {
    return row.values.size() == 1 && row.values[0].is_constant();
  };
  if (!is_constant(of_x) || !is_constant(of_v) || jacobian(one, others).values.size() > 0)
    return std::nullopt;
  if (of_x.values[0].value() != -of_v.values[0].value()) return std::nullopt;
  return std::pair(of_v.col[0], of_x.col[0]);
}

// 0 for the velocities that are not given. Whether there are any.
bool rest(const Model& model, InitialValues& values) {
  const ImplicitSystem& system = *model.system;
  const Manifold& M = *system.manifold();
  bool any = false;
  const auto set = [](PartialVector& vector, Index i) {
    if (!vector.given[i]) vector.values[i] = 0.0;
    vector.given[i] = true;
  };
  const std::vector<std::string>& names = system.names().coordinates;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto momentum = std::ranges::find(names, "p_" + names[i]);
    if (momentum == names.end()) continue;
    any = true;
    if (!values.x.given[momentum - names.begin()]) set(values.velocity, static_cast<Index>(i));
  }
  if (any || M.tangent_dimension() != M.ambient_dimension()) return any;
  Graph graph;
  const ExprVector x = graph.variables("x", M.ambient_dimension()),
                   v = graph.variables("v", M.tangent_dimension());
  ExprVector others(system.auxiliary_size() + 1);
  others << graph.variables("z", system.auxiliary_size()), graph.variable("t");
  const ExprVector residual =
      system.residual(x, v, others.head(others.size() - 1).eval(), others[others.size() - 1]);
  for (const Expr& equation : residual)
    if (const auto pair = velocity_in(equation, x, v, others)) {
      any = true;
      const auto [position, velocity] = *pair;
      if (!values.velocity.given[position]) set(values.x, velocity);
    }
  return any;
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
  const bool is_word = initial.value() == "rest";
  bool rests = is_word;
  if (!is_word) {
    const auto entries = initial.entries();
    if (!entries) return std::nullopt;
    const SymbolTable constants = model.vocabulary.symbols({});
    for (const auto& [key, value] : *entries) {
      if (key == "rest" && value.value().is_boolean())
        rests = value.value().get<bool>();
      else
        read_entries(key, value, constants, model, values);
    }
  }
  if (rests && !rest(model, values))
    initial.problem("asks for rest, but no coordinate has a velocity; expected values");
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
