#include "courant/reading/initial_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "courant/core/expressions/derivative.hpp"
#include "courant/reading/cell_formulas.hpp"
#include "courant/reading/repetition.hpp"
#include "courant/structures/stokes_dirac/cell_forms.hpp"

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
    symbols_ = model.symbols_with_energy(
        graph_.variables("x", M.ambient_dimension()), graph_.variables("v", M.tangent_dimension()),
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

// A quantity, or all the entries of one that is an array. Whether it is one.
bool read_quantity(const std::string& key, const JsonReader& value, const SymbolTable& constants,
                   const Observables& known, InitialValues& values) {
  std::vector<std::string> entries;
  for (Index i = 0; known.has(key + "[" + std::to_string(i) + "]"); ++i)
    entries.push_back(key + "[" + std::to_string(i) + "]");
  if (entries.empty()) {
    if (!known.has(key)) return false;
    entries.push_back(key);
  }
  const auto formulas = read_formulas(value);
  if (!formulas) return true;
  if (formulas->formulas.size() != entries.size()) {
    value.problem("has " + std::to_string(formulas->formulas.size()) + " values; expected " +
                  std::to_string(entries.size()) + ", for " + key);
    return true;
  }
  const auto numbers = evaluate_constants(*formulas, constants, value.findings());
  if (!numbers) return true;
  for (std::size_t i = 0; i < entries.size(); ++i)
    values.quantities.push_back({{entries[i], value.pointer()}, (*numbers)[static_cast<Index>(i)]});
  return true;
}

void read_entry(const std::string& key, const JsonReader& value, const SymbolTable& constants,
                const Model& model, InitialValues& values) {
  Target target{};
  try {
    target = find(parse_reference(key), model.vocabulary, values);
  } catch (const FormulaError& error) {
    if (!read_quantity(key, value, constants, Observables(model), values))
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

// The entry `"q": {"form": "cos(pi*x)"}` of coordinates that are the integrals of a form over cells.
void read_form_entry(const std::string& key, const JsonReader& entry, const SymbolTable& constants,
                     const Model& model, InitialValues& values) {
  ObjectReader object(entry);
  const JsonReader value = *object.required("form");
  Target target{};
  try {
    target = find(parse_reference(key), model.vocabulary, values);
  } catch (const FormulaError& error) {
    return value.problem(std::string("key, ") + error.what());
  }
  const std::vector<CellForm> forms = cell_forms(*model.system);
  const auto form = std::ranges::find_if(forms, [&](const CellForm& one) {
    return target.vector == &values.x && one.first == target.first &&
           one.sizes.size() == target.count;
  });
  if (form == forms.end())
    return value.problem("is of " + key + ", which has no numbers of cells; expected a value");
  const auto formulas = read_form(value, *form);
  SymbolTable sample = constants;
  add_place(sample, form->positions, 0);
  if (!formulas || !check(*formulas, sample, value.findings())) return;
  std::vector<Index> cells(static_cast<std::size_t>(target.count));
  std::iota(cells.begin(), cells.end(), Index{0});
  const ExprVector numbers = integrated(*form, cells, *formulas, constants);
  for (Index i = 0; i < target.count; ++i) {
    if (!numbers[i].is_constant() || !std::isfinite(numbers[i].value()))
      return value.problem("is not a finite number at the cell " + std::to_string(i) +
                           "; expected one everywhere");
    target.vector->values[target.first + i] = numbers[i].value();
  }
  target.vector->given.segment(target.first, target.count) = true;
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
  if (entry.value().contains("form")) return read_form_entry(key, entry, constants, model, values);
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

// A coordinate that M has no unit for, or one unit for several, cannot be measured by any size.
void check_sizes(const JsonReader& value, const std::string& key, const Model& model,
                 const VectorXd& sizes, Index first, Index count) {
  const std::vector<Index> units = model.system->manifold()->scaling_symmetries().point;
  const auto unit = [&](Index i) { return units[static_cast<std::size_t>(i)]; };
  for (Index i = first; i < first + count; ++i) {
    if (unit(i) == Manifold::ScalingSymmetries::none)
      return value.problem("is the size of " + key + ", which has none on " +
                           model.system->manifold()->name() + "; expected no size of it");
    for (Index j = 0; j < sizes.size(); ++j)
      if (unit(j) == unit(i) && sizes[j] > 0.0 && sizes[j] != sizes[i])
        return value.problem("differs from the size of another coordinate that " +
                             model.system->manifold()->name() +
                             " has one unit for; expected the same");
  }
}

void read_nominal_size(const std::string& key, const JsonReader& value, const Model& model,
                       InitialValues& values) {
  Target target{};
  try {
    target = find(parse_reference(key), model.vocabulary, values);
  } catch (const FormulaError& error) {
    return value.problem(std::string("key, ") + error.what());
  }
  if (target.vector == &values.velocity)
    return value.problem("is the size of a velocity; expected that of a coordinate or an unknown");
  const bool of_coordinates = target.vector == &values.x;
  auto sizes = (of_coordinates ? values.nominal.coordinates : values.nominal.unknowns)
                   .segment(target.first, target.count);
  if ((sizes.array() > 0.0).any()) return value.problem("is given twice");
  if (value.value().is_array()) {
    const auto numbers = value.elements();
    if (std::ssize(*numbers) != target.count)
      return value.problem("has " + std::to_string(numbers->size()) + " values; expected " +
                           std::to_string(target.count) + ", for " + key + ", or one for all");
    for (std::size_t i = 0; i < numbers->size(); ++i) {
      const auto size = (*numbers)[i].positive_number();
      if (!size) return;
      sizes[static_cast<Index>(i)] = *size;
    }
  } else if (const auto size = value.positive_number()) {
    sizes.setConstant(*size);
  } else {
    return;
  }
  if (of_coordinates)
    check_sizes(value, key, model, values.nominal.coordinates, target.first, target.count);
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

// Coordinates that are not given begin at the reference of the model.
void begin_at_reference(const Model& model, InitialValues& values) {
  std::vector<std::pair<std::string, double>> given;
  for (const GivenQuantity& quantity : values.quantities)
    given.emplace_back(quantity.formula.text, quantity.value);
  const std::vector<std::string> names = model.vocabulary.coordinates.element_names();
  for (std::size_t i = 0; i < names.size(); ++i)
    if (values.x.given[static_cast<Index>(i)])
      given.emplace_back(names[i], values.x.values[static_cast<Index>(i)]);
  values.x.values = values.x.given.select(values.x.values, model.reference(given));
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
  const NameList &names = model.vocabulary.coordinates, &unknowns = model.vocabulary.unknowns;
  const auto is_given = [&](const std::string& unknown) {
    if (!unknowns.contains(unknown)) return false;
    const auto [first, count] = unknowns.find(Reference{unknown, {}});
    return values.z.given.segment(first, count).any();
  };
  for (const Declaration& declaration : names.declarations()) {
    const std::string momentum = "p_" + declaration.name;
    if (!names.contains(momentum)) continue;
    any = true;
    const auto [position, count] = names.find(Reference{declaration.name, {}});
    const auto [first, momenta] = names.find(Reference{momentum, {}});
    const auto given = values.x.given.segment(first, momenta);
    // Of a matrix of rotation the momentum has fewer entries: all of its rates are 0, or none is said to be.
    if ((momenta != count && given.any()) || is_given("v_" + declaration.name)) continue;
    for (Index i = 0; i < count; ++i)
      if (momenta != count || !given[i]) set(values.velocity, position + i);
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

std::vector<Index> indices(const Flags& flags) {
  std::vector<Index> list;
  for (Index i = 0; i < flags.size(); ++i)
    if (flags[i]) list.push_back(i);
  return list;
}

PartialVector::PartialVector(Index size)
    : values(VectorXd::Zero(size)), given(Flags::Constant(size, false)), held(given) {}

namespace {

// cost/size² where a size is given.
VectorXd by_sizes(const VectorXd& cost, const VectorXd& sizes) {
  VectorXd result = cost;
  for (Index i = 0; i < sizes.size(); ++i)
    if (sizes[i] > 0.0) result[i] /= sizes[i] * sizes[i];
  return result;
}

}  // namespace

VectorXd InitialValues::cost_of_coordinates() const {
  return by_sizes(weight, nominal.coordinates);
}

VectorXd InitialValues::cost_of_unknowns() const {
  return by_sizes(VectorXd::Ones(z.values.size()), nominal.unknowns);
}

std::optional<InitialValues> read_initial_values(const JsonReader& initial,
                                                 const std::optional<JsonReader>& hold,
                                                 const std::optional<JsonReader>& weights,
                                                 const std::optional<JsonReader>& nominal,
                                                 const Model& model) {
  const Index N = model.vocabulary.coordinates.size();
  InitialValues values{PartialVector(N), PartialVector(N),
                       PartialVector(model.vocabulary.unknowns.size()), VectorXd::Ones(N)};
  values.nominal = {VectorXd::Zero(N), VectorXd::Zero(values.z.values.size())};
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
  if (model.reference) begin_at_reference(model, values);
  if (rests && !rest(model, values) && !model.starts_at_zero)
    initial.problem("asks for rest, but no coordinate has a velocity; expected values");
  if (const auto names = hold ? hold->elements() : std::nullopt)
    for (const JsonReader& name : *names) read_hold(name, model, values);
  if (const auto entries_of_weights = weights ? weights->entries() : std::nullopt)
    for (const auto& [key, value] : *entries_of_weights) read_weight(key, value, model, values);
  if (const auto sizes = nominal ? nominal->entries() : std::nullopt)
    for (const auto& [key, value] : *sizes) read_nominal_size(key, value, model, values);
  if (model.point_problem) {
    const VectorXd x =
        values.x.given.select(values.x.values, std::numeric_limits<double>::quiet_NaN());
    if (const auto problem = model.point_problem(x)) initial.problem(*problem);
  }
  return values;
}

}  // namespace courant
