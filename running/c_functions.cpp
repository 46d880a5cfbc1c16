#include "courant/running/c_functions.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "courant/core/expressions/c_prelude.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/matrix_numbers.hpp"
#include "courant/core/expressions/program.hpp"
#include "courant/core/linear/lu_decomposition.hpp"
#include "courant/core/solve/exponentials.hpp"
#include "courant/core/words/message.hpp"

namespace courant {
namespace {

constexpr Index kMostSize = LuDecomposition::kPlain;

// A compiler takes a minute for as many.
constexpr Index kMostInstructions = 300'000;

std::vector<ExprVector> variables_of(const std::vector<Function::Input>& inputs) {
  std::vector<ExprVector> groups;
  for (const Function::Input& input : inputs) groups.push_back(input.variables);
  return groups;
}

std::string inputs_text(const std::vector<Function::Input>& inputs) {
  std::string text;
  for (std::size_t g = 0; g < inputs.size(); ++g)
    if (inputs[g].variables.size() > 0)
      text += (text.empty() ? "" : ", ") + ("in[" + std::to_string(g) + "] = ") + inputs[g].name;
  return text;
}

std::vector<Index> range(Index count) {
  std::vector<Index> all(static_cast<std::size_t>(count));
  for (Index i = 0; i < count; ++i) all[static_cast<std::size_t>(i)] = i;
  return all;
}

template <class Numbers, class Text>
std::string braces(const Numbers& numbers, const Text& text) {
  std::string result;
  std::size_t line = 0;
  for (const auto number : numbers) {
    result += result.empty() ? "" : ", ";
    if (result.size() - line > 90) {
      result += "\n  ";
      line = result.size();
    }
    result += text(number);
  }
  return "{" + (result.empty() ? "0" : result) + "}";
}

}  // namespace

void CFunctions::add(const std::string& symbol, const std::vector<Function::Input>& inputs,
                     const ExprVector& outputs, const std::string& comment) {
  const Program program(variables_of(inputs), outputs);
  if (program.instruction_count() > kMostInstructions)
    throw std::invalid_argument("has a formula of " + std::to_string(program.instruction_count()) +
                                " operations, which takes a compiler hours; expected at most " +
                                std::to_string(kMostInstructions));
  source_ += "/* " + c_comment(comment) + ";  " + inputs_text(inputs) + " */\n" +
             program.c_source(symbol) + "\n";
}

void CFunctions::add_zeros(const std::string& symbol, const Function::Formulas& of,
                           const std::string& comment) {
  const SparseExprMatrix jacobian = courant::jacobian(of.outputs, of.inputs[0].variables);
  add(symbol + "_residual", of.inputs, of.outputs, comment);
  add(symbol + "_jacobian", of.inputs, joined(of.outputs, jacobian.values),
      "the same, then the entries of their Jacobian");
  const auto array = [&](const char* name, const std::vector<Index>& numbers) {
    source_ += "static const int " + symbol + "_" + name + "[] = " + c_array(numbers) + ";\n";
  };
  array("row", jacobian.row);
  array("column", jacobian.col);
  source_ +=
      "enum { " + symbol + "_entries = " + std::to_string(jacobian.values.size()) + " };\n\n";
}

CFunctions::Unknowns CFunctions::add(const Equations& of) {
  const ExprVector& y = of.inputs[0].variables;
  std::vector<Index> kept = range(y.size());
  ExprVector equations = of.equations, unknowns = y;
  if (of.elimination) {
    Elimination elimination(of.equations, y, *of.elimination);
    kept = elimination.kept;
    equations = elimination.equations;
    unknowns = elimination.unknowns;
  }
  const bool is_reduced = std::ssize(kept) < y.size();
  std::vector<Function::Input> inputs = of.inputs;
  inputs[0].variables = ExprVector(y(kept));
  const SparseExprMatrix jacobian = courant::jacobian(equations, inputs[0].variables);
  std::vector<Index> contained = jacobian.col;
  std::sort(contained.begin(), contained.end());
  contained.erase(std::unique(contained.begin(), contained.end()), contained.end());
  const Index size = equations.size();
  if (size != std::ssize(contained))
    throw std::invalid_argument("has " + std::to_string(size) + " equations for " +
                                std::to_string(contained.size()) +
                                " unknowns, solved by least squares; expected as many");
  if (size > kMostSize)
    throw std::invalid_argument("solves " + std::to_string(size) +
                                " equations together; expected at most " +
                                std::to_string(kMostSize) + " in a program in C");
  ExprVector all(size + jacobian.values.size());
  all << equations, jacobian.values;
  add(of.symbol + "_residual", inputs, equations, "the residuals G of these equations");
  add(of.symbol + "_jacobian", inputs, all, "G, then the entries of dG/du");
  if (is_reduced) add(of.symbol + "_unknowns", inputs, unknowns, "all unknowns y");

  const ExprVector arguments = exponential_arguments(equations, inputs[0].variables);
  if (arguments.size() > 0)
    add(of.symbol + "_arguments", inputs, arguments, "what exponentials in them are of");

  const std::optional<std::vector<Index>> matrix_of =
      MatrixNumbers(equations, jacobian.values, variables_of(inputs)).groups();
  const bool has_numbers = matrix_of && !matrix_of->empty();

  std::vector<Index> group, column;
  for (const Index place : kept) {
    Index g = 0, end = of.groups.empty() ? y.size() : of.groups[0];
    while (place >= end) end += of.groups[static_cast<std::size_t>(++g)];
    group.push_back(g);
  }
  for (const Index place : jacobian.col)
    column.push_back(std::ranges::lower_bound(contained, place) - contained.begin());
  const auto array = [&](const char* name, const std::vector<Index>& numbers) {
    source_ += "static const int " + of.symbol + "_" + name + "[] = " + c_array(numbers) + ";\n";
  };
  array("kept", kept);
  array("contained", contained);
  array("group", group);
  array("row", jacobian.row);
  array("column", jacobian.col);
  array("contained_column", column);
  if (has_numbers) array("matrix_of", *matrix_of);
  const auto number = [](Index value) { return std::to_string(value) + ", "; };
  const auto name = [&](const char* what) { return of.symbol + "_" + what; };
  source_ += "static const struct equations " + of.symbol + "_equations = {\n  " + number(size) +
             number(std::ssize(kept)) + number(std::max<Index>(1, std::ssize(of.groups))) +
             number(jacobian.values.size()) + number(arguments.size()) +
             number(matrix_of ? std::ssize(*matrix_of) : -1) + "\n  " + name("kept") + ", " +
             name("contained") + ", " + name("group") + ",\n  " + name("row") + ", " +
             name("column") + ", " + name("contained_column") + ", " +
             (has_numbers ? name("matrix_of") : "NULL") + ",\n  " + name("residual") + ", " +
             name("jacobian") + ", " + (is_reduced ? name("unknowns") : "NULL") + ", " +
             (arguments.size() == 0 ? "NULL" : name("arguments")) + "};\n\n";
  most_unknowns_ = std::max(most_unknowns_, y.size());
  most_size_ = std::max(most_size_, size);
  most_entries_ = std::max(most_entries_, jacobian.values.size());
  most_arguments_ = std::max(most_arguments_, arguments.size());
  Unknowns result;
  result.has_exponentials = arguments.size() > 0;
  for (Index k = 0; k < std::ssize(kept); ++k)
    (std::ranges::binary_search(contained, k) ? result.sought : result.left)
        .push_back(kept[static_cast<std::size_t>(k)]);
  return result;
}

std::string CFunctions::prelude() const { return c_prelude(source_); }

std::string c_number(double value) {
  if (!std::isfinite(value)) return value > 0 ? "INFINITY" : value < 0 ? "-INFINITY" : "NAN";
  std::string text = exact_text(value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string c_array(const VectorXd& numbers) { return braces(numbers, c_number); }

std::string c_array(const std::vector<Index>& numbers) {
  return braces(numbers, [](Index number) { return std::to_string(number); });
}

std::string c_define(const char* name, Index value) {
  return std::string("#define ") + name + ' ' + std::to_string(value) + '\n';
}

std::string c_state(const State& state) {
  return "{" + c_number(state.t) + ",\n  " + c_array(state.x) + ",\n  " + c_array(state.v) +
         ",\n  " + c_array(state.z) + "}";
}

std::string c_comment(std::string text) {
  text = printable(text);
  for (const char* mark : {"*/", "/*", "??"})  // ?? begins a trigraph
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark))
      text.insert(at + 1, " ");
  return text;
}

std::string c_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
    if (c == '?') result += "\"\"";  // no trigraph
  }
  return result + '"';
}

}  // namespace courant
