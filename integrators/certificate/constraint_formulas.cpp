#include "courant/integrators/certificate/constraint_formulas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "courant/core/expressions/subgraph.hpp"
#include "courant/integrators/certificate/equation_reduction.hpp"

namespace courant {
namespace {

using Kind = ConstraintFormulas::Step::Kind;

bool is_number(const std::string& text) {
  return text.find_first_not_of("0123456789.+-e") == std::string::npos;
}

// The formulas of one system, found level by level.
class Derivation {
 public:
  Derivation(const ImplicitSystem& system, const ConstraintLadder& ladder,
             std::vector<Parameter> parameters)
      : ladder_(ladder),
        elimination_(system, velocity_names(system), ladder.point, parameters),
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

  void add_constraint(Index level, const Expr& found) {
    // Where there is no index the point need not be consistent, nor a factor be other than 0 where the constraint is.
    const Expr function = ladder_.index >= 0 ? elimination_.without_factors(found) : found;
    const double value = elimination_.value(function);
    VectorXd g = elimination_.gradient_at_point(function);
    const double size = g.norm();
    // Where there is no index constraints may contradict those before, by which nothing is left of them.
    const std::string formula = elimination_.written_equation(
        function, ladder_.index >= 0 ? elimination_.known_constraints() : std::vector<Expr>());
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
        result_.steps.push_back(
            {level, kind, std::move(constraint), std::move(raw),
             kind == Kind::kept || kind == Kind::contradiction
                 ? result
                 : elimination_.written_equation(reduced, elimination_.known_constraints())});
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
  added_parameters(graph, parameters);
  const ExprVector x = variables_named(graph, system.names().coordinates);
  const ExprVector z = variables_named(graph, system.names().auxiliary);
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
  const ExprVector x = variables_named(graph, coordinates),
                   v = graph.variables("v", M.tangent_dimension());
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
