#include "courant/integrators/ladder/constraint_formulas.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "courant/core/derivative.hpp"

namespace courant {
namespace {

constexpr std::size_t longest = 100;  // characters of a formula

ExprVector named(Graph& graph, const std::vector<std::string>& names, const char* suffix) {
  ExprVector result(static_cast<Index>(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i)
    result[static_cast<Index>(i)] = graph.variable(names[i] + suffix);
  return result;
}

std::string text(const Expr& expression) {
  std::ostringstream out;
  out << expression;
  return out.str();
}

// A polynomial of few terms as a sum of monomials; empty if it is none.
class Polynomial {
 public:
  Polynomial(const Expr& function, const ExprVector& variables,
             const std::vector<std::string>& names)
      : variables_(variables), names_(names) {
    valid_ = collect(function, 0, 1.0, {});
  }

  bool valid() const { return valid_; }
  std::size_t size() const { return terms_.size(); }
  double largest() const {
    double size = 0.0;
    for (const auto& [powers, c] : terms_) size = std::max(size, std::abs(c));
    return size;
  }
  std::string text(double divisor) const {
    std::string result;
    for (const auto& [powers, c] : terms_) {
      const double value = c / divisor;
      result += result.empty() ? (value < 0 ? "-" : "") : (value < 0 ? " - " : " + ");
      std::string monomial;
      for (std::size_t i = 0; i < powers.size(); ++i) {
        if (i > 0 && powers[i] == powers[i - 1]) continue;
        const auto power = std::count(powers.begin(), powers.end(), powers[i]);
        monomial += (monomial.empty() ? "" : "*") + names_[static_cast<std::size_t>(powers[i])] +
                    (power > 1 ? "^" + std::to_string(power) : "");
      }
      std::ostringstream size;
      size << Expr(std::abs(value));
      const bool one = size.str() == "1" && !monomial.empty();
      result += one ? monomial : size.str() + (monomial.empty() ? "" : "*" + monomial);
    }
    return result.empty() ? "0" : result;
  }

 private:
  // Terms from the derivatives at 0 by the variables `powers` (in increasing order) and further.
  bool collect(const Expr& derivative, Index from, double factorial, std::vector<Index> powers) {
    if (derivative.is_constant(0.0)) return true;
    const Expr at_zero =
        substitute(derivative, variables_, ExprVector::Constant(variables_.size(), Expr(0.0)));
    if (!at_zero.is_constant() || !std::isfinite(at_zero.value())) return false;
    if (std::abs(at_zero.value()) > 1e-14) terms_.emplace_back(powers, at_zero.value() / factorial);
    if (derivative.is_constant()) return true;
    if (powers.size() == 4 || terms_.size() > 12) return false;
    const ExprVector g = gradient(derivative, variables_);
    for (Index i = from; i < g.size(); ++i) {
      std::vector<Index> next = powers;
      next.push_back(i);
      const auto power = static_cast<double>(std::count(next.begin(), next.end(), i));
      if (!collect(g[i], i, factorial * power, next)) return false;
    }
    // Variables before `from` belong to other orders of the same monomials.
    return true;
  }

  const ExprVector& variables_;
  const std::vector<std::string>& names_;
  bool valid_ = false;
  std::vector<std::pair<std::vector<Index>, double>> terms_;
};

// Equations on the way to their reduced form.
class Elimination {
 public:
  Elimination(const ImplicitSystem& system, const State& point)
      : point_(point),
        x_(named(graph_, system.names().coordinates, "")),
        n_(x_.size()),
        t_(graph_.variable("t")) {
    const ExprVector v = named(graph_, system.names().coordinates, "' (velocity)");
    const ExprVector z = named(graph_, system.names().auxiliary, "");
    unknowns_.resize(n_ + z.size());
    unknowns_ << v, z;
    solution_ = unknowns_;
    numerator_ = unknowns_;
    denominator_ = ExprVector::Constant(unknowns_.size(), Expr(1.0));
    free_.resize(n_ + 1);
    free_ << x_, t_;
    names_ = system.names().coordinates;
    names_.push_back("t");
    solved_.assign(static_cast<std::size_t>(unknowns_.size()), false);
    const ExprVector F = system.residual(x_, v, z, t_);
    equations_.assign(F.begin(), F.end());
  }

  // Solves for unknowns while it can; what is left without unknowns and is not identically zero is
  // returned, and taken off.
  std::vector<Expr> constraints() {
    while (solve_one()) {
    }
    std::vector<Expr> found, kept;
    for (const Expr& equation : equations_) {
      if (equation.is_constant()) continue;
      bool has_unknown = false;
      for (const Expr& entry : gradient(equation, unknowns_))
        has_unknown = has_unknown || !entry.is_constant(0.0);
      (has_unknown ? kept : found).push_back(equation);
    }
    equations_ = kept;
    return found;
  }

  // d/dt of a function of (x, t), with what is known of x' put in, as one more equation.
  void differentiate(const Expr& function) {
    ExprVector at(n_ + 1), rate(n_ + 1);
    at << x_, t_;
    rate << solution_.head(n_), Expr(1.0);
    equations_.push_back(tangent(ExprVector::Constant(1, function), at, rate)[0]);
  }

  double value(const Expr& function) const {
    const Expr number = substitute(function, variables(), constants(numbers()));
    return number.is_constant() ? number.value() : std::nan("");
  }
  VectorXd gradient_at_point(const Expr& function) const {
    const ExprVector g = gradient(function, x_);
    VectorXd result(n_);
    for (Index i = 0; i < n_; ++i) result[i] = value(g[i]);
    return result;
  }
  // As a polynomial where it is one: whole where its coefficients have one size.
  std::string written(const Expr& function) const {
    const std::string plain = text(function);
    const Polynomial polynomial(function, free_, names_);
    if (!polynomial.valid()) return plain;
    const std::string as_is = polynomial.text(1.0);
    const double sign = as_is.starts_with('-') ? -1.0 : 1.0;
    const std::string scaled = polynomial.text(sign * polynomial.largest());
    return scaled.size() <= as_is.size() ? scaled : as_is;
  }
  // Of auxiliary unknown j in x and t; empty if others are left in it.
  std::string solution(Index j) const {
    const Index u = n_ + j;
    if (!solved_[static_cast<std::size_t>(u)]) return "";
    for (const Expr& entry : gradient(solution_[u], unknowns_))
      if (!entry.is_constant(0.0)) return "";
    const Polynomial above(numerator_[u], free_, names_), below(denominator_[u], free_, names_);
    if (!above.valid() || !below.valid()) return text(solution_[u]);
    const double divisor = below.largest() * (below.text(1.0).starts_with('-') ? -1.0 : 1.0);
    if (below.text(divisor) == "1") return above.text(divisor);
    const auto bracketed = [](const Polynomial& p, double by) {
      return p.size() > 1 ? "(" + p.text(by) + ")" : p.text(by);
    };
    return bracketed(above, divisor) + "/" + bracketed(below, divisor);
  }

 private:
  ExprVector variables() const {
    ExprVector all(n_ + 1 + unknowns_.size());
    all << x_, t_, unknowns_;
    return all;
  }
  VectorXd numbers() const {
    VectorXd all(n_ + 1 + unknowns_.size());
    all << point_.x, point_.t, point_.v, point_.z;
    return all;
  }

  // Solves the equation with fewest unknowns for one that is linear in it; constant coefficients
  // first. False if there is none.
  bool solve_one() {
    std::size_t best_equation = equations_.size();
    Index best_unknown = -1;
    double best_cost = 1e9;
    for (std::size_t e = 0; e < equations_.size(); ++e) {
      if (equations_[e].is_constant()) continue;
      const ExprVector g = gradient(equations_[e], unknowns_);
      Index count = 0;
      for (const Expr& entry : g) count += entry.is_constant(0.0) ? 0 : 1;
      for (Index u = 0; u < g.size(); ++u) {
        if (g[u].is_constant(0.0)) continue;
        double cost = static_cast<double>(count);
        if (!g[u].is_constant()) {
          bool linear = std::abs(value(g[u])) > 1e-6;
          for (const Expr& second : gradient(g[u], unknowns_))
            linear = linear && second.is_constant(0.0);
          if (!linear) continue;
          cost += 1000.0;
        }
        if (cost < best_cost) {
          best_cost = cost;
          best_equation = e;
          best_unknown = u;
        }
      }
    }
    if (best_unknown < 0) return false;
    const Expr equation = equations_[best_equation];
    const Expr coefficient = gradient(equation, unknowns_)[best_unknown];
    const ExprVector unknown = unknowns_.segment(best_unknown, 1);
    const Expr rest = substitute(equation, unknown, ExprVector::Constant(1, Expr(0.0)));
    const Expr result = coefficient.is_constant(1.0)    ? -rest
                        : coefficient.is_constant(-1.0) ? rest
                                                        : -rest / coefficient;
    equations_.erase(equations_.begin() + static_cast<std::ptrdiff_t>(best_equation));
    const ExprVector by = ExprVector::Constant(1, result);
    for (Expr& other : equations_) other = substitute(other, unknown, by);
    solution_[best_unknown] = result;
    numerator_[best_unknown] = -rest;
    denominator_[best_unknown] = coefficient;
    solved_[static_cast<std::size_t>(best_unknown)] = true;
    for (Index u = 0; u < solution_.size(); ++u)
      if (solved_[static_cast<std::size_t>(u)])
        for (ExprVector* part : {&solution_, &numerator_, &denominator_})
          (*part)[u] = substitute((*part)[u], unknown, by);
    return true;
  }

  Graph graph_;
  const State& point_;
  ExprVector x_;
  Index n_;
  Expr t_;
  ExprVector unknowns_, solution_, numerator_, denominator_;
  ExprVector free_;  // (x, t), with their names
  std::vector<std::string> names_;
  std::vector<bool> solved_;
  std::vector<Expr> equations_;
};

}  // namespace

ConstraintFormulas constraint_formulas(const ImplicitSystem& system,
                                       const ConstraintLadder& ladder) {
  ConstraintFormulas result;
  const Manifold& M = *system.manifold();
  const Index n = M.dimension();
  if (ladder.index < 0 || M.ambient_dimension() != n || M.tangent_dimension() != n ||
      n + system.auxiliary_size() > 80 || !M.frame(ladder.point.x).isIdentity(0.0))
    return result;
  Elimination elimination(system, ladder.point);
  MatrixXd known(n, 0);  // orthonormal: the gradients so far
  for (Index level = 0; level <= ladder.index; ++level) {
    for (const Expr& function : elimination.constraints()) {
      const double value = elimination.value(function);
      VectorXd g = elimination.gradient_at_point(function);
      const double size = g.norm();
      if (!(size > 0.0) || !(std::abs(value) < 1e-8 * size * (1.0 + ladder.point.x.norm())))
        continue;
      g -= known * (known.transpose() * g);
      if (g.norm() < 1e-8 * size) continue;  // follows from those before
      known.conservativeResize(Eigen::NoChange, known.cols() + 1);
      known.rightCols(1) = g.normalized();
      const std::string formula = level == 0 ? text(function) : elimination.written(function);
      if (formula.size() <= longest) result.constraints.push_back({level, formula});
      elimination.differentiate(function);
    }
  }
  elimination.constraints();
  for (Index j = 0; j < system.auxiliary_size(); ++j) {
    if (!ladder.determined[static_cast<std::size_t>(j)]) continue;
    if (const std::string formula = elimination.solution(j);
        !formula.empty() && formula.size() <= longest)
      result.values.push_back({j, formula});
  }
  return result;
}

}  // namespace courant
