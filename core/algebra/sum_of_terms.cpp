#include "courant/core/algebra/sum_of_terms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "courant/core/numbers/power_of_two.hpp"

namespace courant {
namespace {

// A coefficient below this part of what it was added up from is round-off.
constexpr double kCancels = 1e-15;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

std::uint64_t key(const Expr& factor, const Expr& atom) {
  return std::uint64_t{node_number(factor)} << 32 | node_number(atom);
}

// a + c b
Expr plus(const Expr& a, double c, const Expr& b) {
  if (a.is_constant(0.0)) return c * b;
  return c > 0.0 ? a + c * b : a - (-c) * b;
}
// a + (c f) b
Expr plus(const Expr& a, double c, const Expr& factor, const Expr& b) {
  if (factor.is_constant()) return plus(a, c, b);
  if (a.is_constant(0.0)) return (c * factor) * b;
  return c > 0.0 ? a + (c * factor) * b : a - (-c * factor) * b;
}

bool is_variable(const Expr& a) { return a.graph().node(a.node()).op == Op::variable; }

void to_front(auto& list, const auto& is_first) {
  const auto found = std::ranges::find_if(list, is_first);
  if (found != list.end()) std::rotate(list.begin(), found, found + 1);
}

}  // namespace

std::uint32_t node_number(const Expr& a) { return a.is_constant() ? kNone : a.node(); }

// c (a_1 - a_2 + …): terms with coefficients of one size, which begin with one that is added, if there is one.
struct SumOfTerms::Part {
  std::vector<const Term*> terms;
  double coefficient() const { return terms[0]->coefficient; }
};

// All terms with one factor: f (known + parts). What cancelled before the factor came to it cancels still.
struct SumOfTerms::Product {
  Expr factor, known;  // known: terms that are variables, which are added up first
  std::vector<Part> parts;

  // What is drawn out: the coefficient of the first part, which the factor takes.
  double coefficient() const {
    return parts.empty() || factor.is_constant() ? 1.0 : parts[0].coefficient();
  }
  // sum + parts/c
  Expr added_to(Expr sum, double c) const {
    for (const Part& part : parts) {
      const double first = part.coefficient();
      Expr terms = 0.0;
      for (const Term* term : part.terms)
        terms = plus(terms, term->coefficient / first, term->atom);
      sum = plus(sum, first / c, terms);
    }
    return sum;
  }
  bool is_subtracted() const {
    return factor.is_constant() && known.is_constant(0.0) && !parts.empty() &&
           parts[0].coefficient() == -1.0;
  }
};

void SumOfTerms::add(double coefficient, const Expr& factor, const Expr& atom, bool varies) {
  if (atom.is_constant()) {
    add(coefficient * atom.value(), factor);
    return;
  }
  const auto [place, is_new] = places_.try_emplace(key(factor, atom), terms_.size());
  if (is_new) {
    terms_.push_back({factor, atom, coefficient, std::fabs(coefficient), varies});
    return;
  }
  has_met_ = true;
  Term& term = terms_[place->second];
  term.coefficient += coefficient;
  term.magnitude += std::fabs(coefficient);
}

// A number times what is known.
void SumOfTerms::add(double coefficient, const Expr& known) {
  if (known.is_constant())
    constant_ += coefficient * known.value();
  else if (coefficient != 0.0)
    add(coefficient, 1.0, known, false);
}

void SumOfTerms::add(const SumOfTerms& other, double times, const Expr& factor) {
  for (const Term& term : other.terms_)
    add(times * term.coefficient, factor * term.factor, term.atom, term.varies);
  add(times * other.constant_, factor);
}

SumOfTerms SumOfTerms::with_apart(const Expr& atom, const SumOfTerms& sum) const {
  SumOfTerms result;
  result.constant_ = constant_;
  for (const Term& term : terms_)
    if (term.varies && term.atom.node() == atom.node())
      result.add(sum, term.coefficient, term.factor);
    else
      result.add(term.coefficient, term.factor, term.atom, term.varies);
  return result;
}

void SumOfTerms::drop_zeros() {
  std::erase_if(terms_, [](const Term& term) {
    return std::fabs(term.coefficient) <= kCancels * term.magnitude;
  });
  places_.clear();
  for (std::size_t k = 0; k < terms_.size(); ++k)
    places_[key(terms_[k].factor, terms_[k].atom)] = k;
}

bool SumOfTerms::is_exact() const {
  return std::ranges::all_of(terms_, [](const Term& term) {
    return term.factor.is_constant() || is_power_of_two(term.coefficient);
  });
}

bool SumOfTerms::has_factors() const {
  return !std::ranges::all_of(terms_, [](const Term& term) { return term.factor.is_constant(); });
}

std::size_t SumOfTerms::operations() const {
  const std::vector<Product> products = this->products();
  std::size_t count = 0, summands = constant_ != 0.0 ? 1 : 0;
  for (const Product& product : products) {
    const double c = product.coefficient();
    if (!product.parts.empty() && !product.factor.is_constant()) ++count;
    if (!product.known.is_constant(0.0)) ++summands;
    for (const Part& part : product.parts) {
      count += part.terms.size() - 1 + (std::fabs(part.coefficient() / c) != 1.0 ? 1 : 0);
      ++summands;
    }
  }
  if (summands > 0) count += summands - 1;
  return !products.empty() && products[0].is_subtracted() ? count + 1 : count;
}

Expr SumOfTerms::expression() const {
  Expr sum = 0.0;
  for (const Product& product : products()) {
    const double c = product.coefficient();
    if (product.factor.is_constant())
      sum = product.added_to(sum + product.known, 1.0);
    else if (product.parts.empty())
      sum = sum + product.factor * product.known;
    else
      sum = plus(sum, c, product.factor, product.added_to(product.known / c, c));
  }
  return sum + constant_;
}

// In the order in which they came, parts and products that are added before those that are subtracted.
std::vector<SumOfTerms::Product> SumOfTerms::products() const {
  std::vector<Product> result;
  std::map<std::uint32_t, std::size_t> places;
  for (const Term& term : terms_)
    if (places.try_emplace(node_number(term.factor), result.size()).second)
      result.push_back({term.factor, 0.0, {}});
  const auto product = [&](const Term& term) -> Product& {
    return result[places.at(node_number(term.factor))];
  };
  // Differences of formulas keep their order: H(x) - H(x₀) may be small.
  std::vector<bool> has_formulas(result.size(), false);
  for (const Term& term : terms_)
    if (!term.varies && !is_variable(term.atom))
      has_formulas[places.at(node_number(term.factor))] = true;
  std::map<std::pair<std::uint32_t, double>, std::size_t> places_of_parts;
  for (const Term& term : terms_) {
    const std::uint32_t factor = node_number(term.factor);
    Product& of = product(term);
    if (!term.varies && !has_formulas[places.at(factor)]) {
      of.known = plus(of.known, term.coefficient, term.atom);
      continue;
    }
    const auto [place, is_new] =
        places_of_parts.try_emplace({factor, std::fabs(term.coefficient)}, of.parts.size());
    if (is_new) of.parts.emplace_back();
    of.parts[place->second].terms.push_back(&term);
  }
  for (Product& of : result) {
    for (Part& part : of.parts)
      to_front(part.terms, [](const Term* term) { return term->coefficient > 0.0; });
    to_front(of.parts, [](const Part& part) { return part.coefficient() > 0.0; });
  }
  to_front(result, [](const Product& of) {
    return of.parts.empty() || !of.known.is_constant(0.0) || of.parts[0].coefficient() > 0.0;
  });
  return result;
}

}  // namespace courant
