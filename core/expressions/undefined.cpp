#include "courant/core/expressions/undefined.hpp"

#include <cmath>
#include <unordered_map>

#include "courant/core/expressions/subgraph.hpp"
#include "courant/core/numbers/operation.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

// What is the matter with op(a, b), which is not finite.
std::string reason(Op op, std::int32_t k, double a, double b, const std::string& formula) {
  for (const double number : {a, b})
    if (!std::isfinite(number)) return "a number in it is " + number_text(number);
  const std::string function = formula.substr(0, formula.find('('));
  switch (op) {
    case Op::divide:
      if (b == 0.0) return "the divisor is 0";
      break;
    case Op::power:
      if (k < 0 && a == 0.0) return "the divisor is 0";
      break;
    case Op::pow:
      if (a < 0.0)
        return "the base of the power " + number_text(b) + " is " + number_text(a) +
               ", expected at least 0";
      if (a == 0.0 && b < 0.0) return "the divisor is 0";
      break;
    case Op::sqrt:
      return "the argument of sqrt is " + number_text(a) + ", expected at least 0";
    case Op::log:
      return "the argument of log is " + number_text(a) + ", expected more than 0";
    case Op::asin:
    case Op::acos:
      return "the argument of " + function + " is " + number_text(a) + ", expected -1 to 1";
    case Op::arccos_factor:
      return "a logarithm is of opposite points";
    default:
      break;
  }
  return "it is too large, of " + number_text(a) +
         (op == Op::add || op == Op::subtract || op == Op::multiply || op == Op::divide ||
                  op == Op::pow
              ? " and " + number_text(b)
              : std::string());
}

}  // namespace

std::optional<Undefined> find_undefined(const ExprVector& outputs, const ExprVector& variables,
                                        const VectorXd& values) {
  const Subgraph part(outputs);
  const Graph& graph = part.graph();
  std::unordered_map<std::uint32_t, double> given;
  for (Index i = 0; i < variables.size(); ++i)
    if (!variables[i].is_constant()) given[variables[i].node()] = values[i];

  std::vector<double> value(part.size());
  const auto at = [&](std::uint32_t node) {
    const Expr operand = graph.expression(node);
    return operand.is_constant() ? operand.value() : value[part.position(node)];
  };
  // The first cause below each node, or none.
  constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> cause(part.size(), none);
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Node& node = graph.node(part.nodes()[i]);
    if (node.op == Op::variable) {
      const auto found = given.find(part.nodes()[i]);
      value[i] = found == given.end() ? 0.0 : found->second;
      continue;
    }
    const std::uint32_t operands[] = {node.a, node.b, node.c};
    double arguments[3] = {0.0, 0.0, 0.0};
    bool finite = true;
    for (int k = 0; k < arity(node.op); ++k) {
      const Expr operand = graph.expression(operands[k]);
      arguments[k] = at(operands[k]);
      finite = finite && (std::isfinite(arguments[k]) || operand.is_constant());
      if (!std::isfinite(arguments[k]) && !operand.is_constant() && cause[i] == none)
        cause[i] = cause[part.position(operands[k])];
    }
    value[i] = evaluate(node.op, node.k, arguments[0], arguments[1], arguments[2]);
    if (!std::isfinite(value[i]) && finite) cause[i] = i;
  }
  for (Index output = 0; output < outputs.size(); ++output) {
    if (outputs[output].is_constant()) {
      const double number = outputs[output].value();
      if (!std::isfinite(number))
        return Undefined{output, number_text(number), "it is " + number_text(number)};
      continue;
    }
    const std::size_t i = part.position(outputs[output]);
    if (std::isfinite(value[i]) || cause[i] == none) continue;
    const std::uint32_t number = part.nodes()[cause[i]];
    const Node& node = graph.node(number);
    const std::string formula = to_string(graph.expression(number), 60);
    return Undefined{
        output, formula,
        reason(node.op, node.k, at(node.a), arity(node.op) > 1 ? at(node.b) : 0.0, formula)};
  }
  return std::nullopt;
}

}  // namespace courant
