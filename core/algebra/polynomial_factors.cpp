#include "courant/core/algebra/polynomial_factors.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "courant/core/algebra/polynomial_quotient.hpp"
#include "courant/core/linear/generalized_eigenvalues.hpp"

namespace courant {
namespace {

// Coefficients below this part of the largest one are what others that cancelled left.
constexpr double kSmallTerm = 1e-11;

double largest_coefficient(const Polynomial& a) {
  double size = 0.0;
  for (const auto& [monomial, c] : a) size = std::max(size, std::fabs(c));
  return size;
}

Polynomial without_small_terms(Polynomial a, double size) {
  std::erase_if(a, [&](const auto& term) { return std::fabs(term.second) <= kSmallTerm * size; });
  return a;
}

bool is_constant_polynomial(const Polynomial& a) {
  return a.empty() || (a.size() == 1 && a.begin()->first.empty());
}

Polynomial polynomial_product(const Polynomial& a, const Polynomial& b) {
  Polynomial result;
  for (const auto& [of_a, c] : a)
    for (const auto& [of_b, d] : b) add_term(result, product(of_a, of_b), c * d);
  return without_small_terms(std::move(result), largest_coefficient(a) * largest_coefficient(b));
}

Polynomial linear_sum(Polynomial a, const Polynomial& b, double factor) {
  const double size = std::max(largest_coefficient(a), std::fabs(factor) * largest_coefficient(b));
  for (const auto& [monomial, c] : b) add_term(a, monomial, factor * c);
  return without_small_terms(std::move(a), size);
}

Polynomial with_leading_one(Polynomial a) {
  const double lead = leading_term(a).second;
  for (auto& [monomial, c] : a) c /= lead;
  return a;
}

// a/b, where what is left of the division is round-off.
std::optional<Polynomial> exact_quotient(Polynomial a, const Polynomial& b) {
  constexpr int most_steps = 200;
  const double size = largest_coefficient(a);
  const auto& [lead, scale] = leading_term(b);
  Polynomial result;
  for (int steps = 0; !a.empty(); ++steps) {
    const auto [highest, coefficient_of_a] = leading_term(a);
    if (steps == most_steps || !divides(lead, highest)) return std::nullopt;
    const Monomial by = product(highest, lead, -1);
    const double c = coefficient_of_a / scale;
    result.emplace(by, c);
    for (const auto& [term, coefficient] : b) add_term(a, product(term, by), -c * coefficient);
    a.erase(highest);
    a = without_small_terms(std::move(a), size);
  }
  return result;
}

std::set<int> variables_in_polynomial(const Polynomial& a) {
  std::set<int> found;
  for (const auto& [monomial, c] : a)
    for (const auto& [variable, power] : monomial) found.insert(variable);
  return found;
}

// As a polynomial in one variable: its coefficients by the powers, highest last.
std::map<int, Polynomial> by_powers(const Polynomial& a, int variable) {
  std::map<int, Polynomial> coefficients;
  for (const auto& [monomial, c] : a) {
    int power = 0;
    Monomial rest;
    for (const auto& [factor, k] : monomial)
      if (factor == variable)
        power = k;
      else
        rest.emplace_back(factor, k);
    coefficients[power].emplace(std::move(rest), c);
  }
  return coefficients;
}

// s with s² = a; nothing where there is none with real coefficients.
std::optional<Polynomial> polynomial_root(Polynomial a) {
  constexpr int most_steps = 60;
  if (a.empty()) return Polynomial();
  const double size = largest_coefficient(a);
  const auto half = [](const Monomial& monomial) -> std::optional<Monomial> {
    Monomial result = monomial;
    for (auto& [factor, power] : result) {
      if (power % 2 != 0) return std::nullopt;
      power /= 2;
    }
    return result;
  };
  const auto [lead, square] = leading_term(a);
  const std::optional<Monomial> first = half(lead);
  if (!first || square < 0.0) return std::nullopt;
  const double scale = std::sqrt(square);
  Polynomial root = {{*first, scale}};
  a.erase(lead);
  for (int steps = 0; !a.empty(); ++steps) {
    const auto [highest, coefficient_of_a] = leading_term(a);
    if (steps == most_steps || !divides(*first, highest)) return std::nullopt;
    const Monomial next = product(highest, *first, -1);
    const double c = coefficient_of_a / (2.0 * scale);
    if (root.contains(next)) return std::nullopt;
    for (const auto& [term, coefficient] : root)
      add_term(a, product(term, next), -2.0 * c * coefficient);
    add_term(a, product(next, next), -c * c);
    a.erase(highest);
    root.emplace(next, c);
    a = without_small_terms(std::move(a), size);
  }
  return root;
}

using Factors = std::vector<Polynomial>;

void add_factor(Factors& all, const Polynomial& factor) {
  const Polynomial monic = with_leading_one(factor);
  const auto is_same = [&](const Polynomial& other) {
    return linear_sum(monic, other, -1.0).empty();
  };
  if (std::ranges::none_of(all, is_same)) all.push_back(monic);
}

// p/q for a number that is next to one with a small q, else the number.
double next_fraction(double number) {
  constexpr int largest_q = 48;
  for (int q = 1; q <= largest_q; ++q)
    if (const double p = std::round(number * q); std::fabs(number * q - p) <= 1e-9 * (1 + q))
      return p / q;
  return number;
}

// Those of a polynomial of one variable by its coefficients, highest last.
std::vector<double> real_roots_of(const Eigen::VectorXd& coefficients) {
  const Eigen::Index degree = coefficients.size() - 1;
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(degree, degree);
  if (degree > 1) companion.diagonal(-1).setOnes();
  companion.col(degree - 1) = -coefficients.head(degree) / coefficients[degree];
  const auto [alphas, betas] =
      generalized_eigenvalues(companion, Eigen::MatrixXd::Identity(degree, degree));
  std::vector<double> real;
  for (Eigen::Index i = 0; i < degree; ++i)
    if (const std::complex<double> root = alphas[i] / betas[i];
        std::fabs(root.imag()) <= 1e-6 * (1.0 + std::abs(root)))
      real.push_back(root.real());
  std::ranges::sort(real);
  return real;
}

class Factorization {
 public:
  Factors operator()(const Polynomial& a) {
    split(a);
    return std::move(found_);
  }

 private:
  void split(const Polynomial& given) {
    if (is_constant_polynomial(given)) return;
    const Polynomial a = without_monomials(given);
    if (is_constant_polynomial(a)) return;
    const std::set<int> variables = variables_in_polynomial(a);
    for (const int variable : variables)
      if (const auto content = content_by(a, variable)) return split(*content, a);
    for (const int variable : variables)
      if (by_powers(a, variable).rbegin()->first == 1) return add_factor(found_, a);
    for (const int variable : variables) {
      const Outcome outcome = split_as_quadratic(a, variable);
      if (outcome != Outcome::unknown) return;
    }
    for (const int variable : variables)
      if (const auto factor = linear_factor(a, variable)) return split(*factor, a);
    add_factor(found_, a);
  }
  void split(const Polynomial& factor, const Polynomial& a) {
    split(factor);
    if (const auto rest = exact_quotient(a, factor)) split(*rest);
  }

  Polynomial without_monomials(const Polynomial& a) {
    Monomial common = a.begin()->first;
    for (const auto& [monomial, c] : a)
      common = combined(common, monomial, [](int one, int other) { return std::min(one, other); });
    for (const auto& [variable, power] : common) add_factor(found_, {{{{variable, 1}}, 1.0}});
    Polynomial rest;
    for (const auto& [monomial, c] : a) rest.emplace(product(monomial, common, -1), c);
    return rest;
  }

  // What divides all coefficients, those of a polynomial in one variable; nothing where only numbers do.
  static std::optional<Polynomial> common_divisor(const std::vector<Polynomial>& coefficients) {
    const auto& shortest = *std::ranges::min_element(coefficients, {}, &Polynomial::size);
    if (is_constant_polynomial(shortest)) return std::nullopt;
    Polynomial common = {{Monomial{}, 1.0}};
    for (const Polynomial& factor : Factorization()(shortest)) {
      std::vector<Polynomial> left = coefficients;
      const auto divide = [&] {
        return std::ranges::all_of(left, [&](Polynomial& one) {
          const auto quotient = exact_quotient(one, factor);
          if (quotient) one = *quotient;
          return quotient.has_value();
        });
      };
      while (divide()) common = polynomial_product(common, factor);
    }
    return is_constant_polynomial(common) ? std::nullopt : std::optional(common);
  }
  static std::optional<Polynomial> content_by(const Polynomial& a, int variable) {
    std::vector<Polynomial> coefficients;
    for (const auto& [power, coefficient] : by_powers(a, variable))
      coefficients.push_back(coefficient);
    return common_divisor(coefficients);
  }

  enum class Outcome { done, unknown };

  // a w² + b w + c, w a power of the variable, is a product where b² - 4 a c is a square. Where w is the variable itself it
  // is one only there.
  Outcome split_as_quadratic(const Polynomial& a, int variable) {
    const std::map<int, Polynomial> coefficients = by_powers(a, variable);
    const int degree = coefficients.rbegin()->first, half = degree / 2;
    if (degree % 2 != 0 ||
        std::ranges::any_of(coefficients, [&](const auto& term) { return term.first % half != 0; }))
      return Outcome::unknown;
    const auto of = [&](int power) {
      const auto found = coefficients.find(power);
      return found == coefficients.end() ? Polynomial() : found->second;
    };
    const Polynomial first = of(degree), second = of(half), third = of(0);
    const auto root = polynomial_root(
        linear_sum(polynomial_product(second, second), polynomial_product(first, third), -4.0));
    if (root) {
      const Polynomial w = {{{{variable, half}}, 1.0}};
      const Polynomial factor =
          linear_sum(polynomial_product(w, first), linear_sum(second, *root, 1.0), 0.5);
      const auto content = content_by(factor, variable);
      const auto part = content ? exact_quotient(factor, *content) : factor;
      if (part && exact_quotient(a, *part)) {
        split(*part, a);
        return Outcome::done;
      }
    }
    if (degree != 2) return Outcome::unknown;
    add_factor(found_, a);
    return Outcome::done;
  }

  // α v + c β with α and β that divide the first and the last coefficient; c from a root where the other variables have
  // some values.
  static std::optional<Polynomial> linear_factor(const Polynomial& a, int variable) {
    const std::map<int, Polynomial> coefficients = by_powers(a, variable);
    const int degree = coefficients.rbegin()->first;
    if (degree < 3 || !coefficients.contains(0)) return std::nullopt;
    const std::vector<double> roots = real_roots_of(numbers(coefficients, degree));
    for (const Polynomial& alpha : divisors(coefficients.rbegin()->second))
      for (const Polynomial& beta : divisors(coefficients.begin()->second))
        for (const double root : roots) {
          const double c = -root * value(alpha) / value(beta);
          for (const double number : {next_fraction(c), c}) {
            const Polynomial factor =
                linear_sum(polynomial_product({{{{variable, 1}}, 1.0}}, alpha), beta, number);
            if (number != 0.0 && exact_quotient(a, factor)) return factor;
          }
        }
    return std::nullopt;
  }

  // Products of some of the factors, up to numbers; of many factors those of each by itself.
  static std::vector<Polynomial> divisors(const Polynomial& a) {
    constexpr std::size_t most = 32;
    std::vector<Polynomial> all = {{{Monomial{}, 1.0}}};
    for (const Polynomial& factor : Factorization()(a)) {
      const std::size_t before = all.size();
      for (std::size_t i = 0; i < before && all.size() < most; ++i)
        for (Polynomial next = polynomial_product(all[i], factor);
             all.size() < most && exact_quotient(a, next); next = polynomial_product(next, factor))
          all.push_back(next);
    }
    return all;
  }

  // Where each variable has a value of its own.
  static double value(const Polynomial& a) {
    double total = 0.0;
    for (const auto& [monomial, c] : a) {
      double term = c;
      for (const auto& [variable, power] : monomial)
        term *= std::pow(1.0 + 0.37 * std::fabs(std::sin(1.0 + 2.0 * variable)), power);
      total += term;
    }
    return total;
  }
  static Eigen::VectorXd numbers(const std::map<int, Polynomial>& coefficients, int degree) {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(degree + 1);
    for (const auto& [power, coefficient] : coefficients) result[power] = value(coefficient);
    return result;
  }

  Factors found_;
};

}  // namespace

std::vector<Polynomial> polynomial_factors(const Polynomial& a) { return Factorization()(a); }

bool has_one_sign(const Polynomial& a) {
  if (a.size() < 2) return false;
  const bool is_positive = a.begin()->second > 0.0;
  return std::ranges::all_of(a, [&](const auto& term) {
    return (term.second > 0.0) == is_positive &&
           std::ranges::all_of(term.first, [](const auto& power) { return power.second % 2 == 0; });
  });
}

}  // namespace courant
