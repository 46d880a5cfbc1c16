// The factors of sums of products, and sums as text.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "courant/core/algebra/polynomial_relations.hpp"

namespace courant {

// Numbers the factors of polynomials by their texts, x, sin(y), (x + 1), and writes polynomials in them.
class FactorTable {
 public:
  struct Factor {
    std::string text;
    Polynomial sum = {};  // of a sum in parentheses, or the argument of a square root
    bool is_sum = false, is_root = false;
    std::optional<std::uint32_t> variable = {};  // its place among the variables
    bool is_parameter = false;                   // a number with a name, not 0
  };
  using Terms = std::vector<std::pair<Monomial, double>>;

  // The number of the factor with this text. References to factors stay.
  int number(Factor factor);
  const Factor& operator[](int number) const { return factors_[static_cast<std::size_t>(number)]; }

  // The powers of parameters, and those of all else.
  std::pair<Monomial, Monomial> divided(const Monomial& monomial) const;

  // High degrees first; among factors, which each monomial has in this order, first variables by their
  // places, then what stands in parentheses by its text. Parameters count where all else is equal.
  Terms in_descending_order(const Polynomial& sum) const;
  // The same with a positive term in front, if there is one.
  Terms in_order(const Polynomial& sum) const;
  // The first of them. Not of 0.
  std::pair<Monomial, double> first_in_order(const Polynomial& sum) const;

  // Throws std::length_error where it has more than a thousand characters.
  std::string text(const Polynomial& sum) const;

 private:
  bool is_before(int a, int b) const;
  Terms with_sorted_factors(const Polynomial& sum) const;
  bool is_above(const Monomial& a, const Monomial& b) const;  // both sorted
  // Without the sign of the coefficient, which stands before it.
  std::string text(const Monomial& monomial, double coefficient) const;

  std::deque<Factor> factors_;
  std::map<std::string, int> numbers_;
};

}  // namespace courant
