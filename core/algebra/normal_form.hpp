// Expressions modulo relations.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "courant/core/algebra/polynomial_relations.hpp"
#include "courant/core/expressions/expr.hpp"

namespace courant {

// What an expression is where relations hold: a polynomial in `variables` and in what is no polynomial
// of them (sin(x), 1/(1 + x)) is replaced by its remainder modulo the relations, so that v - x (x·v) is v
// on the tangent vectors of a sphere, x·x = 1 and x·v = 0.
//
// Relations are = 0 and may have denominators, which do not vanish, and square roots; what cannot be made
// a polynomial is left out. An expression stays as it is where it would have some hundred terms on the
// way.
class NormalForm {
 public:
  NormalForm(const ExprVector& variables, const std::vector<Expr>& relations);

  Expr operator()(const Expr& a);

  // Divided by the factors that all of its terms, multiplied out, have in common and `may_divide` allows: x y + x exp(z)
  // is y + exp(z) where x is not 0. As it stands where there are none.
  Expr without_factors(const Expr& a, const std::function<bool(const Expr&)>& may_divide);

  // Functions of which one is 0 wherever the expression is: its real factors (polynomial_factors), each once, those of
  // fewest terms first, then those of lowest degree, then in the order of the variables. Numbers, powers of e, what stands
  // below and sums of even powers of one sign, such as x² + y², are left out. Nothing of what is 0 by the relations.
  std::vector<Expr> factors(const Expr& a);

  // A Gröbner basis of the relations, each = 0.
  std::vector<Expr> basis() const;

  // Equations that hold where the relations and `equations` do, and only there, as many as a Gröbner
  // basis has that eliminates `unknowns`, which are last of the variables. Nothing where one of the equations is no
  // polynomial of `variables`.
  std::vector<Expr> eliminated(const std::vector<Expr>& equations, const ExprVector& unknowns);

  // Polynomials without `unknowns`, which are last of the variables, that vanish where the relations and
  // `equations` do; roots and denominators with unknowns in them are eliminated too. So p + v/√(v² + w²) = 0
  // and q + w/√(v² + w²) = 0 have the consequence p² + q² - 1. Nothing where one of the equations is none of a
  // polynomial of the unknowns, their roots and what stands below.
  std::vector<Expr> consequences(const std::vector<Expr>& equations, const ExprVector& unknowns);

  // Whether the relations contradict each other, as x² + y² - 1 = 0 and x² + y² - 2 = 0 do: multiplied by
  // polynomials they add up to 1.
  bool hold_nowhere() const { return relations_->hold_nowhere(); }

 private:
  int factor(const Expr& a);
  const Polynomial& polynomial(const Expr& a);
  Polynomial made(const Expr& a);
  Expr expression(const Polynomial& polynomial) const;

  std::map<int, Expr> factors_;  // variables 0, 1, …; others, which come first: -1, -2, …
  std::unordered_map<std::uint32_t, int> numbers_;  // of factors, by their nodes
  std::unordered_map<std::uint32_t, Polynomial> known_;
  std::vector<Polynomial> given_;
  std::optional<PolynomialRelations> relations_;
};

}  // namespace courant
