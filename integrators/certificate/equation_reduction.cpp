#include "courant/integrators/certificate/equation_reduction.hpp"

#include <algorithm>
#include <cmath>

#include "courant/core/expressions/subgraph.hpp"
#include "courant/core/language/declaration.hpp"
#include "courant/core/language/formula.hpp"
#include "courant/core/numbers/parallel.hpp"

namespace courant {
namespace {

constexpr double of_varying = 1000.0;  // what a coefficient costs that is no number
constexpr std::size_t longest = 450;   // characters of a formula: five lines
constexpr std::size_t most_operations = 20000, most_operations_of_one = 1000;

}  // namespace

ExprVector variables_named(const Graph& graph, const std::vector<std::string>& names) {
  ExprVector result(static_cast<Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i)
    result[static_cast<Index>(i)] = graph.variable(names[i]);
  return result;
}

ExprVector added_parameters(const Graph& graph, const std::vector<Parameter>& parameters) {
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  return add_parameters(graph, names);
}

EquationReduction::EquationReduction(const ImplicitSystem& system,
                                     const std::vector<std::string>& velocities, const State& point,
                                     const std::vector<Parameter>& parameters)
    : parameters_(added_parameters(graph_, parameters)),
      x_(variables_named(graph_, system.names().coordinates)),
      t_(graph_.variable("t")) {
  const Manifold& M = *system.manifold();
  const ExprVector rates = variables_named(graph_, velocities);
  const ExprVector z = variables_named(graph_, system.names().auxiliary);
  velocity_count_ = rates.size();
  unknowns_.resize(rates.size() + z.size());
  unknowns_ << rates, z;
  solution_ = unknowns_;
  solved_.assign(static_cast<std::size_t>(unknowns_.size()), false);
  in_solution_.resize(solved_.size());
  motion_ = M.frame(x_) * rates;
  VectorXd of_parameters(parameters_.size());
  for (Index i = 0; i < of_parameters.size(); ++i)
    of_parameters[i] = parameters[static_cast<std::size_t>(i)].value;
  numbers_.resize(x_.size() + 1 + unknowns_.size() + parameters_.size());
  numbers_ << point.x, point.t, point.v, point.z, of_parameters;

  ExprVector v = rates;
  const ExprVector constraint = M.constraint(x_);
  const std::vector<Expr> on_manifold(constraint.begin(), constraint.end());
  on_points_.relations = NormalForm(x_, on_manifold).basis();
  on_vectors_ = on_points_;
  if (!on_manifold.empty() && M.tangent_dimension() == M.ambient_dimension()) {
    v = M.coframe(x_) * rates;
    motion_ = rates;
    numbers_.segment(x_.size() + 1, rates.size()) =
        values(M.frame(constants(point.x)) * constants(point.v));
    const ExprVector along = tangent(constraint, x_, rates);
    std::vector<Expr> relations = on_manifold;
    relations.insert(relations.end(), along.begin(), along.end());
    ExprVector all(x_.size() + 1 + unknowns_.size());
    all << x_, t_, unknowns_;
    normal_form_.emplace(all, relations);
    on_vectors_.relations = normal_form_->basis();
  }
  std::vector<std::string> names = system.names().coordinates;
  names.emplace_back("t");
  for (const auto& more : {velocities, system.names().auxiliary})
    names.insert(names.end(), more.begin(), more.end());
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  variables_.resize(numbers_.size());
  variables_ << x_, t_, unknowns_, parameters_;
  for (Index i = 0; i < variables_.size(); ++i) place_[variables_[i].node()] = i;
  symbols_ = symbols_of_elements(names, variables_);
  const ExprVector equations = system.residual(x_, v, z, t_);
  is_too_large_ = Subgraph(equations).size() > most_operations;
  if (is_too_large_) return;
  for (const Expr& equation : equations) add(equation);
  if (!normal_form_) return;
  std::vector<Expr> together;
  for (const OpenEquation& equation : equations_) together.push_back(equation.function);
  const auto others = normal_form_->eliminated(together, unknowns_);
  if (others.empty()) return;
  equations_.clear();
  for (const Expr& other : others) equations_.push_back(opened(other));
}

void EquationReduction::solve_by_numbers() {
  while (solve_one(true)) {
  }
}

std::vector<Expr> EquationReduction::open_equations() const {
  std::vector<Expr> functions;
  for (const OpenEquation& equation : equations_) functions.push_back(equation.function);
  return functions;
}

std::vector<Expr> EquationReduction::constraints() {
  while (solve_one()) {
  }
  std::vector<Expr> found;
  std::vector<OpenEquation> kept;
  for (OpenEquation& equation : equations_) {
    if (equation.function.is_constant(0.0)) continue;
    if (!slopes_of(equation).empty())
      kept.push_back(std::move(equation));
    else
      found.push_back(equation.function);
  }
  equations_ = std::move(kept);
  return found;
}

Expr EquationReduction::derivative(const Expr& function) const {
  ExprVector at(x_.size() + 1), rate(x_.size() + 1);
  at << x_, t_;
  rate << motion_, Expr(1.0);
  return tangent(ExprVector::Constant(1, function), at, rate)[0];
}

void EquationReduction::add(const Expr& equation) {
  OpenEquation open = opened(normal(equation));
  const bool is_zero = open.function.is_constant(0.0) ||
                       (slopes_of(open).empty() && simplified(open.function, on_points_) == "0");
  if (!is_zero) equations_.push_back(std::move(open));
}

std::vector<Expr> EquationReduction::consequences() const {
  std::vector<Expr> left;
  for (const OpenEquation& equation : equations_)
    if (has_unknown(equation.function)) left.push_back(equation.function);
  const Index count = variable_of(unknowns_.size());
  return NormalForm(variables_.head(count), {}).consequences(left, unknowns_);
}

bool EquationReduction::have_no_common_zero(const std::vector<Expr>& functions) const {
  return NormalForm(x_, functions).hold_nowhere();
}

Expr EquationReduction::without_factors(const Expr& function) const {
  return is_too_long(function)
             ? function
             : NormalForm(x_, {}).without_factors(function, [this](const Expr& factor) {
                 const double there = value(factor);
                 return std::isfinite(there) && std::abs(there) > 1e-6 * change(factor);
               });
}

void EquationReduction::add_constraint(const Expr& function) {
  constraints_.push_back(function);
  nearby_.reset();
}

bool EquationReduction::has_unknown(const Expr& function) const {
  const auto along = slopes(function, unknowns_in(contained(function)));
  return std::ranges::any_of(along,
                             [](const auto& slope) { return !slope.second.is_constant(0.0); });
}

double EquationReduction::value(const Expr& function) const {
  return values_at_point(ExprVector::Constant(1, function), contained(function))[0];
}

VectorXd EquationReduction::gradient_at_point(const Expr& function) const {
  const ExprVector v = unknowns_.head(velocity_count_);
  const ExprVector along = gradient(derivative(function), v);
  return values_at_point(along, contained(along));
}

std::string EquationReduction::written(const Expr& function) const {
  if (is_too_long(function)) return "";
  const std::string text = short_enough(simplified(function, given(function)));
  return says(text, value(function)) ? text : "";
}

std::string EquationReduction::written_equation(const Expr& function,
                                                const std::vector<Expr>& by) const {
  if (is_too_long(function)) return "";
  std::string text = short_enough(simplified_equation(function, given(function)));
  const std::string other =
      by.empty() ? ""
                 : short_enough(simplified_equation(function, {given(function).relations, by}));
  if (!other.empty() && (text.empty() || other.size() < text.size())) text = other;
  if (text.empty()) return "";
  const bool holds = std::abs(value(function)) <= 1e-8 * change(function);
  return !holds || says(text, 0.0) ? text : "";
}

std::vector<std::string> EquationReduction::solutions(const std::vector<Index>& of) {
  const Simplification on_solutions{on_points_.relations, constraints_};
  std::vector<Expr> functions;
  for (const Index u : of) functions.push_back(reduced(unknowns_[u]));
  std::vector<std::string> texts(of.size());
  in_parallel(of.size(), core_count(), [&](std::size_t i) {
    if (!is_too_long(functions[i])) texts[i] = short_enough(simplified(functions[i], on_solutions));
  });
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (!says(texts[i], value(functions[i]))) texts[i].clear();
    if (texts[i] != "0" && vanishes_nearby(functions[i])) texts[i] = "0";
  }
  return texts;
}

bool EquationReduction::is_function_of_the_point(Index u) {
  return solved_[static_cast<std::size_t>(u)] && !has_unknown(reduced(unknowns_[u]));
}

bool EquationReduction::is_too_long(const Expr& function) {
  return Subgraph(ExprVector::Constant(1, function)).size() > most_operations_of_one;
}

std::string EquationReduction::short_enough(const std::optional<std::string>& text) {
  return text && text->size() <= longest ? *text : "";
}

const Simplification& EquationReduction::given(const Expr& function) const {
  return has_unknown(function) ? on_vectors_ : on_points_;
}

bool EquationReduction::says(const std::string& text, double number) const {
  constexpr double digits = 1e-4;
  if (text.empty() || !symbols_ || !std::isfinite(number)) return true;
  Expr read;
  try {
    read = parse_formula(text, *symbols_);
  } catch (const FormulaError&) {
    return false;
  }
  const double there = value(read);
  return !std::isfinite(there) ||
         std::abs(there - number) <= digits * (std::abs(number) + change(read));
}

bool EquationReduction::vanishes_nearby(const Expr& function) {
  if (constraints_.empty() || has_unknown(function) || is_too_long(function)) return false;
  if (!nearby_) {
    std::vector<Expr> all = on_points_.relations;
    all.insert(all.end(), constraints_.begin(), constraints_.end());
    const Index count = x_.size() + 1;
    nearby_.emplace(variables_.head(count), numbers_.head(count), 1, parameters_,
                    numbers_.tail(parameters_.size()), all);
  }
  return nearby_->vanishes(function);
}

double EquationReduction::change(const Expr& function) const {
  const std::vector<Index> of = contained(function);
  const ExprVector along = gradient(function, ExprVector(variables_(of)));
  return values_at_point(along, of).cwiseAbs().dot(numbers_(of).cwiseAbs().cwiseMax(1.0));
}

bool EquationReduction::vanishes(const Expr& function, double others) const {
  const double least = others > 1e-6 ? 1e-10 * others : 1e-6;
  if (!(std::abs(value(function)) > least)) return true;
  return !(std::abs(value(function)) > 1e-6 * change(function));
}

VectorXd EquationReduction::values_at_point(const ExprVector& functions,
                                            const std::vector<Index>& of) const {
  const VectorXd there = numbers_(of);
  return substitute(functions, ExprVector(variables_(of)), constants(there))
      .unaryExpr([](const Expr& a) { return a.is_constant() ? a.value() : std::nan(""); });
}

std::vector<Index> EquationReduction::contained(const Expr& function) const {
  return contained(ExprVector::Constant(1, function));
}

std::vector<Index> EquationReduction::contained(const ExprVector& functions) const {
  std::vector<Index> found;
  const Subgraph subgraph(functions);
  for (const std::uint32_t node : subgraph.nodes())
    if (const auto place = place_.find(node); place != place_.end()) found.push_back(place->second);
  std::ranges::sort(found);
  return found;
}

std::vector<Index> EquationReduction::unknowns_in(const std::vector<Index>& variables) const {
  return {std::ranges::lower_bound(variables, variable_of(0)),
          std::ranges::lower_bound(variables, variable_of(unknowns_.size()))};
}

bool EquationReduction::varies(const Expr& function) const {
  const std::vector<Index> variables = contained(function);
  return !variables.empty() && variables.front() < variable_of(unknowns_.size());
}

std::vector<std::pair<Index, Expr>> EquationReduction::slopes(const Expr& function,
                                                              const std::vector<Index>& by) const {
  const ExprVector along = gradient(function, ExprVector(variables_(by)));
  std::vector<std::pair<Index, Expr>> result;
  for (std::size_t i = 0; i < by.size(); ++i)
    result.emplace_back(by[i], along[static_cast<Index>(i)]);
  return result;
}

OpenEquation EquationReduction::opened(const Expr& function) const {
  return {.function = function, .contained = contained(function)};
}

const std::vector<std::pair<Index, Expr>>& EquationReduction::slopes_of(
    OpenEquation& equation) const {
  if (!equation.slopes) {
    equation.slopes = slopes(equation.function, unknowns_in(equation.contained));
    std::erase_if(*equation.slopes,
                  [](const auto& slope) { return slope.second.is_constant(0.0); });
  }
  return *equation.slopes;
}

void EquationReduction::weigh(OpenEquation& equation) const {
  equation.is_weighed = true;
  if (equation.function.is_constant()) return;
  if (is_too_long(equation.function)) return;
  const auto& along = slopes_of(equation);
  double largest = 0.0;
  for (const auto& slope : along) largest = std::max(largest, std::abs(value(slope.second)));
  for (const auto& [variable, slope] : along) {
    double cost = static_cast<double>(along.size());
    if (!slope.is_constant()) {
      if (vanishes(slope, largest) || has_unknown(slope)) continue;
      if (varies(slope)) cost += of_varying;
    }
    if (equation.unknown >= 0 && cost >= equation.cost) continue;
    equation.cost = cost;
    equation.unknown = variable - variable_of(0);
  }
}

bool EquationReduction::solve_one(bool by_numbers) {
  std::size_t best = equations_.size();
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    OpenEquation& equation = equations_[e];
    if (!equation.is_weighed) weigh(equation);
    if (by_numbers && equation.cost >= of_varying) continue;
    if (equation.unknown >= 0 &&
        (best == equations_.size() || equation.cost < equations_[best].cost))
      best = e;
  }
  if (best == equations_.size()) return false;
  const OpenEquation solved = equations_[best];
  has_divided_ = has_divided_ || solved.cost >= of_varying;
  equations_.erase(equations_.begin() + static_cast<std::ptrdiff_t>(best));
  const ExprVector unknown = unknowns_.segment(solved.unknown, 1);
  const Expr coefficient = gradient(solved.function, unknown)[0];
  const Expr rest = substitute(solved.function, unknown, ExprVector::Constant(1, Expr(0.0)));
  const Expr result = coefficient.is_constant(1.0)    ? -rest
                      : coefficient.is_constant(-1.0) ? rest
                                                      : -rest / coefficient;
  const ExprVector by = ExprVector::Constant(1, result);
  const auto has_it = [&](const std::vector<Index>& variables) {
    return std::ranges::binary_search(variables, variable_of(solved.unknown));
  };
  for (OpenEquation& other : equations_)
    if (has_it(other.contained)) other = opened(normal(substitute(other.function, unknown, by)));
  set_solution(solved.unknown, normal(result));
  for (Index u = 0; u < solution_.size(); ++u)
    if (const auto i = static_cast<std::size_t>(u); solved_[i] && has_it(in_solution_[i]))
      set_solution(u, normal(substitute(solution_[u], unknown, by)));
  return true;
}

void EquationReduction::set_solution(Index unknown, const Expr& function) {
  const auto u = static_cast<std::size_t>(unknown);
  solution_[unknown] = function;
  solved_[u] = true;
  in_solution_[u] = contained(function);
}

}  // namespace courant
