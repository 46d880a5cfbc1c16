#include "courant/integrators/certificate/constraint_formulas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "courant/core/algebra/normal_form.hpp"
#include "courant/core/algebra/simplified.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/subgraph.hpp"
#include "courant/core/language/declaration.hpp"
#include "courant/core/language/formula.hpp"
#include "courant/core/numbers/parallel.hpp"

namespace courant {
namespace {

constexpr std::size_t longest = 450;  // characters of a formula: five lines
constexpr std::size_t most_operations = 20000, most_operations_of_one = 1000;

using Kind = ConstraintFormulas::Step::Kind;

ExprVector named(const Graph& graph, const std::vector<std::string>& names) {
  ExprVector result(static_cast<Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i)
    result[static_cast<Index>(i)] = graph.variable(names[i]);
  return result;
}

ExprVector added(const Graph& graph, const std::vector<Parameter>& parameters) {
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  return add_parameters(graph, names);
}

// A table in which formulas of these names can be read: x, r[2][1], x', with an array of each r. Elements that nobody
// names are 0. Empty where one of them is no name of the language.
std::optional<SymbolTable> readable(const std::vector<std::string>& names,
                                    const ExprVector& values) {
  struct Array {
    Shape shape;
    std::vector<std::pair<std::vector<Index>, Expr>> elements = {};
  };
  std::map<std::pair<std::string, bool>, Array> arrays;  // by name, and whether it is a velocity
  try {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Reference reference = parse_reference(names[i]);
      Array& array = arrays[{reference.name, reference.is_velocity}];
      array.shape.resize(std::max(array.shape.size(), reference.indices.size()), 0);
      for (std::size_t k = 0; k < reference.indices.size(); ++k)
        array.shape[k] = std::max(array.shape[k], reference.indices[k] + 1);
      array.elements.emplace_back(reference.indices, values[static_cast<Index>(i)]);
    }
    SymbolTable symbols;
    for (const auto& [name, array] : arrays) {
      ExprVector entries = ExprVector::Constant(element_count(array.shape), Expr(0.0));
      for (const auto& [indices, value] : array.elements) {
        Index place = 0;
        for (std::size_t k = 0; k < indices.size(); ++k)
          place = place * array.shape[k] + indices[k];
        entries[place] = value;
      }
      if (name.second)
        symbols.add_velocity(name.first, array.shape, entries);
      else
        symbols.add(name.first, array.shape, entries);
    }
    return symbols;
  } catch (const FormulaError&) {
    return std::nullopt;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

bool is_number(const std::string& text) {
  return text.find_first_not_of("0123456789.+-e") == std::string::npos;
}

// An equation with the unknown that it can be solved for most simply, found once for what the equation is.
struct OpenEquation {
  Expr function;
  std::vector<Index> contained = {};  // variables in it, ascending
  bool is_weighed = false;
  double cost = 0.0;
  Index unknown = -1;  // none
};

// Equations on the way to their reduced form. On a manifold with as many ẋ as v = C ẋ, velocities
// are ẋ, and equations are taken modulo what points and velocities satisfy.
class EquationReduction {
 public:
  EquationReduction(const ImplicitSystem& system, const State& point,
                    const std::vector<Parameter>& parameters)
      : parameters_(added(graph_, parameters)),
        x_(named(graph_, system.names().coordinates)),
        t_(graph_.variable("t")) {
    const Manifold& M = *system.manifold();
    const ExprVector rates = named(graph_, velocity_names(system));
    const ExprVector z = named(graph_, system.names().auxiliary);
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
    for (const auto& more : {velocity_names(system), system.names().auxiliary})
      names.insert(names.end(), more.begin(), more.end());
    for (const Parameter& parameter : parameters) names.push_back(parameter.name);
    variables_.resize(numbers_.size());
    variables_ << x_, t_, unknowns_, parameters_;
    for (Index i = 0; i < variables_.size(); ++i) place_[variables_[i].node()] = i;
    symbols_ = readable(names, variables_);
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

  bool is_too_large() const { return is_too_large_; }

  // Solves for unknowns while it can; what is left without unknowns and is not identically zero is
  // returned, and taken off.
  std::vector<Expr> constraints() {
    while (solve_one()) {
    }
    std::vector<Expr> found;
    std::vector<OpenEquation> kept;
    for (OpenEquation& equation : equations_) {
      if (equation.function.is_constant(0.0)) continue;
      if (has_unknown(equation.function))
        kept.push_back(std::move(equation));
      else
        found.push_back(equation.function);
    }
    equations_ = std::move(kept);
    return found;
  }

  // dφ/dt in velocities.
  Expr derivative(const Expr& function) const {
    ExprVector at(x_.size() + 1), rate(x_.size() + 1);
    at << x_, t_;
    rate << motion_, Expr(1.0);
    return tangent(ExprVector::Constant(1, function), at, rate)[0];
  }
  // With what is known of the unknowns put in.
  Expr reduced(const Expr& function) { return normal(substitute(function, unknowns_, solution_)); }
  void add(const Expr& equation) {
    if (const Expr remainder = normal(equation); !is_zero(remainder))
      equations_.push_back(opened(remainder));
  }

  // What follows from the equations that are left when velocities and unknowns that occur in them in
  // another way than linearly are eliminated.
  std::vector<Expr> consequences() const {
    std::vector<Expr> left;
    for (const OpenEquation& equation : equations_)
      if (has_unknown(equation.function)) left.push_back(equation.function);
    const Index count = variable_of(unknowns_.size());
    return NormalForm(variables_.head(count), {}).consequences(left, unknowns_);
  }
  // Whether functions of the point have no zero in common.
  bool have_no_common_zero(const std::vector<Expr>& functions) const {
    return NormalForm(x_, functions).hold_nowhere();
  }

  // Solutions satisfy it.
  void add_constraint(const Expr& function) { constraints_.push_back(function); }

  bool has_unknown(const Expr& function) const {
    const auto along = slopes(function, unknowns_in(contained(function)));
    return std::ranges::any_of(along,
                               [](const auto& slope) { return !slope.second.is_constant(0.0); });
  }
  double value(const Expr& function) const {
    return values_at_point(ExprVector::Constant(1, function), contained(function))[0];
  }
  // In the tangent representation.
  VectorXd gradient_at_point(const Expr& function) const {
    const ExprVector v = unknowns_.head(velocity_count_);
    const ExprVector along = gradient(derivative(function), v);
    return values_at_point(along, contained(along));
  }

  // Texts are read again, and nothing is written that says other numbers at the point; then they are empty, as those
  // that are too long.
  std::string written(const Expr& function) const {
    if (is_too_long(function)) return "";
    const std::string text = short_enough(simplified(function, given(function)));
    return says(text, value(function)) ? text : "";
  }
  std::string written_equation(const Expr& function) const {
    if (is_too_long(function)) return "";
    const std::string text = short_enough(simplified_equation(function, given(function)));
    if (text.empty()) return "";
    const bool holds = std::abs(value(function)) <= 1e-8 * change(function);
    return !holds || says(text, 0.0) ? text : "";
  }
  // Of some unknowns (velocities first) that are functions of the point, in x and t. Their expressions are made before
  // the threads begin, in one order.
  std::vector<std::string> solutions(const std::vector<Index>& of) {
    const Simplification on_solutions{on_points_.relations, constraints_};
    std::vector<Expr> functions;
    for (const Index u : of) functions.push_back(reduced(unknowns_[u]));
    std::vector<std::string> texts(of.size());
    in_parallel(of.size(), core_count(), [&](std::size_t i) {
      if (!is_too_long(functions[i]))
        texts[i] = short_enough(simplified(functions[i], on_solutions));
    });
    for (std::size_t i = 0; i < texts.size(); ++i)
      if (!says(texts[i], value(functions[i]))) texts[i].clear();
    return texts;
  }
  Expr solution(Index u) { return reduced(unknowns_[u]); }
  const ExprVector& coordinates() const { return x_; }
  const Expr& time() const { return t_; }
  bool is_function_of_the_point(Index u) {
    return solved_[static_cast<std::size_t>(u)] && !has_unknown(reduced(unknowns_[u]));
  }
  Index velocity_count() const { return velocity_count_; }

 private:
  // Nothing that could be written comes of it.
  static bool is_too_long(const Expr& function) {
    return Subgraph(ExprVector::Constant(1, function)).size() > most_operations_of_one;
  }
  static std::string short_enough(const std::optional<std::string>& text) {
    return text && text->size() <= longest ? *text : "";
  }
  bool is_zero(const Expr& function) const {
    return function.is_constant(0.0) ||
           (!has_unknown(function) && simplified(function, on_points_) == "0");
  }

  // Where the point and the velocity are on the manifold.
  Expr normal(const Expr& function) { return normal_form_ ? (*normal_form_)(function) : function; }
  const Simplification& given(const Expr& function) const {
    return has_unknown(function) ? on_vectors_ : on_points_;
  }

  // Whether a formula has this value at the point, up to the six digits that its numbers are written with.
  bool says(const std::string& text, double number) const {
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
  // How far a function moves when each variable does by its size, or by 1 where that is less.
  double change(const Expr& function) const {
    const std::vector<Index> of = contained(function);
    const ExprVector along = gradient(function, ExprVector(variables_(of)));
    return values_at_point(along, of).cwiseAbs().dot(numbers_(of).cwiseAbs().cwiseMax(1.0));
  }

  // At the point, next to how fast it changes there and to the other coefficients of its equation: what is
  // identically zero, though its formula does not tell, is round-off of these.
  bool vanishes(const Expr& function, double others) const {
    const double least = others > 1e-6 ? 1e-10 * others : 1e-6;
    if (!(std::abs(value(function)) > least)) return true;
    return !(std::abs(value(function)) > 1e-6 * change(function));
  }

  // Of functions of these variables; NaN where one is no number there.
  VectorXd values_at_point(const ExprVector& functions, const std::vector<Index>& of) const {
    const VectorXd there = numbers_(of);
    return substitute(functions, ExprVector(variables_(of)), constants(there))
        .unaryExpr([](const Expr& a) { return a.is_constant() ? a.value() : std::nan(""); });
  }

  // Variables in a function, ascending.
  std::vector<Index> contained(const Expr& function) const {
    return contained(ExprVector::Constant(1, function));
  }
  std::vector<Index> contained(const ExprVector& functions) const {
    std::vector<Index> found;
    const Subgraph subgraph(functions);
    for (const std::uint32_t node : subgraph.nodes())
      if (const auto place = place_.find(node); place != place_.end())
        found.push_back(place->second);
    std::ranges::sort(found);
    return found;
  }
  std::vector<Index> unknowns_in(const std::vector<Index>& variables) const {
    return {std::ranges::lower_bound(variables, variable_of(0)),
            std::ranges::lower_bound(variables, variable_of(unknowns_.size()))};
  }
  // With more than parameters.
  bool varies(const Expr& function) const {
    const std::vector<Index> variables = contained(function);
    return !variables.empty() && variables.front() < variable_of(unknowns_.size());
  }
  Index variable_of(Index unknown) const { return x_.size() + 1 + unknown; }
  // Derivatives by some variables, each with its variable.
  std::vector<std::pair<Index, Expr>> slopes(const Expr& function,
                                             const std::vector<Index>& by) const {
    const ExprVector along = gradient(function, ExprVector(variables_(by)));
    std::vector<std::pair<Index, Expr>> result;
    for (std::size_t i = 0; i < by.size(); ++i)
      result.emplace_back(by[i], along[static_cast<Index>(i)]);
    return result;
  }

  OpenEquation opened(const Expr& function) const {
    return {.function = function, .contained = contained(function)};
  }
  // Chooses the unknown in which an equation is linear, if there is one: constant coefficients first.
  void weigh(OpenEquation& equation) const {
    constexpr double of_varying = 1000.0;
    equation.is_weighed = true;
    if (equation.function.is_constant()) return;
    if (is_too_long(equation.function)) return;
    auto along = slopes(equation.function, unknowns_in(equation.contained));
    std::erase_if(along, [](const auto& slope) { return slope.second.is_constant(0.0); });
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
  // Solves the equation with fewest unknowns for one that is linear in it. False if there is none. Only equations that
  // contain that unknown change.
  bool solve_one() {
    std::size_t best = equations_.size();
    for (std::size_t e = 0; e < equations_.size(); ++e) {
      OpenEquation& equation = equations_[e];
      if (!equation.is_weighed) weigh(equation);
      if (equation.unknown >= 0 &&
          (best == equations_.size() || equation.cost < equations_[best].cost))
        best = e;
    }
    if (best == equations_.size()) return false;
    const OpenEquation solved = equations_[best];
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
  void set_solution(Index unknown, const Expr& function) {
    const auto u = static_cast<std::size_t>(unknown);
    solution_[unknown] = function;
    solved_[u] = true;
    in_solution_[u] = contained(function);
  }

  Graph graph_;
  ExprVector parameters_, x_;
  Expr t_;
  Index velocity_count_ = 0;
  ExprVector unknowns_, solution_;                  // velocities, then auxiliary unknowns
  ExprVector motion_;                               // ẋ
  ExprVector variables_;                            // x, t, the unknowns and the parameters
  std::unordered_map<std::uint32_t, Index> place_;  // of a variable's node in variables_
  VectorXd numbers_;                                // of the variables, at the point
  std::optional<SymbolTable> symbols_;              // of the variables
  Simplification on_points_, on_vectors_;
  std::optional<NormalForm> normal_form_;
  std::vector<Expr> constraints_;
  std::vector<bool> solved_;
  std::vector<std::vector<Index>> in_solution_;  // variables in those that are solved
  std::vector<OpenEquation> equations_;
  bool is_too_large_ = false;
};

// The formulas of one system, found level by level.
class Derivation {
 public:
  Derivation(const ImplicitSystem& system, const ConstraintLadder& ladder,
             std::vector<Parameter> parameters)
      : ladder_(ladder),
        elimination_(system, ladder.point, parameters),
        known_(system.manifold()->tangent_dimension(), 0),
        is_told_(static_cast<std::size_t>(elimination_.velocity_count()), false) {
    result_.parameters = std::move(parameters);
  }

  ConstraintFormulas operator()(Index levels) {
    if (elimination_.is_too_large()) return {};
    for (Index level = 0; level <= levels; ++level) {
      found_.clear();
      for (const Expr& function : elimination_.constraints()) add_constraint(level, function);
      if (std::ssize(found_) < constraint_count(level))
        for (const Expr& function : elimination_.consequences()) add_constraint(level, function);
      add_velocities(level);
      if (contradicted_) break;
      for (const Expr& function : found_) differentiate(level + 1, function, level < levels);
      if (contradicted_) break;
    }
    if (ladder_.index >= 0) {
      elimination_.constraints();
      simplify_first_velocities();
    }
    std::vector<Index> determined;
    for (std::size_t j = 0; j < ladder_.determined.size(); ++j) {
      const Index u = elimination_.velocity_count() + static_cast<Index>(j);
      if (ladder_.determined[j] && elimination_.is_function_of_the_point(u))
        determined.push_back(u);
    }
    const std::vector<std::string> formulas = elimination_.solutions(determined);
    for (std::size_t i = 0; i < formulas.size(); ++i)
      if (!formulas[i].empty())
        told(ConstraintFormulas::Value{determined[i] - elimination_.velocity_count(), formulas[i]},
             elimination_.solution(determined[i]));
    result_.coordinates = elimination_.coordinates();
    result_.time = elimination_.time();
    return result_;
  }

 private:
  // By ranks.
  Index constraint_count(Index level) const {
    return std::ranges::count(ladder_.constraints, level, &PointConstraint::level);
  }

  void told(ConstraintFormulas::Constraint constraint, const Expr& function) {
    result_.constraints.push_back(std::move(constraint));
    result_.constraint_functions.push_back(function);
  }
  void told(ConstraintFormulas::Value value, const Expr& function) {
    result_.values.push_back(std::move(value));
    result_.value_functions.push_back(function);
  }

  void add_constraint(Index level, const Expr& function) {
    const double value = elimination_.value(function);
    VectorXd g = elimination_.gradient_at_point(function);
    const double size = g.norm();
    const std::string formula = elimination_.written_equation(function);
    if (is_number(formula) && !formula.empty()) {
      if (ladder_.index >= 0 || formula == "0") return;
      result_.steps.push_back({level, Kind::contradiction, "", "", elimination_.written(function)});
      contradicted_ = true;
      return;
    }
    if (!(size > 0.0)) {
      if (ladder_.verdict == Verdict::rank_change && std::abs(value) < 1e-8 && !formula.empty())
        told(ConstraintFormulas::Constraint{level, formula, true}, function);
      return;
    }
    // Where there is no consistent point, constraints need not hold at the one that was found.
    const bool holds = std::abs(value) < 1e-8 * size * (1.0 + ladder_.point.x.norm());
    if (!holds && ladder_.verdict != Verdict::inconsistent) return;
    if (ladder_.verdict == Verdict::inconsistent && !formula.empty()) {
      all_.push_back(function);
      if (elimination_.have_no_common_zero(all_)) {
        told(ConstraintFormulas::Constraint{level, formula}, function);
        result_.steps.push_back({level, Kind::contradiction, formula, "", "1"});
        contradicted_ = true;
        return;
      }
    }
    g -= known_ * (known_.transpose() * g);
    if (g.norm() < 1e-8 * size) return;  // follows from those before
    known_.conservativeResize(Eigen::NoChange, known_.cols() + 1);
    known_.rightCols(1) = g.normalized();
    if (!formula.empty()) told(ConstraintFormulas::Constraint{level, formula}, function);
    found_.push_back(function);
    elimination_.add_constraint(function);
  }

  void differentiate(Index level, const Expr& function, bool goes_on) {
    const Expr derivative = elimination_.derivative(function);
    const Expr reduced = elimination_.reduced(derivative);
    const std::string result = elimination_.written(reduced);
    Kind kind = elimination_.has_unknown(reduced) ? Kind::condition : Kind::constraint;
    if (result == "0")
      kind = Kind::kept;
    else if (is_number(result) && !result.empty())
      kind = Kind::contradiction;
    if (kind == Kind::contradiction && ladder_.index >= 0) return;  // the numbers know better
    if (goes_on) {
      std::string constraint = elimination_.written_equation(function);
      std::string raw = elimination_.written_equation(derivative);
      if (!constraint.empty() && !raw.empty() && !result.empty())
        result_.steps.push_back({level, kind, std::move(constraint), std::move(raw),
                                 kind == Kind::kept || kind == Kind::contradiction
                                     ? result
                                     : elimination_.written_equation(reduced)});
    }
    contradicted_ = contradicted_ || kind == Kind::contradiction;
    if (kind != Kind::kept) elimination_.add(reduced);
  }

  // Those that are functions of the point from this level on.
  void add_velocities(Index level) {
    std::vector<Index> told;
    for (Index u = 0; u < elimination_.velocity_count(); ++u) {
      const auto i = static_cast<std::size_t>(u);
      if (is_told_[i] || !elimination_.is_function_of_the_point(u)) continue;
      is_told_[i] = true;
      told.push_back(u);
    }
    const std::vector<std::string> formulas = elimination_.solutions(told);
    for (std::size_t i = 0; i < formulas.size(); ++i)
      if (!formulas[i].empty()) result_.velocities.push_back({told[i], level, formulas[i]});
  }

  // What S_0 says of velocities, by the constraints of all levels.
  void simplify_first_velocities() {
    const bool has_later = std::ranges::any_of(
        result_.constraints,
        [](const ConstraintFormulas::Constraint& one) { return one.level > 0; });
    if (!has_later) return;
    std::vector<Index> told;
    for (const ConstraintFormulas::Velocity& velocity : result_.velocities)
      if (velocity.level == 0) told.push_back(velocity.component);
    const std::vector<std::string> formulas = elimination_.solutions(told);
    for (std::size_t i = 0, k = 0; i < result_.velocities.size(); ++i) {
      ConstraintFormulas::Velocity& velocity = result_.velocities[i];
      if (velocity.level != 0) continue;
      if (formulas[k] != velocity.formula) velocity.on_M_f = formulas[k];
      ++k;
    }
  }

  const ConstraintLadder& ladder_;
  EquationReduction elimination_;
  MatrixXd known_;           // orthonormal: the gradients so far
  std::vector<Expr> found_;  // constraints of this level
  std::vector<Expr> all_;    // of all levels, where they contradict each other
  std::vector<bool> is_told_;
  bool contradicted_ = false;
  ConstraintFormulas result_;
};

// Those of the parameters that the equations have in them; nothing where equations need one of them as an integer, as the bound
// of a sum.
std::optional<std::vector<Parameter>> contained_in(const ImplicitSystem& system,
                                                   const std::vector<Parameter>& parameters) {
  const Graph graph;
  added(graph, parameters);
  const ExprVector x = named(graph, system.names().coordinates);
  const ExprVector z = named(graph, system.names().auxiliary);
  const ExprVector v = graph.variables("v", system.manifold()->tangent_dimension());
  try {
    const Subgraph of_equations(system.residual(x, v, z, graph.variable("t")));
    std::vector<bool> is_there(parameters.size(), false);
    for (const std::uint32_t node : of_equations.nodes())
      if (node < is_there.size()) is_there[node] = true;  // parameters are the first nodes
    std::vector<Parameter> found;
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (is_there[i]) found.push_back(parameters[i]);
    return found;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

// The parameters that may stand in formulas by name. 0 is a number, and so are those that are needed as integers; all are
// where there are too many.
std::vector<Parameter> that_may_be_named(const ImplicitSystem& system,
                                         std::vector<Parameter> parameters) {
  constexpr std::size_t most_looked_at = 200, most_named = 50;
  std::erase_if(parameters, [](const Parameter& parameter) {
    return parameter.value == 0.0 || !std::isfinite(parameter.value);
  });
  if (parameters.size() > most_looked_at) return {};
  auto found = contained_in(system, parameters);
  if (!found) {
    std::erase_if(parameters, [&](const Parameter& parameter) {
      return parameter.value == std::floor(parameter.value) && !contained_in(system, {parameter});
    });
    found = contained_in(system, parameters);
  }
  return found && found->size() <= most_named ? *found : std::vector<Parameter>();
}

// Whether there is nothing that formulas could say and do not.
bool is_whole(const ConstraintFormulas& formulas, const ConstraintLadder& ladder) {
  return ladder.index >= 0 && formulas.constraints.size() == ladder.constraints.size() &&
         std::ssize(formulas.values) == std::ranges::count(ladder.determined, true) &&
         std::ssize(formulas.velocities) == std::ranges::count(ladder.determined_velocities, true);
}

// What tells which of two derivations of one system found more: contradictions, constraints, then the rest.
std::array<std::size_t, 4> findings(const ConstraintFormulas& found) {
  const auto contradictions = static_cast<std::size_t>(
      std::ranges::count(found.steps, Kind::contradiction, &ConstraintFormulas::Step::kind));
  return {contradictions, found.constraints.size(), found.values.size() + found.velocities.size(),
          found.steps.size()};
}

}  // namespace

std::string to_string(ConstraintFormulas::Step::Kind kind) {
  switch (kind) {
    case Kind::constraint:
      return "constraint";
    case Kind::condition:
      return "condition";
    case Kind::kept:
      return "kept";
    case Kind::contradiction:
      return "contradiction";
  }
  return "";
}

std::vector<std::string> velocity_names(const ImplicitSystem& system) {
  const Manifold& M = *system.manifold();
  const auto& coordinates = system.names().coordinates;
  const auto size = static_cast<std::size_t>(M.tangent_dimension());
  std::vector<std::string> names;
  if (size == coordinates.size()) {
    for (const std::string& name : coordinates) names.push_back(name + "'");
    return names;
  }
  // On a cotangent bundle the fibre has as many components as the velocity of the base.
  // Components that are those of the velocity of a coordinate.
  Graph graph;
  const ExprVector x = named(graph, coordinates), v = graph.variables("v", M.tangent_dimension());
  const ExprVector motion = M.frame(x) * v;
  names.resize(size);
  std::vector<std::string> others;  // arrays of coordinates whose velocities are no components
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    const auto component =
        std::ranges::find_if(v, [&](const Expr& c) { return c.node() == motion[Index(i)].node(); });
    if (component != v.end()) {
      names[static_cast<std::size_t>(component - v.begin())] = coordinates[i] + "'";
    } else if (const std::string array = coordinates[i].substr(0, coordinates[i].find('['));
               others.empty() || others.back() != array) {
      others.push_back(array);
    }
  }
  // They are called after their momenta, or three in a row after each of these arrays, as of rotations and
  // points that turn with them.
  std::vector<std::string> called;
  for (const std::string& name : coordinates)
    if (name.starts_with("p_")) called.push_back("v_" + name.substr(2));
  const auto unnamed = static_cast<std::size_t>(std::ranges::count(names, std::string()));
  if (called.size() != unnamed) {
    called.clear();
    for (std::size_t i = 0; i < unnamed; ++i)
      called.push_back(unnamed == 3 * others.size()
                           ? "v_" + others[i / 3] + "[" + std::to_string(i % 3) + "]"
                           : "v[" + std::to_string(i) + "]");
  }
  std::size_t next = 0;
  for (std::string& name : names)
    if (name.empty()) name = called[next++];
  return names;
}

ConstraintFormulas constraint_formulas(const ImplicitSystem& system, const ConstraintLadder& ladder,
                                       std::vector<Parameter> parameters) {
  const bool is_empty =
      (ladder.verdict == Verdict::inconsistent || ladder.verdict == Verdict::rank_change) &&
      !ladder.levels.empty();
  const Manifold& M = *system.manifold();
  if ((ladder.index < 0 && !is_empty) || ladder.point.x.size() != M.ambient_dimension() ||
      ladder.point.v.size() != M.tangent_dimension() ||
      ladder.point.z.size() != system.auxiliary_size() ||
      M.tangent_dimension() + system.auxiliary_size() > 200)
    return {};
  const Index levels = is_empty ? ladder.levels.back().k : ladder.index;
  parameters = that_may_be_named(system, std::move(parameters));
  const bool has_names = !parameters.empty();
  ConstraintFormulas found = Derivation(system, ladder, std::move(parameters))(levels);
  if (!has_names || is_whole(found, ladder)) return found;
  ConstraintFormulas in_numbers = Derivation(system, ladder, {})(levels);
  return findings(in_numbers) > findings(found) ? in_numbers : found;
}

}  // namespace courant
