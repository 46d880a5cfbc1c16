// Sums of products of numbers, variables, functions and sums in parentheses.
#pragma once

#include <string>
#include <utility>

#include "courant/core/algebra/factor_table.hpp"
#include "courant/core/algebra/polynomial_reduction.hpp"

namespace courant {

// Computes with expressions as sums of terms, polynomials in the factors of a table: x, sin(y), and
// (x + 1) or sqrt(x + 1), which know what they are made of. Every result is reduced by the relations of
// `reduction()`, and so that one expression has as few forms as can be:
//
//   (x + 1)²·1/(x + 1)   x + 1      sqrt(x + 1)³   (x + 1) sqrt(x + 1)      2 (x + 1)   2 x + 2
//
// Throws std::length_error where sums grow beyond a few hundred terms, std::domain_error for 1/0.
class SumArithmetic {
 public:
  struct Options {
    bool expand = true;          // products of sums are multiplied out, where they stay short
    bool add_fractions = false;  // what stands below is brought to one fraction before
  };

  explicit SumArithmetic(Options options);

  PolynomialReduction& reduction() { return reduction_; }
  // Other products from now on than those of the options.
  void set_expanding(bool expand) { options_.expand = expand; }

  static Polynomial number(double value);
  Polynomial factor(FactorTable::Factor factor);

  Polynomial plus(const Polynomial& a, const Polynomial& b) { return reduction_.plus(a, b); }
  Polynomial minus(const Polynomial& a, const Polynomial& b) { return reduction_.plus(a, b, -1.0); }
  Polynomial times(const Polynomial& a, const Polynomial& b);
  static Polynomial scaled(Polynomial sum, double factor);
  Polynomial to_power(const Polynomial& sum, int k);

  // Written with a common factor in front, where there is one.
  Polynomial factored(const Polynomial& sum);
  // Terms over the same sums put together: (x - y)/(x^2 + y^2) + ...
  Polynomial collected(const Polynomial& sum);
  // One fraction: all terms over what stands below any of them, as a product of sums; those that
  // divide what stands above are divided out.
  Polynomial as_fraction(const Polynomial& sum);
  // The left side of an equation without its denominators, and divided by what stands in all terms: but
  // positive powers of common factors stay, since the equation holds where they vanish. Parameters vanish nowhere.
  // Sums of parameters are multiplied out; or, where that is asked for, all parameters stand below: x²/a² + y²/b² = 1.
  Polynomial equation(const Polynomial& sum, bool divides = false);

  // The coefficient of the term of highest degree; 1 for 0.
  double leading(const Polynomial& sum) const;
  // With coefficients put together where that is shorter: p - q + a (p - q) as (a + 1)*(p - q), where a is a parameter.
  std::string text(const Polynomial& sum);

 private:
  Polynomial without_sums_of_parameters(Polynomial sum);
  Polynomial with_coefficients(const Polynomial& sum);
  int parentheses(const Polynomial& sum);
  Monomial normal(Monomial monomial);
  std::pair<Monomial, double> as_factor(const Polynomial& sum);
  Polynomial opened(const Polynomial& sum) const;

  Options options_;
  FactorTable factors_;
  PolynomialReduction reduction_;
};

}  // namespace courant
