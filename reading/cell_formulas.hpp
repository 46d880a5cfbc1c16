// Formulas of a place and of the fields there, cell by cell.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/reading/vocabulary.hpp"
#include "courant/structures/stokes_dirac/stokes_dirac.hpp"

namespace courant {

// The names x, y, z of a place beside those that are there.
void add_place(SymbolTable& symbols, const MatrixXd& positions, Index cell);

// A form that is given by formulas of x, y, z and what is in the table, a scalar or three components, times its sizes,
// for some cells. Throws FormulaError.
ExprVector integrated(const CellForm& form, const std::vector<Index>& cells,
                      const WrittenFormulas& formulas, const SymbolTable& symbols);
// One formula for a scalar, as many as there are axes (1 to 3) for a vector; nothing, and a problem, otherwise.
std::optional<WrittenFormulas> read_form(const JsonReader& value, const CellForm& form);

// The fields of a Stokes–Dirac structure by their names, for formulas of densities: of the form p on dual cells of
// k-cells and, where there are two states, of q on (k+1)-cells.
class CellFormulas {
 public:
  enum class At { p, q };

  // `names`: one or two. The vocabulary has parameters and tables.
  CellFormulas(std::shared_ptr<const StokesDirac> structure, std::vector<std::string> names,
               const Vocabulary& vocabulary);

  // The cells of each state, with the sizes that make numbers of densities.
  const CellForm& form(At at) const { return at == At::p ? p_ : q_; }
  bool has_q() const { return names_.size() > 1; }
  // |σ||⋆σ| of its cells: what a density is integrated with.
  const VectorXd& volumes(At at) const { return at == At::p ? p_volumes_ : q_volumes_; }

  // The formula at the cells of a state, with the densities x, y, z and the fields there at the point; t where it is
  // given. A field of the other state is the mean of that of the neighbours, which is there where that is a scalar.
  ExprVector at_cells(At at, const WrittenFormula& formula, const ExprVector& point,
                      const std::optional<Expr>& t) const;
  // Whether the formula is right; a problem where not.
  bool is_right(At at, const WrittenFormula& formula, bool has_time, Findings& findings) const;

 private:
  SymbolTable symbols_at(At at, Index cell, const SymbolTable& base,
                         const ExprVector& densities) const;
  SymbolTable base(const ExprVector& point, const std::optional<Expr>& t) const;
  ExprVector densities(const ExprVector& point) const;

  std::vector<std::string> names_;
  Vocabulary words_;
  CellForm p_, q_;
  VectorXd p_volumes_, q_volumes_;
  SparseMatrixXd p_at_q_,
      q_at_p_;  // transposed: a column for each cell; empty where there is no mean
};

}  // namespace courant
