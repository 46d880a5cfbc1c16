// EquationReduction: the equations of a system, solved by hand for what is linear in them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "courant/core/algebra/normal_form.hpp"
#include "courant/core/algebra/simplified.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/core/language/symbol_table.hpp"
#include "courant/integrators/certificate/nearby_points.hpp"
#include "courant/structures/implicit_system.hpp"
#include "courant/structures/state.hpp"

namespace courant {

// Variables of these names, and parameters.
ExprVector variables_named(const Graph& graph, const std::vector<std::string>& names);
ExprVector added_parameters(const Graph& graph, const std::vector<Parameter>& parameters);

// An equation with the unknown that it can be solved for most simply, found once for what the equation is.
struct OpenEquation {
  Expr function;
  std::vector<Index> contained = {};  // variables in it, ascending
  // Its derivatives by unknowns that are not identically 0, each with its variable; found when they are asked for.
  std::optional<std::vector<std::pair<Index, Expr>>> slopes = {};
  bool is_weighed = false;
  double cost = 0.0;
  Index unknown = -1;  // none
};

// Equations on the way to their reduced form. On a manifold with as many ẋ as v = C ẋ, velocities
// are ẋ, and equations are taken modulo what points and velocities satisfy.
class EquationReduction {
 public:
  // `velocities`: their names (velocity_names). `point`: where it is looked whether a coefficient vanishes.
  EquationReduction(const ImplicitSystem& system, const std::vector<std::string>& velocities,
                    const State& point, const std::vector<Parameter>& parameters);

  bool is_too_large() const { return is_too_large_; }

  // Solves for unknowns that have numbers for coefficients, so that nothing is divided by what may vanish.
  void solve_by_numbers();
  // Whether one was solved by what may vanish since.
  bool has_divided() const { return has_divided_; }
  // The equations that are not solved, each = 0.
  std::vector<Expr> open_equations() const;
  // Solves for unknowns while it can; what is left without unknowns and is not identically zero is
  // returned, and taken off.
  std::vector<Expr> constraints();

  // dφ/dt in velocities.
  Expr derivative(const Expr& function) const;
  // With what is known of the unknowns put in.
  Expr reduced(const Expr& function) { return normal(substitute(function, unknowns_, solution_)); }
  void add(const Expr& equation);

  // What follows from the equations that are left when velocities and unknowns that occur in them in
  // another way than linearly are eliminated.
  std::vector<Expr> consequences() const;
  // Whether functions of the point have no zero in common.
  bool have_no_common_zero(const std::vector<Expr>& functions) const;

  // What is 0 if and only if the function is, around the point.
  Expr without_factors(const Expr& function) const;
  const std::vector<Expr>& known_constraints() const { return constraints_; }
  // Solutions satisfy it.
  void add_constraint(const Expr& function);

  bool has_unknown(const Expr& function) const;
  double value(const Expr& function) const;
  // In the tangent representation.
  VectorXd gradient_at_point(const Expr& function) const;

  // Texts are read again, and nothing is written that says other numbers at the point; then they are empty, as those
  // that are too long.
  std::string written(const Expr& function) const;
  // `by`: constraints that make it shorter, where they do.
  std::string written_equation(const Expr& function, const std::vector<Expr>& by = {}) const;
  // Of some unknowns (velocities first) that are functions of the point, in x and t. Their expressions are made before
  // the threads begin, in one order.
  std::vector<std::string> solutions(const std::vector<Index>& of);
  Expr solution(Index u) { return reduced(unknowns_[u]); }
  // Coordinates (N), time, velocities (Ñ), auxiliary unknowns (m): what equations are made of beside parameters.
  ExprVector variables() const { return variables_.head(variable_of(unknowns_.size())); }
  // Whether velocities are ẋ, and not the components v of the manifold.
  bool has_ambient_velocities() const { return normal_form_.has_value(); }
  const ExprVector& coordinates() const { return x_; }
  const Expr& time() const { return t_; }
  bool is_function_of_the_point(Index u);
  Index velocity_count() const { return velocity_count_; }

 private:
  // Nothing that could be written comes of it.
  static bool is_too_long(const Expr& function);
  static std::string short_enough(const std::optional<std::string>& text);

  // Where the point and the velocity are on the manifold.
  Expr normal(const Expr& function) { return normal_form_ ? (*normal_form_)(function) : function; }
  const Simplification& given(const Expr& function) const;

  // Whether a formula has this value at the point, up to the six digits that its numbers are written with.
  bool says(const std::string& text, double number) const;
  // Whether a function is 0 at points around this one at which the constraints so far hold.
  bool vanishes_nearby(const Expr& function);
  // How far a function moves when each variable does by its size, or by 1 where that is less.
  double change(const Expr& function) const;

  // At the point, next to how fast it changes there and to the other coefficients of its equation: what is
  // identically zero, though its formula does not tell, is round-off of these.
  bool vanishes(const Expr& function, double others) const;

  // Of functions of these variables; NaN where one is no number there.
  VectorXd values_at_point(const ExprVector& functions, const std::vector<Index>& of) const;

  // Variables in a function, ascending.
  std::vector<Index> contained(const Expr& function) const;
  std::vector<Index> contained(const ExprVector& functions) const;
  std::vector<Index> unknowns_in(const std::vector<Index>& variables) const;
  // With more than parameters.
  bool varies(const Expr& function) const;
  Index variable_of(Index unknown) const { return x_.size() + 1 + unknown; }
  // Derivatives by some variables, each with its variable.
  std::vector<std::pair<Index, Expr>> slopes(const Expr& function,
                                             const std::vector<Index>& by) const;

  OpenEquation opened(const Expr& function) const;
  const std::vector<std::pair<Index, Expr>>& slopes_of(OpenEquation& equation) const;
  // Chooses the unknown in which an equation is linear, if there is one: constant coefficients first.
  void weigh(OpenEquation& equation) const;
  // Solves the equation with fewest unknowns for one that is linear in it; `by_numbers`: with a number for its
  // coefficient. False if there is none. Only equations that contain that unknown change.
  bool solve_one(bool by_numbers = false);
  void set_solution(Index unknown, const Expr& function);

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
  std::optional<NearbyPoints> nearby_;  // at which they hold
  std::vector<bool> solved_;
  std::vector<std::vector<Index>> in_solution_;  // variables in those that are solved
  std::vector<OpenEquation> equations_;
  bool is_too_large_ = false, has_divided_ = false;
};

}  // namespace courant
