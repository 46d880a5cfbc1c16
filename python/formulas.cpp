// From functions of Python to formulas of experiments.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "courant/core/expressions/function.hpp"
#include "courant/core/expressions/function_name.hpp"
#include "courant/core/language/formula_functions.hpp"
#include "courant/core/words/message.hpp"
#include "courant/python/conversions.hpp"

namespace courant::python {
namespace {

// How tightly a text binds.
enum Binding { kOr, kAnd, kComparison, kSum, kProduct, kNot, kPower, kAtom };

struct Text {
  std::string text;
  Binding binding = kAtom;
  bool is_condition = false;
};

// The language tells conditions from numbers; to expressions a condition is 1 or 0.
Text as_number(const Text& text) {
  return text.is_condition ? Text{"if(" + text.text + ", 1, 0)"} : text;
}

std::string at_least(const Text& operand, Binding place) {
  const Text text = as_number(operand);
  return text.binding >= place ? text.text : '(' + text.text + ')';
}

std::string condition(const Text& operand, Binding place) {
  if (operand.is_condition)
    return operand.binding >= place ? operand.text : '(' + operand.text + ')';
  const std::string text = at_least(operand, kSum) + " != 0";
  return kComparison >= place ? text : '(' + text + ')';
}

Text number(double value) {
  if (!std::isfinite(value))
    throw py::value_error("a formula has the number " + exact_text(value) +
                          " in it; expected a finite one");
  if (std::signbit(value)) return {'-' + exact_text(-value), kSum};
  return {exact_text(value)};
}

// Writes expressions as formulas that read back to the same expressions. What is long and stands in several places
// becomes a definition, so that the text is as long as the graph.
class FormulaWriter {
 public:
  // Definitions are called prefix0, prefix1, …
  FormulaWriter(const ExprVector& outputs, std::string prefix) : prefix_(std::move(prefix)) {
    for (const Expr& output : outputs)
      if (!output.is_constant()) graph_ = output.graph();
    if (!graph_.is_none()) {
      count_uses(outputs);
      for (std::uint32_t i = 0; i < uses_.size(); ++i)
        if (uses_[i] > 0) write(i);
    }
    for (const Expr& output : outputs)
      formulas_.push_back(output.is_constant() ? number(output.value()).text
                                               : as_number(texts_[output.node()]).text);
  }

  std::vector<std::pair<std::string, std::string>> definitions() const { return definitions_; }
  std::vector<std::string> formulas() const { return formulas_; }

 private:
  static constexpr std::size_t kShort = 20;  // characters that may be repeated

  void count_uses(const ExprVector& outputs) {
    std::uint32_t last = 0;
    for (const Expr& output : outputs)
      if (!output.is_constant()) last = std::max(last, output.node());
    uses_.assign(last + 1, 0);
    texts_.resize(last + 1);
    for (const Expr& output : outputs)
      if (!output.is_constant()) ++uses_[output.node()];
    for (std::uint32_t i = last + 1; i-- > 0;) {
      if (uses_[i] == 0) continue;
      const Node& node = graph_.node(i);
      const std::uint32_t operands[] = {node.a, node.b, node.c};
      for (int k = 0; k < arity(node.op); ++k) ++uses_[operands[k]];
    }
  }

  // Operands have been written: they stand before i.
  void write(std::uint32_t i) {
    const Node& node = graph_.node(i);
    Text text = written(node, i);
    if (uses_[i] > 1 && arity(node.op) > 0 && text.text.size() > kShort) {
      std::string name = prefix_ + std::to_string(definitions_.size());
      definitions_.emplace_back(name, as_number(text).text);
      text = {std::move(name), kAtom};
    }
    texts_[i] = std::move(text);
  }

  Text written(const Node& node, std::uint32_t i) const {
    const auto binary = [&](const char* sign, Binding binding, bool right_too) {
      return Text{at_least(texts_[node.a], binding) + sign +
                      at_least(texts_[node.b], right_too ? binding : Binding(binding + 1)),
                  binding};
    };
    switch (node.op) {
      case Op::constant:
        return number(graph_.constant(i));
      case Op::variable:
        return {graph_.name(i), kAtom};
      case Op::negate:
        return {'-' + at_least(texts_[node.a], kPower), kSum};
      case Op::add:
        return binary(" + ", kSum, false);
      case Op::subtract:
        return binary(" - ", kSum, false);
      case Op::multiply:
        return binary("*", kProduct, false);
      case Op::divide:
        return binary("/", kProduct, false);
      case Op::power:
        return {at_least(texts_[node.a], kAtom) + '^' +
                    (node.k < 0 ? '(' + std::to_string(node.k) + ')' : std::to_string(node.k)),
                kPower};
      case Op::pow:
        return {"pow(" + as_number(texts_[node.a]).text + ", " + as_number(texts_[node.b]).text +
                ')'};
      case Op::less:
        return comparison(node, " < ");
      case Op::less_equal:
        return comparison(node, " <= ");
      case Op::equal:
        return comparison(node, " == ");
      case Op::logical_and:
        return {condition(texts_[node.a], kAnd) + " && " + condition(texts_[node.b], kComparison),
                kAnd, true};
      case Op::logical_or:
        return {condition(texts_[node.a], kOr) + " || " + condition(texts_[node.b], kAnd), kOr,
                true};
      case Op::logical_not:
        return {"!(" + condition(texts_[node.a], kOr) + ')', kNot, true};
      case Op::select:
        return {"if(" + condition(texts_[node.a], kOr) + ", " + as_number(texts_[node.b]).text +
                ", " + as_number(texts_[node.c]).text + ')'};
      default:
        break;
    }
    const char* const name = function_name(node.op);
    if (name == nullptr || formula::find_function(name) == nullptr)
      throw py::type_error("a formula has no word for a part of the function");
    const std::uint32_t operands[] = {node.a, node.b, node.c};
    std::string text = name;
    for (int k = 0; k < arity(node.op); ++k)
      text += (k == 0 ? "(" : ", ") + as_number(texts_[operands[k]]).text;
    return {text + ')', kAtom};
  }

  Text comparison(const Node& node, const char* sign) const {
    return {at_least(texts_[node.a], kSum) + sign + at_least(texts_[node.b], kSum), kComparison,
            true};
  }

  std::string prefix_;
  Graph graph_ = Graph::none();
  std::vector<std::uint32_t> uses_;
  std::vector<Text> texts_;
  std::vector<std::pair<std::string, std::string>> definitions_;
  std::vector<std::string> formulas_;
};

// The variables that expressions depend on, by name.
std::set<std::string> variables_of(const ExprVector& outputs) {
  std::set<std::string> names;
  std::vector<bool> seen;
  std::vector<std::uint32_t> open;
  for (const Expr& output : outputs) {
    if (output.is_constant()) continue;
    const Graph& graph = output.graph();
    if (seen.size() < graph.size()) seen.resize(graph.size());
    open.push_back(output.node());
    while (!open.empty()) {
      const std::uint32_t i = open.back();
      open.pop_back();
      if (seen[i]) continue;
      seen[i] = true;
      const Node& node = graph.node(i);
      if (node.op == Op::variable) names.insert(graph.name(i));
      const std::uint32_t operands[] = {node.a, node.b, node.c};
      for (int k = 0; k < arity(node.op); ++k) open.push_back(operands[k]);
    }
  }
  return names;
}

}  // namespace

void bind_formulas(py::module_& module) {
  py::class_<Graph>(module, "Graph")
      .def(py::init<>())
      .def("variable",
           [](const Graph& graph, const std::string& name) { return graph.variable(name); })
      .def(
          "variables",
          [](const Graph& graph, const std::vector<std::string>& names,
             const std::vector<Index>& shape) {
            ExprVector all(static_cast<Index>(names.size()));
            for (std::size_t i = 0; i < names.size(); ++i)
              all[static_cast<Index>(i)] = graph.variable(names[i]);
            return traced(all, shape);
          },
          "Traced array of these variables, in row-major order.");
  module.def(
      "formulas",
      [](const py::object& outputs, const std::string& prefix) {
        const FormulaWriter writer(to_vector(outputs), prefix);
        return py::make_tuple(writer.definitions(), writer.formulas());
      },
      "(definitions, formulas) of traced outputs.");
  py::class_<Function>(module, "Function", "Variables to the numbers of traced outputs.")
      .def(py::init([](const py::object& outputs, const py::object& variables) {
        return Function("f", {{"x", to_vector(variables)}}, to_vector(outputs));
      }))
      .def("__call__", [](const Function& f, const VectorXd& at) { return f({at}); });
  module.def("variables_of",
             [](const py::object& outputs) { return variables_of(to_vector(outputs)); });
}

}  // namespace courant::python
