#include "courant/core/simplified.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "courant/core/factor_table.hpp"
#include "courant/core/polynomial_quotient.hpp"
#include "courant/core/polynomial_relations.hpp"
#include "courant/core/subgraph.hpp"
#include "courant/core/written_number.hpp"

namespace courant {
namespace {

// The expression is too large to be written by hand.
struct TooLarge {};

// Factors by their number in the table of a Simplifier.
using Sum = Polynomial;

Monomial power(Monomial a, int k) {
  if (k == 0) return {};
  for (auto& [factor, exponent] : a) exponent *= k;
  return a;
}

// How a sum is brought to a form: products of sums multiplied out or not, relations applied where
// they make it shorter, or always, to the first or to the last of their factors, and fractions added
// to one fraction or not.
struct Style {
  bool expand = true;
  enum class Relations { where_shorter, first, last } relations = Relations::where_shorter;
  bool add_fractions = false;
};

class Simplifier {
 public:
  Simplifier(const Simplification& given, Style style)
      : expand_(style.expand), adds_fractions_(style.add_fractions) {
    expand_ = true;
    for (const Expr& relation : given.relations) relations_.push_back(of(relation));
    if (style.relations != Style::Relations::where_shorter)
      remainders_.emplace(relations_,
                          MonomialOrder{.backwards = style.relations == Style::Relations::last});
    else
      for (const Expr& constraint : given.constraints) relations_.push_back(of(constraint));
    expand_ = style.expand;
    known_.clear();
  }

  Sum of(const Expr& a) {
    if (a.is_constant()) return number(a.value());
    const Subgraph part(ExprVector::Constant(1, a));
    for (const std::uint32_t node : part.nodes())
      if (!known_.contains(node)) known_.emplace(node, value(a.graph(), node));
    return known_.at(a.node());
  }

  // Without the largest monomial that can be taken out of all terms; the coefficient of that and of
  // the leading term goes to `content`.
  std::pair<Monomial, double> take_out_content(Sum& sum) const {
    if (sum.empty()) return {{}, 1.0};
    Monomial common = sum.begin()->first;
    for (const auto& [monomial, c] : sum) {
      std::map<int, int> powers(monomial.begin(), monomial.end());
      Monomial least;
      for (const auto& [factor, exponent] : common) {
        const auto found = powers.find(factor);
        const int other = found == powers.end() ? 0 : found->second;
        if (const int both = std::min(exponent, other); both != 0) least.emplace_back(factor, both);
        if (found != powers.end()) powers.erase(found);
      }
      for (const auto& [factor, exponent] : powers)
        if (exponent < 0) least.emplace_back(factor, exponent);
      std::sort(least.begin(), least.end());
      common = least;
    }
    const double lead = content(sum);
    Sum rest;
    for (const auto& [monomial, c] : sum) rest[product(monomial, common, -1)] = c / lead;
    sum = rest;
    return {common, lead};
  }

  std::string text(const Sum& sum) const {
    try {
      return factors_.text(sum);
    } catch (const std::length_error&) {
      throw TooLarge();
    }
  }

  // Written with a common factor in front, where there is one.
  Sum factored(Sum sum) {
    if (sum.size() < 2) return sum;
    const auto [common, c] = take_out_content(sum);
    if (sum.size() == 1) return {{product(common, sum.begin()->first), c * sum.begin()->second}};
    return {{normal(product(common, {{atom(sum), 1}})), c}};
  }

  // Terms over the same sums put together: (x - y)/(x^2 + y^2) + ...
  Sum collected(const Sum& sum) {
    std::map<Monomial, Sum> over;
    for (const auto& [monomial, c] : sum) {
      Monomial below;
      for (const auto& [factor, exponent] : monomial)
        if (exponent < 0 && factors_[factor].is_sum) below.emplace_back(factor, exponent);
      over[below][product(monomial, below, -1)] = c;
    }
    Sum result;
    for (const auto& [below, above] : over) {
      if (below.empty()) {
        for (const auto& [monomial, c] : above) add(result, monomial, c);
        continue;
      }
      const auto [monomial, c] = as_factor(above);
      add(result, normal(product(monomial, below)), c);
    }
    return result;
  }

  // One fraction: all terms over what stands below any of them, as a product of sums; those that
  // divide what stands above are divided out.
  Sum as_fraction(const Sum& sum) {
    std::map<int, int> powers;
    for (const auto& [monomial, c] : sum)
      for (const auto& [factor, exponent] : monomial)
        if (exponent < 0) powers[factor] = std::max(powers[factor], -exponent);
    if (powers.empty()) return sum;
    const Monomial below(powers.begin(), powers.end());
    Sum above;
    for (const auto& [monomial, c] : sum) {
      Sum term = {{Monomial{}, c}};
      for (const auto& [factor, exponent] : product(monomial, below)) {
        const FactorTable::Factor& entry = factors_[factor];
        if (!entry.is_sum)
          term = times(term, {{{{factor, exponent}}, 1.0}});
        else
          for (int i = 0; i < exponent; ++i) term = times(term, entry.sum);
      }
      above = plus(above, term);
    }
    for (auto& [factor, exponent] : powers) {
      const FactorTable::Factor& entry = factors_[factor];
      while (entry.is_sum && exponent > 0) {
        const std::optional<Sum> fewer = courant::quotient(above, entry.sum, circles_);
        if (!fewer) break;
        above = *fewer;
        --exponent;
      }
    }
    std::erase_if(powers, [](const auto& entry) { return entry.second == 0; });
    const auto [monomial, c] = as_factor(with_sines(above, circles_));
    if (c == 0.0) return {};
    return opened({{normal(product(monomial, {powers.begin(), powers.end()}, -1)), c}});
  }

  // Positive powers of the common factor stay: where they vanish, the equation holds.
  Sum equation(Sum sum) {
    const auto [common, c] = take_out_content(sum);
    sum = scaled(sum, c);
    Monomial above;
    for (const auto& [factor, exponent] : common)
      if (exponent > 0) above.emplace_back(factor, exponent);
    Sum result;
    for (const auto& [monomial, coefficient] : sum) result[product(monomial, above)] = coefficient;
    return result;
  }

  bool adds_fractions() const { return adds_fractions_; }

  double leading(const Sum& sum) const {
    return sum.empty() ? 1.0 : factors_.in_descending_order(sum).front().second;
  }

  static Sum scaled(Sum sum, double factor) {
    for (auto& [monomial, c] : sum) c *= factor;
    return sum;
  }

 private:
  static Sum number(double value) { return value == 0.0 ? Sum{} : Sum{{Monomial{}, value}}; }

  int atom(const Sum& sum) {
    return factors_.number({.text = "(" + text(sum) + ")", .sum = sum, .is_sum = true});
  }

  // The coefficient of the leading term, the smallest or the largest one, with the sign of the leading
  // one: that which leaves the shortest numbers.
  double content(const Sum& sum) const {
    const double lead = factors_.in_order(sum).front().second;
    double smallest = lead, largest = lead;
    for (const auto& [monomial, c] : sum) {
      if (std::fabs(c) < std::fabs(smallest)) smallest = std::copysign(c, lead);
      if (std::fabs(c) > std::fabs(largest)) largest = std::copysign(c, lead);
    }
    const auto letters = [&](double content) {
      std::size_t count = 0;
      for (const auto& [monomial, c] : sum) {
        const WrittenNumber number = written_number(std::fabs(c / content));
        count += number.above.size() + number.below.size() + (number.below.empty() ? 0 : 1);
      }
      return count;
    };
    double best = lead;
    std::size_t fewest = letters(lead);
    for (const double other : {smallest, largest}) {
      if (other == lead) continue;
      if (const std::size_t count = letters(other); count < fewest) {
        fewest = count;
        best = other;
      }
    }
    return best;
  }

  // Roots to an even power become what is under them.
  Monomial normal(Monomial monomial) {
    for (std::size_t i = 0; i < monomial.size(); ++i) {
      const auto [factor, exponent] = monomial[i];
      const FactorTable::Factor& entry = factors_[factor];
      if (!entry.is_root || std::abs(exponent) < 2) continue;
      const int pairs = exponent / 2, left = exponent - 2 * pairs;
      Sum under = entry.sum;
      const auto [common, c] = take_out_content(under);
      if (c != 1.0 || !common.empty()) continue;  // as it stands
      monomial.erase(monomial.begin() + static_cast<std::ptrdiff_t>(i));
      if (left != 0) monomial = product(monomial, {{factor, left}});
      const Monomial inside = under.size() == 1 ? under.begin()->first : Monomial{{atom(under), 1}};
      return normal(product(monomial, power(inside, pairs)));
    }
    return monomial;
  }

  void count(std::size_t terms = 1) const {
    const std::size_t most = adds_fractions_ ? 100'000 : 10'000;  // some milliseconds
    if ((work_ += terms) > most) throw TooLarge();
  }

  void add(Sum& sum, const Monomial& monomial, double c) {
    count();
    const auto [at, is_new] = sum.emplace(monomial, c);
    if (is_new) return;
    const double size = std::max(std::fabs(at->second), std::fabs(c));
    at->second += c;
    if (std::fabs(at->second) <= 1e-14 * size) sum.erase(at);
  }

  // What relations and sin² + cos² = 1 make of it.
  Sum reduced(Sum sum) {
    if (remainders_) sum = remainders_->remainder(std::move(sum));
    if (sum.size() > (adds_fractions_ ? 400u : 100u)) throw TooLarge();
    if (adds_fractions_) sum = in_cosines(std::move(sum), circles_);
    const std::size_t relations = remainders_ ? 0 : relations_.size();
    count(sum.size() * (1 + relations + circles_.size()));
    bool changed = true;
    while (changed) {
      changed = false;
      for (std::size_t i = 0; i < relations; ++i)
        if (apply(relations_[i], sum)) changed = true;
      for (const auto& [sine, cosine] : circles_) {
        const Sum circle{{{{sine, 2}}, 1.0}, {{{cosine, 2}}, 1.0}, {Monomial{}, -1.0}};
        if (apply(circle, sum)) changed = true;
      }
    }
    return sum;
  }

  // Replaces one multiple of the terms of a relation by that of its constant.
  bool apply(const Sum& relation, Sum& sum) {
    const auto lead = std::find_if(relation.begin(), relation.end(),
                                   [](const auto& term) { return !term.first.empty(); });
    if (lead == relation.end()) return false;
    for (const auto& [monomial, c] : sum) {
      const Monomial multiplier = product(monomial, lead->first, -1);
      // The lead must divide the monomial.
      bool divides = true;
      for (const auto& [factor, exponent] : lead->first) {
        const auto found = std::find_if(monomial.begin(), monomial.end(),
                                        [f = factor](const auto& e) { return e.first == f; });
        divides = divides && found != monomial.end() && found->second >= exponent;
      }
      if (!divides) continue;
      const double scale = c / lead->second;
      bool all = true;
      for (const auto& [term, coefficient] : relation) {
        if (term.empty()) continue;
        const auto found = sum.find(product(multiplier, term));
        all = all && found != sum.end() && is_same_number(found->second, scale * coefficient);
      }
      if (!all) continue;
      for (const auto& [term, coefficient] : relation) {
        if (term.empty())
          add(sum, multiplier, -scale * coefficient);
        else
          sum.erase(product(multiplier, term));
      }
      return true;
    }
    return false;
  }

  Sum plus(const Sum& a, const Sum& b, double sign = 1.0) {
    Sum result = a;
    for (const auto& [monomial, c] : b) add(result, monomial, sign * c);
    return reduced(std::move(result));
  }

  // As one monomial and a number.
  std::pair<Monomial, double> as_factor(const Sum& sum) {
    const Sum one = factored(sum);
    if (one.empty()) return {{}, 0.0};
    return *one.begin();
  }

  Sum times(const Sum& a, const Sum& b) {
    const std::size_t terms = a.size() * b.size(), most_terms = adds_fractions_ ? 400 : 48;
    const bool distribute = a.size() <= 1 || b.size() <= 1 ? expand_ || is_number(a) || is_number(b)
                                                           : expand_ && terms <= most_terms;
    if (!distribute && terms > 0) {
      const auto [of_a, c] = as_factor(a);
      const auto [of_b, d] = as_factor(b);
      return opened({{normal(product(of_a, of_b)), c * d}});
    }
    Sum result;
    for (const auto& [of_a, c] : a)
      for (const auto& [of_b, d] : b) add(result, normal(product(of_a, of_b)), c * d);
    return reduced(std::move(result));
  }

  static bool is_number(const Sum& sum) {
    return sum.empty() || (sum.size() == 1 && sum.begin()->first.empty());
  }

  // A number times one sum is that sum.
  Sum opened(const Sum& sum) {
    if (sum.size() != 1) return sum;
    const auto& [monomial, c] = *sum.begin();
    if (monomial.size() != 1 || monomial[0].second != 1) return sum;
    const FactorTable::Factor& entry = factors_[monomial[0].first];
    return entry.is_sum ? scaled(entry.sum, c) : sum;
  }

  Sum to_power(const Sum& sum, int k) {
    if (k == 0) return number(1.0);
    if (sum.empty()) {
      if (k < 0) throw TooLarge();  // 1/0
      return sum;
    }
    if (k > 1 && sum.size() > 1 && expand_ && sum.size() <= 4 && k <= 3) {
      Sum result = sum;
      for (int i = 1; i < k; ++i) result = times(result, sum);
      return result;
    }
    const auto [monomial, c] = as_factor(adds_fractions_ && k < 0 ? as_fraction(sum) : sum);
    if (c == 0.0) throw TooLarge();  // 1/0
    return opened({{normal(power(monomial, k)), std::pow(c, k)}});
  }

  Sum call(const std::string& name, std::initializer_list<const Sum*> arguments) {
    std::string inside;
    for (const Sum* argument : arguments) inside += (inside.empty() ? "" : ", ") + text(*argument);
    return {{{{factors_.number({.text = name + "(" + inside + ")"}), 1}}, 1.0}};
  }

  Sum value(const Graph& graph, std::uint32_t index) {
    const Node& node = graph.node(index);
    const auto operand = [&](std::uint32_t i) -> const Sum& { return known_.at(i); };
    static const std::map<Op, const char*> functions = {
        {Op::exp, "exp"},   {Op::log, "log"},   {Op::tan, "tan"},   {Op::asin, "asin"},
        {Op::acos, "acos"}, {Op::atan, "atan"}, {Op::sinh, "sinh"}, {Op::cosh, "cosh"},
        {Op::tanh, "tanh"}, {Op::abs, "abs"},   {Op::sign, "sign"}, {Op::atan2, "atan2"},
        {Op::min, "min"},   {Op::max, "max"}};
    if (const auto function = functions.find(node.op); function != functions.end())
      return arity(node.op) == 1 ? call(function->second, {&operand(node.a)})
                                 : call(function->second, {&operand(node.a), &operand(node.b)});
    switch (node.op) {
      case Op::constant:
        return number(graph.constant(index));
      case Op::variable:
        return {{{{factors_.number({.text = graph.name(index), .variable = index}), 1}}, 1.0}};
      case Op::negate:
        return scaled(operand(node.a), -1.0);
      case Op::add:
        return plus(operand(node.a), operand(node.b));
      case Op::subtract:
        return plus(operand(node.a), operand(node.b), -1.0);
      case Op::multiply:
        return times(operand(node.a), operand(node.b));
      case Op::divide:
        return times(operand(node.a), to_power(operand(node.b), -1));
      case Op::power:
        return to_power(operand(node.a), node.k);
      case Op::sqrt: {
        const Sum& under = operand(node.a);
        const std::string name = "sqrt(" + text(under) + ")";
        return {{{{factors_.number({.text = name, .sum = under, .is_root = true}), 1}}, 1.0}};
      }
      case Op::sin:
      case Op::cos: {
        const Sum &a = operand(node.a), sine = call("sin", {&a}), cosine = call("cos", {&a});
        circles_.emplace(sine.begin()->first[0].first, cosine.begin()->first[0].first);
        return node.op == Op::sin ? sine : cosine;
      }
      case Op::pow: {
        const std::string base = text(operand(node.a)), exponent = text(operand(node.b));
        return {{{{factors_.number({.text = "(" + base + ")^(" + exponent + ")"}), 1}}, 1.0}};
      }
      default: {  // conditions, and what only the library writes
        const std::string as_it_is = to_string(graph.expression(index), 200);
        return {{{{factors_.number({.text = "(" + as_it_is + ")"}), 1}}, 1.0}};
      }
    }
  }

  bool expand_, adds_fractions_;
  mutable std::size_t work_ = 0;
  FactorTable factors_;
  Circles circles_;
  std::vector<Sum> relations_;
  std::optional<PolynomialRelations> remainders_;
  std::unordered_map<std::uint32_t, Sum> known_;
};

// Of the texts that all styles give, the shortest.
template <class Texts>
std::optional<std::string> shortest(const Simplification& given, const Texts& texts) {
  std::optional<std::string> best;
  using enum Style::Relations;
  std::vector<Style> styles = {
      {.expand = true}, {.expand = false}, {.expand = true, .add_fractions = true}};
  if (!given.relations.empty())
    for (const Style::Relations relations : {first, last}) styles.push_back({true, relations});
  for (const Style& style : styles) {
    try {
      Simplifier simplifier(given, style);
      for (const std::string& text : texts(simplifier))
        if (!best || text.size() < best->size()) best = text;
    } catch (const TooLarge&) {
      continue;
    } catch (const std::length_error&) {
      continue;
    }
  }
  return best;
}

}  // namespace

std::optional<std::string> simplified(const Expr& a, const Simplification& given) {
  return shortest(given, [&](Simplifier& simplifier) {
    const Sum sum = simplifier.of(a);
    const Sum collected = simplifier.collected(sum);
    std::vector<std::string> found = {simplifier.text(collected)};
    try {
      found.push_back(simplifier.text(sum));
      found.push_back(simplifier.text(simplifier.factored(sum)));
      if (simplifier.adds_fractions())
        found.push_back(simplifier.text(simplifier.as_fraction(sum)));
    } catch (const TooLarge&) {  // the first one will do
    }
    return found;
  });
}

std::optional<std::string> simplified_equation(const Expr& a, const Simplification& given) {
  return shortest(given, [&](Simplifier& simplifier) {
    const Sum sum = simplifier.equation(simplifier.of(a));
    const double c = simplifier.leading(sum);
    return std::vector<std::string>{simplifier.text(Simplifier::scaled(sum, c < 0.0 ? -1.0 : 1.0)),
                                    simplifier.text(Simplifier::scaled(sum, 1.0 / c))};
  });
}

}  // namespace courant
