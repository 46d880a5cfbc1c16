#include "courant/core/algebra/factor_table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "courant/core/words/written_number.hpp"

namespace courant {

int FactorTable::number(Factor factor) {
  const auto next = static_cast<int>(factors_.size());
  const auto [at, is_new] = numbers_.emplace(factor.text, next);
  if (is_new) factors_.push_back(std::move(factor));
  return at->second;
}

std::pair<Monomial, Monomial> FactorTable::divided(const Monomial& monomial) const {
  std::pair<Monomial, Monomial> parts;
  for (const auto& power : monomial)
    ((*this)[power.first].is_parameter ? parts.first : parts.second).push_back(power);
  return parts;
}

bool FactorTable::is_before(int a, int b) const {
  const Factor &of_a = (*this)[a], &of_b = (*this)[b];
  if (of_a.variable && of_b.variable) return *of_a.variable < *of_b.variable;
  if (of_a.variable || of_b.variable) return of_a.variable.has_value();
  return of_a.text < of_b.text;
}

FactorTable::Terms FactorTable::with_sorted_factors(const Polynomial& sum) const {
  Terms terms(sum.begin(), sum.end());
  for (auto& [monomial, c] : terms)
    std::ranges::sort(monomial,
                      [this](const auto& a, const auto& b) { return is_before(a.first, b.first); });
  return terms;
}

bool FactorTable::is_above(const Monomial& a, const Monomial& b) const {
  const auto before = [this](int of_a, int of_b) { return is_before(of_a, of_b); };
  const auto [numbers_a, others_a] = divided(a);
  const auto [numbers_b, others_b] = divided(b);
  return others_a == others_b ? leads(numbers_a, numbers_b, before)
                              : leads(others_a, others_b, before);
}

FactorTable::Terms FactorTable::in_descending_order(const Polynomial& sum) const {
  Terms terms = with_sorted_factors(sum);
  std::ranges::stable_sort(
      terms, [this](const auto& a, const auto& b) { return is_above(a.first, b.first); });
  return terms;
}

std::pair<Monomial, double> FactorTable::first_in_order(const Polynomial& sum) const {
  Terms terms = with_sorted_factors(sum);
  return std::move(*std::ranges::min_element(terms, [this](const auto& a, const auto& b) {
    const bool is_a_positive = a.second > 0.0, is_b_positive = b.second > 0.0;
    return is_a_positive != is_b_positive ? is_a_positive : is_above(a.first, b.first);
  }));
}

FactorTable::Terms FactorTable::in_order(const Polynomial& sum) const {
  Terms terms = in_descending_order(sum);
  if (terms.empty() || terms.front().second > 0.0) return terms;
  const auto positive =
      std::ranges::find_if(terms, [](const auto& term) { return term.second > 0.0; });
  if (positive != terms.end()) std::rotate(terms.begin(), positive, positive + 1);
  return terms;
}

std::string FactorTable::text(const Polynomial& sum) const {
  constexpr std::size_t longest = 1000;
  if (sum.empty()) return "0";
  std::string result;
  for (const auto& [monomial, c] : in_order(sum)) {
    result += result.empty() ? (c < 0 ? "-" : "") : (c < 0 ? " - " : " + ");
    result += text(monomial, c);
    // Each term, not only the sum: a term has the texts of its factors, which have those of theirs.
    if (result.size() > longest) throw std::length_error("FactorTable: the text is too long.");
  }
  return result;
}

std::string FactorTable::text(const Monomial& monomial, double coefficient) const {
  const WrittenNumber number = written_number(std::fabs(coefficient));
  std::string above = number.above, below = number.below;
  int count_below = below.empty() ? 0 : below.find('*') == std::string::npos ? 1 : 2;
  // Numbers, variables and functions in their order, then sums.
  for (const bool sums : {false, true})
    for (const auto& [factor, exponent] : monomial) {
      const Factor& entry = (*this)[factor];
      if (entry.is_sum != sums) continue;
      const int k = std::abs(exponent);
      std::string piece = entry.text;
      if (entry.is_sum && exponent == 1 && monomial.size() == 1 && coefficient == 1.0)
        return piece.substr(1, piece.size() - 2);
      if (k > 1) piece += "^" + std::to_string(k);
      std::string& side = exponent > 0 ? above : below;
      side += (side.empty() ? "" : "*") + piece;
      if (exponent < 0) ++count_below;
    }
  if (above.empty()) above = "1";
  if (below.empty()) return above;
  return above + "/" + (count_below > 1 ? "(" + below + ")" : below);
}

}  // namespace courant
