#include "courant/core/algebra/normal_form.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <stdexcept>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "courant/core/algebra/polynomial_factors.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/subgraph.hpp"

namespace courant {
namespace {

constexpr std::size_t most_terms = 100, most_terms_between = 1000;
constexpr int highest_power = 8;

// Coefficients that cancel leave round-off: 1e-13 of what was added is zero.
void add_multiple(Polynomial& sum, const Polynomial& other, double factor) {
  for (const auto& [monomial, c] : other) {
    const auto [at, is_new] = sum.emplace(monomial, factor * c);
    if (is_new) continue;
    const double size = std::max(std::fabs(at->second), std::fabs(factor * c));
    at->second += factor * c;
    if (std::fabs(at->second) <= 1e-13 * size) sum.erase(at);
  }
}

Polynomial expanded(const Polynomial& a, const Polynomial& b) {
  Polynomial result;
  for (const auto& [of_a, c] : a)
    for (const auto& [of_b, d] : b) add_multiple(result, {{product(of_a, of_b), c * d}}, 1.0);
  if (result.size() > most_terms_between)
    throw std::length_error("NormalForm: a product has too many terms.");
  return result;
}

// Times the denominators.
Polynomial without_denominators(const Polynomial& polynomial) {
  std::map<int, int> below;
  for (const auto& [monomial, c] : polynomial)
    for (const auto& [factor, power] : monomial)
      if (power < 0) below[factor] = std::max(below[factor], -power);
  const Monomial multiplier(below.begin(), below.end());
  Polynomial result;
  for (const auto& [monomial, c] : polynomial) result.emplace(product(monomial, multiplier), c);
  return result;
}

// How many terms, of which degree, in which variables.
using FactorOrder = std::tuple<std::size_t, int, std::vector<int>>;

FactorOrder order_of(const Polynomial& factor) {
  int degree = 0;
  std::set<int> variables;
  for (const auto& [monomial, c] : factor) {
    degree = std::max(degree, total_degree(monomial));
    for (const auto& [variable, power] : monomial) variables.insert(variable);
  }
  return {factor.size(), degree, {variables.begin(), variables.end()}};
}

}  // namespace

NormalForm::NormalForm(const ExprVector& variables, const std::vector<Expr>& relations) {
  for (const Expr& variable : variables) {
    const auto number = static_cast<int>(factors_.size());
    numbers_.emplace(variable.node(), number);
    factors_.emplace(number, variable);
  }
  for (const Expr& relation : relations) {
    try {
      given_.push_back(without_denominators(polynomial(relation)));
    } catch (const std::length_error&) {
      continue;
    }
  }
  // What roots are.
  const std::map<int, Expr> found = factors_;
  for (const auto& [number, root] : found) {
    const Node& node = root.graph().node(root.node());
    if (number >= 0 || node.op != Op::sqrt) continue;
    Polynomial square = {{{{number, 2}}, 1.0}};
    add_multiple(square, known_.at(node.a), -1.0);
    given_.push_back(without_denominators(square));
  }
  relations_.emplace(given_);
  known_.clear();
}

Expr NormalForm::operator()(const Expr& a) {
  if (a.is_constant()) return a;
  try {
    return expression(polynomial(a));
  } catch (const std::length_error&) {
    return a;
  }
}

Expr NormalForm::without_factors(const Expr& a,
                                 const std::function<bool(const Expr&)>& may_divide) {
  if (a.is_constant()) return a;
  try {
    const Polynomial& whole = polynomial(a);
    if (whole.empty()) return a;
    Monomial common = whole.begin()->first;
    for (const auto& [monomial, c] : whole)
      common = combined(common, monomial, [](int of_common, int of_term) {
        return std::max(0, std::min(of_common, of_term));
      });
    Monomial factors;
    for (const auto& power : common)
      if (may_divide(factors_.at(power.first))) factors.push_back(power);
    if (factors.empty()) return a;
    Polynomial rest;
    for (const auto& [monomial, c] : whole) rest.emplace(product(monomial, factors, -1), c);
    return expression(rest);
  } catch (const std::length_error&) {
    return a;
  }
}

std::vector<Expr> NormalForm::factors(const Expr& a) {
  // With what they are ordered by: what is no polynomial of few terms comes last.
  std::vector<std::pair<FactorOrder, Expr>> found;
  std::vector<Expr> left = {a};
  std::unordered_set<std::uint32_t> visited;
  const auto add = [&](const Expr& factor, FactorOrder order) {
    const bool is_known =
        std::ranges::any_of(found, [&](const auto& one) { return one.second == factor; });
    if (!is_known) found.emplace_back(std::move(order), factor);
  };
  const auto look_at = [&](const Graph& graph, std::initializer_list<std::uint32_t> operands) {
    for (const std::uint32_t operand : operands) left.push_back(graph.expression(operand));
  };
  while (!left.empty()) {
    const Expr next = left.back();
    left.pop_back();
    if (next.is_constant(0.0)) return {};
    if (next.is_constant() || !visited.insert(next.node()).second) continue;
    const Graph& graph = next.graph();
    const Node& node = graph.node(next.node());
    switch (node.op) {
      case Op::multiply:
        look_at(graph, {node.b, node.a});
        continue;
      case Op::negate:
      case Op::divide:
      case Op::sqrt:
      case Op::abs:
      case Op::sinh:
        look_at(graph, {node.a});
        continue;
      case Op::power:
        if (node.k > 0) look_at(graph, {node.a});
        continue;
      case Op::exp:
      case Op::cosh:
        continue;
      default:
        break;
    }
    try {
      const Polynomial whole = without_denominators(polynomial(next));
      if (whole.empty()) return {};
      const std::vector<Polynomial> parts = polynomial_factors(whole);
      for (const Polynomial& part : parts) {
        if (has_one_sign(part)) continue;
        const Expr factor = expression(part);
        const bool is_alone = part.size() == 1 && factors_.contains(part.begin()->first[0].first) &&
                              part.begin()->first[0].first < 0 && !(factor == next);
        if (is_alone)
          left.push_back(factor);  // no variable: it may be a power of e
        else
          add(factor, order_of(part));
      }
    } catch (const std::length_error&) {
      add(next, {most_terms_between, 0, {}});
    }
  }
  std::ranges::stable_sort(found, {}, [](const auto& one) { return one.first; });
  std::vector<Expr> factors;
  for (const auto& [order, factor] : found) factors.push_back(factor);
  return factors;
}

std::vector<Expr> NormalForm::basis() const {
  std::vector<Expr> all;
  for (const Polynomial& element : relations_->basis()) all.push_back(expression(element));
  return all;
}

std::vector<Expr> NormalForm::eliminated(const std::vector<Expr>& equations,
                                         const ExprVector& unknowns) {
  if (unknowns.size() == 0) return {};
  std::vector<Polynomial> all = given_;
  try {
    for (const Expr& equation : equations)
      all.push_back(without_denominators(polynomial(equation)));
  } catch (const std::length_error&) {
    return {};
  }
  for (const auto& [number, entry] : factors_)
    if (number < 0 && depends(ExprVector::Constant(1, entry), unknowns)) return {};
  const int first = numbers_.at(unknowns[0].node());
  const PolynomialRelations basis(
      all, {.eliminated_from = first, .eliminated_to = first + static_cast<int>(unknowns.size())});
  std::vector<Expr> result;
  for (const Polynomial& element : basis.basis())
    if (const Polynomial rest = relations_->remainder(element); !rest.empty())
      result.push_back(expression(element));
  return result;
}

std::vector<Expr> NormalForm::consequences(const std::vector<Expr>& equations,
                                           const ExprVector& unknowns) {
  if (unknowns.size() == 0) return {};
  std::vector<Polynomial> all = given_;
  std::map<int, int> eliminated;  // roots and reciprocals by the numbers that they have here
  int next = factors_.rbegin()->first + 1;
  try {
    for (const Expr& equation : equations) all.push_back(polynomial(equation));
    const std::map<int, Expr> found = factors_;
    for (const auto& [number, entry] : found) {
      if (number >= 0) break;
      if (!depends(ExprVector::Constant(1, entry), unknowns)) continue;
      eliminated.emplace(number, next++);
      const Node& node = entry.graph().node(entry.node());
      if (node.op == Op::sqrt) {  // r² = a
        all.push_back({{{{number, 2}}, 1.0}});
        add_multiple(all.back(), polynomial(entry.graph().expression(node.a)), -1.0);
      } else if (node.op == Op::divide && entry.graph().expression(node.a).is_constant(1.0)) {
        all.push_back(
            expanded(polynomial(entry.graph().expression(node.b)), {{{{number, 1}}, 1.0}}));
        add_multiple(all.back(), {{Monomial{}, 1.0}}, -1.0);
      } else {
        return {};
      }
    }
  } catch (const std::length_error&) {
    return {};
  }
  // What stands below has a reciprocal, so that it is not 0: u r = 1.
  std::map<int, int> reciprocals;
  for (Polynomial& one : all) {
    for (const auto& [monomial, c] : one)
      for (const auto& [below, power] : monomial)
        if (power < 0 && !reciprocals.contains(below)) reciprocals.emplace(below, next++);
    one = without_denominators(one);
  }
  for (const auto& [below, reciprocal] : reciprocals)
    all.push_back({{{{below, 1}, {reciprocal, 1}}, 1.0}, {Monomial{}, -1.0}});
  for (Polynomial& one : all) {
    Polynomial renumbered;
    for (const auto& [monomial, c] : one) {
      Monomial with;
      for (const auto& [number, power] : monomial) {
        const auto other = eliminated.find(number);
        with.emplace_back(other == eliminated.end() ? number : other->second, power);
      }
      std::ranges::sort(with);
      renumbered.emplace(std::move(with), c);
    }
    one = std::move(renumbered);
  }
  const int first = numbers_.at(unknowns[0].node());
  const PolynomialRelations basis(all, {.eliminated_from = first, .eliminated_to = next});
  std::vector<Expr> result;
  for (const Polynomial& element : basis.basis()) {
    const bool is_free = std::ranges::all_of(element, [&](const auto& term) {
      return std::ranges::all_of(term.first,
                                 [&](const auto& power) { return power.first < first; });
    });
    if (is_free && !relations_->remainder(element).empty()) result.push_back(expression(element));
  }
  return result;
}

// What is no polynomial of others comes before all variables.
int NormalForm::factor(const Expr& a) {
  const int next = std::min(0, factors_.empty() ? 0 : factors_.begin()->first) - 1;
  const auto [at, is_new] = numbers_.emplace(a.node(), next);
  if (is_new) factors_.emplace(next, a);
  return at->second;
}

// Operands come before results, so that nothing recurses.
const Polynomial& NormalForm::polynomial(const Expr& a) {
  const Subgraph part(ExprVector::Constant(1, a));
  for (const std::uint32_t node : part.nodes())
    if (!known_.contains(node)) known_.emplace(node, made(a.graph().expression(node)));
  return known_.at(a.node());
}

Polynomial NormalForm::made(const Expr& a) {
  if (a.is_constant())
    return a.is_constant(0.0) ? Polynomial{} : Polynomial{{Monomial{}, a.value()}};
  const Graph& graph = a.graph();
  const Node& node = graph.node(a.node());
  const auto operand = [&](std::uint32_t index) -> const Polynomial& { return known_.at(index); };
  Polynomial result;
  switch (node.op) {
    case Op::negate:
      add_multiple(result, operand(node.a), -1.0);
      break;
    case Op::add:
    case Op::subtract:
      result = operand(node.a);
      add_multiple(result, operand(node.b), node.op == Op::add ? 1.0 : -1.0);
      break;
    case Op::multiply:
      result = expanded(operand(node.a), operand(node.b));
      break;
    case Op::divide: {
      const Polynomial& below = operand(node.b);
      if (below.empty()) throw std::length_error("NormalForm: there is a division by zero.");
      if (below.size() == 1) {
        const auto& [monomial, c] = *below.begin();
        result = expanded(operand(node.a), {{product({}, monomial, -1), 1.0 / c}});
      } else {
        result = expanded(operand(node.a), {{{{factor(1.0 / expression(below)), 1}}, 1.0}});
      }
      break;
    }
    case Op::power:
      if (node.k >= 0 && node.k <= highest_power) {
        result = {{Monomial{}, 1.0}};
        for (int i = 0; i < node.k; ++i) result = expanded(result, operand(node.a));
        break;
      }
      [[fallthrough]];
    default: {
      const auto variable = numbers_.find(a.node());
      result = {{{{variable != numbers_.end() ? variable->second : factor(a), 1}}, 1.0}};
    }
  }
  if (relations_) result = relations_->remainder(std::move(result));
  if (result.size() > most_terms)
    throw std::length_error("NormalForm: a remainder has too many terms.");
  return result;
}

Expr NormalForm::expression(const Polynomial& polynomial) const {
  Expr sum = 0.0;
  for (const auto& [monomial, c] : polynomial) {
    Expr term = 1.0;
    for (const auto& [number, power] : monomial) term = term * pow(factors_.at(number), power);
    sum = sum + c * term;
  }
  return sum;
}

}  // namespace courant
