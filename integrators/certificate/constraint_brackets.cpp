#include "courant/integrators/certificate/constraint_brackets.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "courant/core/algebra/simplified.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/core/words/message.hpp"
#include "courant/integrators/certificate/nearby_points.hpp"
#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/dirac_system.hpp"

namespace courant {
namespace {

constexpr std::size_t longest_bracket = 450, longest_value = 60, most_constraints = 24;
constexpr Index most_coordinates = 16;

ExprVector variables(const Graph& graph, const std::string& name, Index count) {
  ExprVector result(count);
  for (Index i = 0; i < count; ++i) result[i] = graph.variable(name + std::to_string(i));
  return result;
}

// The number that an expression of nothing but parameters is; 0 for another one, and for what is round-off of 1 or more.
double number_of(const Expr& a, const std::vector<Parameter>& parameters) {
  if (a.is_constant()) return a.value();
  ExprVector names(std::ssize(parameters));
  VectorXd numbers(names.size());
  for (Index i = 0; i < names.size(); ++i) {
    const Parameter& parameter = parameters[static_cast<std::size_t>(i)];
    names[i] = parameter_of(a.graph(), parameter.name, Expr(parameter.value));
    numbers[i] = parameter.value;
  }
  const Expr number = substitute(a, names, constants(numbers));
  return number.is_constant() && std::abs(number.value()) > 1e-12 ? number.value() : 0.0;
}

// A⁻¹ B by elimination with pivots that are made of numbers and parameters; nothing where one is missing.
std::optional<ExprMatrix> quotient(ExprMatrix A, ExprMatrix B,
                                   const std::vector<Parameter>& parameters) {
  const Index n = A.rows();
  for (Index k = 0; k < n; ++k) {
    Index pivot = -1;
    double largest = 0.0;
    for (Index i = k; i < n; ++i)
      if (const double size = std::abs(number_of(A(i, k), parameters)); size > largest) {
        largest = size;
        pivot = i;
      }
    if (pivot < 0) return std::nullopt;
    A.row(k).swap(A.row(pivot));
    B.row(k).swap(B.row(pivot));
    const Expr inverse = 1.0 / A(k, k);
    A.row(k) *= inverse;
    B.row(k) *= inverse;
    for (Index i = 0; i < n; ++i) {
      if (i == k || A(i, k).is_constant(0.0)) continue;
      const Expr factor = A(i, k);
      for (Index j = k; j < n; ++j) A(i, j) -= factor * A(k, j);
      for (Index j = 0; j < B.cols(); ++j) B(i, j) -= factor * B(k, j);
    }
  }
  return B;
}

// Λ of F v + E α = 0, v = Λ α, at the coordinates x.
std::optional<ExprMatrix> bivector(const DiracStructure& structure, const ExprVector& x,
                                   const Graph& graph, const std::vector<Parameter>& parameters) {
  const Index n = structure.manifold()->tangent_dimension();
  if (structure.port_size() > 0 || structure.equation_count() != n) return std::nullopt;
  const ExprVector v = variables(graph, "v of bracket ", n),
                   alpha = variables(graph, "covector of bracket ", n);
  const ExprVector membership = structure.membership(x, v, alpha, ExprVector());
  const ExprMatrix F = jacobian(membership, v).dense(), E = jacobian(membership, alpha).dense();
  auto solved = quotient(F, E, parameters);
  if (solved) *solved = -*solved;
  return solved;
}

class Brackets {
 public:
  Brackets(const ImplicitSystem& system, const ConstraintFormulas& formulas, const State& point,
           ExprMatrix bivector)
      : system_(system),
        formulas_(formulas),
        point_(point),
        bivector_(std::move(bivector)),
        x_(formulas.coordinates) {
    const Manifold& M = *system.manifold();
    const ExprVector of_manifold = M.constraint(x_);
    on_M_f_.relations.assign(of_manifold.begin(), of_manifold.end());
    frame_ = M.frame(x_);
    on_manifold_ = on_M_f_;
    on_M_f_.constraints = formulas.constraint_functions;
    std::vector<Expr> all = on_manifold_.relations;
    all.insert(all.end(), formulas.constraint_functions.begin(),
               formulas.constraint_functions.end());
    ExprVector variables(x_.size() + 1), parameters(std::ssize(formulas.parameters));
    variables << x_, formulas.time;
    VectorXd at(variables.size()), of_parameters(parameters.size());
    at << point.x, point.t;
    for (Index i = 0; i < parameters.size(); ++i) {
      const Parameter& parameter = formulas.parameters[static_cast<std::size_t>(i)];
      parameters[i] = parameter_of(x_[0].graph(), parameter.name, Expr(parameter.value));
      of_parameters[i] = parameter.value;
    }
    nearby_.emplace(variables, at, 1, parameters, of_parameters, all);
    // Equations are written divided by what is common to their terms; brackets need the function itself.
    for (Expr function : formulas.constraint_functions) {
      if (written(function, on_manifold_).value_or("").starts_with('-')) function = -function;
      names_.push_back(written(function, on_manifold_).value_or(""));
      functions_.push_back(function);
      differentials_.push_back(differential(function));
      fields_.push_back(bivector_ * differentials_.back());
    }
  }

  ConstraintBrackets operator()() {
    ConstraintBrackets result;
    const auto count = std::ssize(formulas_.constraints);
    const ConstraintBrackets too_long{.missing = "they are longer than five lines"};
    ExprMatrix C = ExprMatrix::Zero(count, count);
    for (Index a = 0; a < count; ++a) {
      if (names_[at(a)].empty()) return too_long;
      result.constraints.push_back(names_[at(a)]);
      result.matrix.emplace_back();
      for (Index b = 0; b < count; ++b) {
        const Expr bracket = on_M_f(bracket_of(at(a), at(b)));
        const auto text = written(bracket);
        if (text != "0") C(a, b) = bracket;
        result.matrix.back().push_back(
            {text.value_or(number_text(value(bracket), 6)), !text.has_value()});
      }
      result.is_first_class.push_back(vanishes(C.row(a)));
    }
    write_hamiltonian(result);
    const Classes classes = divided(C);
    for (const ExprVector& combination : classes.first)
      if (auto found = generator(combination)) result.generators.push_back(std::move(*found));
    result.dirac_brackets = dirac_brackets(C, classes.second);
    for (const Index a : classes.second) result.second_class.push_back(at(a));
    return result;
  }

 private:
  ExprVector differential(const Expr& f) const { return frame_.transpose() * gradient(f, x_); }
  static std::size_t at(Index a) { return static_cast<std::size_t>(a); }
  Expr bracket_of(std::size_t a, std::size_t b) const {
    return a == b ? Expr(0.0) : differentials_[a].dot(fields_[b]);
  }
  // 0 for what is 0 on M_f.
  Expr on_M_f(const Expr& f) const { return nearby_->vanishes(f) ? Expr(0.0) : f; }
  static bool vanishes(const ExprMatrix& entries) {
    return std::ranges::all_of(entries.reshaped(),
                               [](const Expr& entry) { return entry.is_constant(0.0); });
  }

  struct Classes {
    std::vector<ExprVector> first;  // Σ c_a φ_a that have bracket 0 with all, by their c
    std::vector<Index> second;      // of φ_a, as many as the rank of their matrix
  };
  // The classes by elimination of pairs: with d = {φ_a, φ_b}, all other φ_c become φ_c - φ_a {φ_c, φ_b}/d + φ_b {φ_c, φ_a}/d, which has
  // bracket 0 with both. Constant d come first, then the largest. What is left is first class where all of its
  // brackets are 0.
  Classes divided(ExprMatrix C) const {
    const Index count = C.rows();
    ExprMatrix combinations = ExprMatrix::Identity(count, count);
    Classes found;
    std::vector<bool> is_done(at(count), false);
    while (true) {
      Index a = -1, b = -1;
      std::pair<bool, double> best{false, 0.0};
      for (Index i = 0; i < count; ++i)
        for (Index j = 0; j < i; ++j) {
          if (is_done[at(i)] || is_done[at(j)] || C(i, j).is_constant(0.0)) continue;
          const bool is_constant = number_of(C(i, j), formulas_.parameters) != 0.0;
          const std::pair<bool, double> size{is_constant, std::abs(value(C(i, j)))};
          if (size <= best) continue;
          best = size;
          a = j;
          b = i;
        }
      if (a < 0) break;
      const Expr d = C(a, b);
      found.second.insert(found.second.end(), {a, b});
      is_done[at(a)] = is_done[at(b)] = true;
      for (Index c = 0; c < count; ++c) {
        if (is_done[at(c)]) continue;
        const Expr of_a = -C(c, b) / d, of_b = C(c, a) / d;
        if (of_a.is_constant(0.0) && of_b.is_constant(0.0)) continue;
        combinations.row(c) += of_a * combinations.row(a) + of_b * combinations.row(b);
        for (Index e = 0; e < count; ++e)
          if (!is_done[at(e)]) C(c, e) = on_M_f(C(c, e) + of_a * C(a, e) + of_b * C(b, e));
        C(c, a) = C(c, b) = 0.0;
        C.col(c) = -C.row(c).transpose();
      }
    }
    std::ranges::sort(found.second);
    for (Index c = 0; c < count; ++c)
      if (!is_done[at(c)] && vanishes(C.row(c))) found.first.emplace_back(combinations.row(c));
    return found;
  }
  double value(const Expr& f) const {
    ExprVector variables(x_.size() + 1);
    variables << x_, formulas_.time;
    VectorXd numbers(variables.size());
    numbers << point_.x, point_.t;
    const Expr there = substitute(f, variables, constants(numbers));
    return there.is_constant() ? there.value() : number_of(there, formulas_.parameters);
  }
  static std::optional<std::string> written(const Expr& f, const Simplification& given) {
    auto text = simplified(f, given);
    if (text && text->size() > longest_bracket) text.reset();
    return text;
  }
  std::optional<std::string> written(const Expr& f) const { return written(f, on_M_f_); }

  void write_hamiltonian(ConstraintBrackets& result) const {
    const auto* dirac = dynamic_cast<const DiracSystem*>(&system_);
    if (!dirac) return;
    const GeneratingFamily& family = *dirac->family();
    const Graph graph = x_[0].graph();
    const auto& names = system_.names().auxiliary;
    ExprVector lambda(family.parameter_size());
    for (Index i = 0; i < lambda.size(); ++i)
      lambda[i] = graph.variable(names[static_cast<std::size_t>(i)]);
    const ExprVector unknowns = lambda;
    // Those in which the energy is not linear; the others may stay, with what they multiply.
    const ExprVector slopes = gradient(family.value(x_, unknowns, formulas_.time), unknowns);
    const std::vector<Index> curved = jacobian(slopes, unknowns).row;
    for (std::size_t i = 0; i < formulas_.values.size(); ++i) {
      const auto& [unknown, formula] = formulas_.values[i];
      if (unknown < lambda.size() &&
          (formula.size() <= longest_value || std::ranges::count(curved, unknown) > 0))
        lambda[unknown] = formulas_.value_functions[i];
    }
    const Expr whole = family.value(x_, lambda, formulas_.time);
    ExprVector without = lambda;
    std::vector<Index> multipliers;
    for (Index i = 0; i < lambda.size(); ++i)
      if (!lambda[i].is_constant() && lambda[i].node() == unknowns[i].node()) {
        multipliers.push_back(i);
        without[i] = Expr(0.0);
      }
    const ExprVector factors = gradient(whole, unknowns);
    if (!jacobian(factors, unknowns).row.empty()) {
      result.hamiltonian = with_multipliers(whole, unknowns);
      result.has_multipliers = !result.hamiltonian.empty();
      return;
    }
    auto text = written(family.value(x_, without, formulas_.time), on_manifold_);
    for (const Index i : multipliers) {
      const auto factor = written(factors[i], on_manifold_);
      if (!text || !factor) return;
      add_product(names[at(i)], *factor, *text);
    }
    result.hamiltonian = text.value_or("");
  }

  // Where the energy E is not linear in the unknowns λ that are left, but E - λ ∂E/∂λ is free of them, as of a
  // Lagrangian that is a length: ∂E/∂λ is 0, and λ says no more than what multiplies the primary constraints.
  std::string with_multipliers(const Expr& energy, const ExprVector& unknowns) const {
    const ExprVector slopes = gradient(energy, unknowns);
    const Expr rest = energy - slopes.dot(unknowns);
    for (const Expr& slope : ExprVector(gradient(rest, unknowns)))
      if (written(slope, on_manifold_) != "0") return "";
    const VectorXd here = point_.z.head(unknowns.size());
    auto text = written(substitute(rest, unknowns, constants(here)), on_manifold_);
    for (std::size_t a = 0, count = 0; text && a < names_.size(); ++a)
      if (formulas_.constraints[a].level == 0)
        add_product("u_" + std::to_string(++count), names_[a], *text);
    return text.value_or("");
  }
  static void add_product(const std::string& multiplier, const std::string& factor,
                          std::string& sum) {
    if (factor == "0") return;
    const bool is_term = factor.find(' ') == std::string::npos && !factor.starts_with('-');
    sum = (sum == "0" ? "" : sum + " + ") + multiplier + "*" +
          (is_term ? factor : "(" + factor + ")");
  }

  // Nothing where the constraint is too long to be written.
  std::optional<ConstraintBrackets::Generator> generator(const ExprVector& combination) const {
    Expr function = 0.0;
    ExprVector field = ExprVector::Zero(frame_.cols());
    for (std::size_t a = 0; a < functions_.size(); ++a) {
      function += combination[static_cast<Index>(a)] * functions_[a];
      field += combination[static_cast<Index>(a)] * fields_[a];
    }
    const auto text = written(function, on_manifold_);
    if (!text) return std::nullopt;
    ConstraintBrackets::Generator found{*text, {}};
    const ExprVector rates = frame_ * field;
    for (Index i = 0; i < rates.size(); ++i)
      if (const auto rate = written(on_M_f(rates[i])); rate && *rate != "0")
        found.moves.emplace_back(name(i), *rate);
    return found;
  }

  std::vector<ConstraintBrackets::DiracBracket> dirac_brackets(
      const ExprMatrix& of_all, const std::vector<Index>& second) const {
    const auto count = std::ssize(second);
    if (count == 0 || x_.size() > most_coordinates) return {};
    const ExprMatrix C = of_all(second, second);
    const bool constant = std::ranges::all_of(C.reshaped(), [&](const Expr& entry) {
      return entry.is_constant() || number_of(entry, formulas_.parameters) != 0.0;
    });
    ExprMatrix inverse;
    if (constant) {
      const auto solved = quotient(C, ExprMatrix::Identity(count, count), formulas_.parameters);
      if (!solved) return {};
      inverse = *solved;
    } else if (count == 2) {
      inverse = ExprMatrix::Zero(2, 2);
      inverse(0, 1) = 1.0 / C(1, 0);
      inverse(1, 0) = 1.0 / C(0, 1);
    } else if (count == 4) {
      // Of a matrix that is antisymmetric, by its Pfaffian.
      const Expr pfaffian = C(0, 1) * C(2, 3) - C(0, 2) * C(1, 3) + C(0, 3) * C(1, 2);
      inverse = ExprMatrix::Zero(4, 4);
      const auto put = [&](Index a, Index b, const Expr& value) {
        inverse(a, b) = value / pfaffian;
        inverse(b, a) = -inverse(a, b);
      };
      put(1, 0, C(2, 3));
      put(0, 2, C(1, 3));
      put(3, 0, C(1, 2));
      put(2, 1, C(0, 3));
      put(1, 3, C(0, 2));
      put(3, 2, C(0, 1));
    } else {
      return {};
    }
    std::vector<ConstraintBrackets::DiracBracket> brackets;
    ExprMatrix along(x_.size(), count);  // {x_i, φ_a}
    for (Index a = 0; a < count; ++a) along.col(a) = frame_ * fields_[at(second[at(a)])];
    const ExprMatrix all =
        frame_ * bivector_ * frame_.transpose() + along * inverse * along.transpose();
    for (Index i = 0; i < x_.size(); ++i)
      for (Index j = i + 1; j < x_.size(); ++j) {
        const auto text = written(on_M_f(all(i, j)));
        if (!text) return {};
        if (*text != "0") brackets.push_back({name(i), name(j), *text});
      }
    return brackets;
  }

  std::string name(Index coordinate) const {
    return system_.names().coordinates[static_cast<std::size_t>(coordinate)];
  }

  const ImplicitSystem& system_;
  const ConstraintFormulas& formulas_;
  const State& point_;
  ExprMatrix bivector_;
  LinearMap<Expr> frame_;
  ExprVector x_;
  Simplification on_manifold_, on_M_f_;
  std::optional<NearbyPoints> nearby_;
  std::vector<std::string> names_;  // of the constraints: their formulas
  std::vector<Expr> functions_;     // φ_a
  std::vector<ExprVector> differentials_, fields_;
};

}  // namespace

std::optional<ConstraintBrackets> constraint_brackets(const ImplicitSystem& system,
                                                      const ConstraintLadder& ladder,
                                                      const ConstraintFormulas& formulas) {
  const auto structure = system.structure();
  if (!structure || ladder.index < 0 || ladder.constraints.empty()) return std::nullopt;
  const auto* dirac = dynamic_cast<const DiracSystem*>(&system);
  if (dirac && dirac->exterior().constraint) return std::nullopt;
  if (formulas.constraints.size() != ladder.constraints.size())
    return ConstraintBrackets{.missing = "not all constraints have formulas"};
  if (formulas.constraints.size() > most_constraints)
    return ConstraintBrackets{.missing = "there are more than 24 constraints"};
  const ExprVector& x = formulas.coordinates;
  auto lambda = bivector(*structure, x, x[0].graph(), formulas.parameters);
  if (!lambda) return std::nullopt;
  return Brackets(system, formulas, ladder.point, std::move(*lambda))();
}

}  // namespace courant
