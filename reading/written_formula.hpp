// Formulas as an experiment writes them: one, an array or a matrix of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/core/language/formula.hpp"
#include "courant/reading/json_reader.hpp"

namespace courant {

// A formula (or a number, which is one), and where it stands.
struct WrittenFormula {
  std::string text;
  std::string pointer;
};

// A formula, {n} or {n, m} of them by rows: `"x^2"`, `["x", 1]`, `[["x", 1], ["y", 0]]`.
struct WrittenFormulas {
  Shape shape;
  std::vector<WrittenFormula> formulas;
};

std::optional<WrittenFormula> read_formula(const JsonReader& value);
std::optional<WrittenFormulas> read_formulas(const JsonReader& value);
// An array of n formulas; a square matrix of them.
std::optional<WrittenFormulas> read_formula_vector(const JsonReader& value);
std::optional<WrittenFormulas> read_formula_matrix(const JsonReader& value, Index rows,
                                                   Index columns);

// Their texts.
std::vector<std::string> texts(const WrittenFormulas& formulas);

// The values. Throw FormulaError, which cannot happen once `check` has passed for the same names.
Expr evaluate(const WrittenFormula& formula, const SymbolTable& symbols);
ExprVector evaluate(const WrittenFormulas& formulas, const SymbolTable& symbols);
// The values of formulas that must be constant: a problem where one is wrong, or is not.
std::optional<VectorXd> evaluate_constants(const WrittenFormulas& formulas,
                                           const SymbolTable& constants, Findings& findings);

// Whether they are right; every one that is not becomes a problem.
bool check(const WrittenFormula& formula, const SymbolTable& symbols, Findings& findings);
bool check(const WrittenFormulas& formulas, const SymbolTable& symbols, Findings& findings);

}  // namespace courant
