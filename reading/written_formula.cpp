#include "courant/reading/written_formula.hpp"

#include <cmath>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

constexpr const char* kFormula = "a formula or a number";

// Each part that can be read; nothing as soon as one cannot.
std::optional<WrittenFormulas> read_row(const std::vector<JsonReader>& row) {
  WrittenFormulas formulas{{static_cast<Index>(row.size())}, {}};
  for (const JsonReader& entry : row)
    if (auto formula = read_formula(entry)) formulas.formulas.push_back(std::move(*formula));
  if (formulas.formulas.size() != row.size()) return std::nullopt;
  return formulas;
}

std::optional<WrittenFormulas> read_rows(const std::vector<JsonReader>& rows) {
  WrittenFormulas matrix;
  bool right = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto entries = rows[i].elements();
    const auto row = entries ? read_row(*entries) : std::nullopt;
    if (!row) {
      right = false;
      continue;
    }
    if (matrix.shape.empty()) matrix.shape = {static_cast<Index>(rows.size()), row->shape[0]};
    if (row->shape[0] != matrix.shape[1]) {
      rows[i].problem("has " + std::to_string(row->shape[0]) + " entries; expected " +
                      std::to_string(matrix.shape[1]) + " as in the rows above");
      right = false;
    }
    matrix.formulas.insert(matrix.formulas.end(), row->formulas.begin(), row->formulas.end());
  }
  if (!right) return std::nullopt;
  return matrix;
}

}  // namespace

std::vector<std::string> texts(const WrittenFormulas& formulas) {
  std::vector<std::string> result;
  for (const WrittenFormula& formula : formulas.formulas) result.push_back(formula.text);
  return result;
}

std::optional<WrittenFormula> read_formula(const JsonReader& value) {
  if (value.value().is_number())
    return WrittenFormula{exact_text(*value.number()), value.pointer()};
  if (value.value().is_string()) return WrittenFormula{*value.text(), value.pointer()};
  value.expected(kFormula);
  return std::nullopt;
}

std::optional<WrittenFormulas> read_formulas(const JsonReader& value) {
  if (!value.value().is_array()) {
    auto formula = read_formula(value);
    if (!formula) return std::nullopt;
    return WrittenFormulas{{}, {std::move(*formula)}};
  }
  const auto elements = *value.elements();
  if (elements.empty()) {
    value.expected("a formula, a number, or an array of them");
    return std::nullopt;
  }
  return elements.front().value().is_array() ? read_rows(elements) : read_row(elements);
}

std::optional<WrittenFormulas> read_formula_vector(const JsonReader& value) {
  const auto elements = value.elements();
  return elements ? read_row(*elements) : std::nullopt;
}

std::optional<WrittenFormulas> read_formula_matrix(const JsonReader& value, Index rows,
                                                   Index columns) {
  const auto elements = value.elements();
  if (!elements) return std::nullopt;
  const std::string size =
      "expected " + std::to_string(rows) + " rows of " + std::to_string(columns) + " formulas";
  if (static_cast<Index>(elements->size()) != rows) {
    value.problem("has " + std::to_string(elements->size()) + " rows; " + size);
    return std::nullopt;
  }
  auto matrix = read_rows(*elements);
  if (matrix && rows > 0 && matrix->shape[1] != columns) {
    value.problem("has rows of " + std::to_string(matrix->shape[1]) + "; " + size);
    return std::nullopt;
  }
  return matrix;
}

Expr evaluate(const WrittenFormula& formula, const SymbolTable& symbols) {
  return parse_formula(formula.text, symbols);
}

ExprVector evaluate(const WrittenFormulas& formulas, const SymbolTable& symbols) {
  ExprVector values(static_cast<Index>(formulas.formulas.size()));
  for (Index i = 0; i < values.size(); ++i)
    values[i] = evaluate(formulas.formulas[static_cast<std::size_t>(i)], symbols);
  return values;
}

std::optional<VectorXd> evaluate_constants(const WrittenFormulas& formulas,
                                           const SymbolTable& constants, Findings& findings) {
  VectorXd numbers(std::ssize(formulas.formulas));
  bool right = true;
  for (Index i = 0; i < numbers.size(); ++i) {
    const WrittenFormula& formula = formulas.formulas[static_cast<std::size_t>(i)];
    try {
      numbers[i] = evaluate(formula, constants).value();
    } catch (const FormulaError& error) {
      findings.problem(formula.pointer, error.what());
      right = false;
      continue;
    }
    if (std::isfinite(numbers[i])) continue;
    findings.problem(formula.pointer,
                     "is " + number_text(numbers[i]) + "; expected a finite number");
    right = false;
  }
  return right ? std::optional(numbers) : std::nullopt;
}

bool check(const WrittenFormula& formula, const SymbolTable& symbols, Findings& findings) {
  try {
    evaluate(formula, symbols);
    return true;
  } catch (const FormulaError& error) {
    findings.problem(formula.pointer, error.what());
    return false;
  }
}

bool check(const WrittenFormulas& formulas, const SymbolTable& symbols, Findings& findings) {
  bool right = true;
  for (const WrittenFormula& formula : formulas.formulas)
    right = check(formula, symbols, findings) && right;
  return right;
}

}  // namespace courant
