#include "courant/core/algebra/simplified.hpp"

#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <unordered_map>

#include "courant/core/algebra/sum_arithmetic.hpp"
#include "courant/core/expressions/function_name.hpp"
#include "courant/core/expressions/graph_parameters.hpp"
#include "courant/core/expressions/subgraph.hpp"

namespace courant {
namespace {

using Sum = Polynomial;

// How a sum is brought to a form: products of sums multiplied out or not, relations applied where
// they make it shorter, or always, to the first or to the last of their factors, and fractions added
// to one fraction or not.
struct Style {
  bool expand = true;
  enum class Relations { where_shorter, first, last } relations = Relations::where_shorter;
  bool add_fractions = false;
};

// The sums of products that expressions of one graph are, in one style.
class Simplifier {
 public:
  Simplifier(const Simplification& given, Style style)
      : arithmetic_({.expand = true, .add_fractions = style.add_fractions}),
        adds_fractions_(style.add_fractions) {
    PolynomialReduction& reduction = arithmetic_.reduction();
    for (const Expr& relation : given.relations) reduction.assume(of(relation));
    if (style.relations != Style::Relations::where_shorter)
      reduction.conclude({.backwards = style.relations == Style::Relations::last});
    else
      for (const Expr& constraint : given.constraints)
        reduction.assume(arithmetic_.equation(of(constraint)));
    arithmetic_.set_expanding(style.expand);
    known_.clear();
  }

  Sum of(const Expr& a) {
    if (a.is_constant()) return SumArithmetic::number(a.value());
    const Subgraph part(ExprVector::Constant(1, a));
    for (const std::uint32_t node : part.nodes())
      if (!known_.contains(node)) known_.emplace(node, value(a.graph(), node));
    return arithmetic_.reduction().reduced(known_.at(a.node()));
  }

  SumArithmetic& arithmetic() { return arithmetic_; }
  bool adds_fractions() const { return adds_fractions_; }

 private:
  Sum call(const std::string& name, std::initializer_list<const Sum*> arguments) {
    std::string inside;
    for (const Sum* argument : arguments)
      inside += (inside.empty() ? "" : ", ") + arithmetic_.text(*argument);
    return arithmetic_.factor({.text = name + "(" + inside + ")"});
  }

  Sum value(const Graph& graph, std::uint32_t index) {
    const Node& node = graph.node(index);
    const auto operand = [&](std::uint32_t i) -> const Sum& { return known_.at(i); };
    switch (node.op) {
      case Op::constant:
        return SumArithmetic::number(graph.constant(index));
      case Op::variable:
        return variable(graph, index);
      case Op::negate:
        return SumArithmetic::scaled(operand(node.a), -1.0);
      case Op::add:
        return arithmetic_.plus(operand(node.a), operand(node.b));
      case Op::subtract:
        return arithmetic_.minus(operand(node.a), operand(node.b));
      case Op::multiply:
        return arithmetic_.times(operand(node.a), operand(node.b));
      case Op::divide:
        return arithmetic_.times(operand(node.a), arithmetic_.to_power(operand(node.b), -1));
      case Op::power:
        return arithmetic_.to_power(operand(node.a), node.k);
      case Op::sqrt: {
        const Sum& under = operand(node.a);
        const std::string name = "sqrt(" + arithmetic_.text(under) + ")";
        return arithmetic_.factor({.text = name, .sum = under, .is_root = true});
      }
      case Op::sin:
      case Op::cos: {
        const Sum &a = operand(node.a), sine = call("sin", {&a}), cosine = call("cos", {&a});
        arithmetic_.reduction().add_circle(sine.begin()->first[0].first,
                                           cosine.begin()->first[0].first);
        return node.op == Op::sin ? sine : cosine;
      }
      case Op::pow: {
        const std::string base = arithmetic_.text(operand(node.a));
        const std::string exponent = arithmetic_.text(operand(node.b));
        return arithmetic_.factor({.text = "(" + base + ")^(" + exponent + ")"});
      }
      case Op::select:  // what only the library writes
      case Op::stumpff:
      case Op::arccos_factor:
        return as_it_is(graph, index);
      default: {
        const char* const name = function_name(node.op);
        if (name == nullptr) return as_it_is(graph, index);  // conditions
        return arity(node.op) == 1 ? call(name, {&operand(node.a)})
                                   : call(name, {&operand(node.a), &operand(node.b)});
      }
    }
  }

  Sum variable(const Graph& graph, std::uint32_t index) {
    const bool is_number = is_parameter(graph, index);
    const Sum sum = arithmetic_.factor(
        {.text = written_name(graph, index), .variable = index, .is_parameter = is_number});
    if (is_number) arithmetic_.reduction().add_parameter(sum.begin()->first[0].first);
    return sum;
  }

  Sum as_it_is(const Graph& graph, std::uint32_t index) {
    return arithmetic_.factor({.text = "(" + to_string(graph.expression(index), 200) + ")"});
  }

  SumArithmetic arithmetic_;
  bool adds_fractions_;
  std::unordered_map<std::uint32_t, Sum> known_;
};

// How long a reader takes for a text: its letters, and more for fractions like 2000/429.
std::size_t effort(const std::string& text) {
  constexpr std::size_t for_a_fraction = 6;
  std::size_t sum = text.size();
  for (std::size_t at = text.find('/'); at != std::string::npos; at = text.find('/', at + 1)) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789", at + 1), text.size());
    if (end > at + 3) sum += for_a_fraction;
  }
  return sum;
}

// An equation can be multiplied, so that it need not have fractions.
std::size_t effort_of_equation(const std::string& text) {
  return effort(text) + static_cast<std::size_t>(std::ranges::count(text, '/'));
}

// Of the texts that all styles give, the easiest to read.
template <class Texts>
std::optional<std::string> easiest(const Simplification& given, const Texts& texts,
                                   std::size_t (*effort)(const std::string&)) {
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
        if (!best || effort(text) < effort(*best)) best = text;
    } catch (const std::length_error&) {  // too large to be written by hand
      continue;
    } catch (const std::domain_error&) {  // 1/0
      continue;
    }
  }
  return best;
}

}  // namespace

std::optional<std::string> simplified(const Expr& a, const Simplification& given) {
  const auto texts = [&](Simplifier& simplifier) {
    SumArithmetic& sums = simplifier.arithmetic();
    const Sum sum = simplifier.of(a);
    std::vector<std::string> found = {sums.text(sums.collected(sum))};
    try {
      found.push_back(sums.text(sum));
      found.push_back(sums.text(sums.factored(sum)));
      if (simplifier.adds_fractions()) found.push_back(sums.text(sums.as_fraction(sum)));
    } catch (const std::length_error&) {  // the first one will do
    }
    return found;
  };
  return easiest(given, texts, effort);
}

std::optional<std::string> simplified_equation(const Expr& a, const Simplification& given) {
  const auto texts = [&](Simplifier& simplifier) {
    SumArithmetic& sums = simplifier.arithmetic();
    const Sum whole = simplifier.of(a);
    std::vector<std::string> found;
    const auto add = [&](const Sum& sum) {
      const double c = sums.leading(sum);
      for (const double factor : {c < 0.0 ? -1.0 : 1.0, 1.0 / c})
        found.push_back(sums.text(SumArithmetic::scaled(sum, factor)));
    };
    const Sum equation = sums.equation(whole);
    add(equation);
    try {
      if (const Sum divided = sums.equation(whole, true); divided != equation) add(divided);
      if (simplifier.adds_fractions()) add(sums.equation(sums.as_fraction(whole)));
    } catch (const std::length_error&) {  // the first ones will do
    }
    return found;
  };
  return easiest(given, texts, effort_of_equation);
}

}  // namespace courant
