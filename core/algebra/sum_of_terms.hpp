// SumOfTerms: sums whose equal terms are put together.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "courant/core/expressions/expr.hpp"

namespace courant {

// c_0 + Σ c_k f_k a_k with numbers c, factors f that are known beforehand or 1, and atoms a, which are no sums.
// Operations with what varies are counted as they will be written.
class SumOfTerms {
 public:
  struct Term {
    Expr factor, atom;
    double coefficient, magnitude;  // what it was added up from
    bool varies;                    // the atom
  };

  void add(double coefficient, const Expr& factor, const Expr& atom, bool varies);
  // The same with a term that is a sum taken apart.
  SumOfTerms with_apart(const Expr& atom, const SumOfTerms& sum) const;
  // Coefficients that are round-off of what they were added up from are zero.
  void drop_zeros();

  const std::vector<Term>& terms() const { return terms_; }
  bool has_met() const { return has_met_; }  // equal terms
  bool has_factors() const;
  // Whether terms with a factor have powers of two for coefficients.
  bool is_exact() const;

  std::size_t operations() const;
  Expr expression() const;

 private:
  struct Part;
  struct Product;

  void add(double coefficient, const Expr& known);
  void add(const SumOfTerms& other, double times, const Expr& factor);
  std::vector<Product> products() const;

  std::vector<Term> terms_;  // in the order in which they came
  std::unordered_map<std::uint64_t, std::size_t> places_;
  double constant_ = 0.0;
  bool has_met_ = false;
};

// Of a node; constants have none.
std::uint32_t node_number(const Expr& a);

}  // namespace courant
