#include "courant/reading/cell_formulas.hpp"

#include "courant/core/numbers/as_size.hpp"

namespace courant {
namespace {

// Each column divided by its sum.
void normalise(SparseMatrixXd& weights) {
  for (Index column = 0; column < weights.cols(); ++column) {
    double sum = 0.0;
    for (SparseMatrixXd::InnerIterator it(weights, column); it; ++it) sum += it.value();
    for (SparseMatrixXd::InnerIterator it(weights, column); it; ++it) it.valueRef() /= sum;
  }
}

}  // namespace

void add_place(SymbolTable& symbols, const MatrixXd& positions, Index cell) {
  for (Index a = 0; a < 3; ++a) symbols.add(std::string(1, "xyz"[a]), Expr(positions(cell, a)));
}

ExprVector integrated(const CellForm& form, const std::vector<Index>& cells,
                      const WrittenFormulas& formulas, const SymbolTable& symbols) {
  ExprVector result(std::ssize(cells));
  for (Index i = 0; i < result.size(); ++i) {
    const Index cell = cells[as_size(i)];
    SymbolTable here = symbols;
    add_place(here, form.positions, cell);
    const ExprVector components = evaluate(formulas, here);
    Expr component = components[0];
    if (form.is_vector) {
      component = 0.0;
      for (Index a = 0; a < components.size(); ++a)
        component += form.directions(cell, a) * components[a];
    }
    result[i] = form.sizes[cell] * component;
  }
  return result;
}

std::optional<WrittenFormulas> read_form(const JsonReader& value, const CellForm& form) {
  auto formulas = read_formulas(value);
  if (!formulas) return std::nullopt;
  const std::size_t count = formulas->formulas.size();
  if (form.is_vector ? count < 2 || count > 3 : count != 1) {
    value.problem("has " + std::to_string(count) + " formulas; expected " +
                  (form.is_vector ? "the components of a vector" : "one, of a scalar"));
    return std::nullopt;
  }
  return formulas;
}

CellFormulas::CellFormulas(std::shared_ptr<const StokesDirac> structure,
                           std::vector<std::string> names, const Vocabulary& vocabulary)
    : names_(std::move(names)),
      words_(vocabulary.of_time()),
      p_(structure->p_form()),
      q_(structure->q_form()) {
  const CellComplex& K = *structure->complex();
  words_.coordinates.append_unnamed(has_q() ? structure->state_count() : structure->p_count());
  p_volumes_ = p_.sizes;
  for (Index i = 0; i < p_volumes_.size(); ++i)
    p_volumes_[i] *= K.measures(structure->degree())[structure->p_cells()[as_size(i)]];
  q_volumes_ = q_.sizes.cwiseProduct(K.dual_measures(structure->degree() + 1));
  // Means of scalars: of p at the ends of edges, of q around facets.
  const SparseMatrixXd neighbours =
      structure->J().bottomLeftCorner(structure->q_count(), structure->p_count());
  if (!p_.is_vector) {
    p_at_q_ = SparseMatrixXd(neighbours.transpose()).cwiseAbs();
    normalise(p_at_q_);
  }
  if (!q_.is_vector) {
    q_at_p_ = q_volumes_.asDiagonal() * SparseMatrixXd(neighbours.cwiseAbs());
    normalise(q_at_p_);
  }
}

SymbolTable CellFormulas::base(const ExprVector& point, const std::optional<Expr>& t) const {
  return words_.symbols({.x = point, .t = t});
}

ExprVector CellFormulas::densities(const ExprVector& point) const {
  ExprVector all = point;
  for (Index i = 0; i < all.size(); ++i) {
    const Index p = p_.sizes.size();
    all[i] = all[i] / (i < p ? p_.sizes[i] : q_.sizes[i - p]);
  }
  return all;
}

SymbolTable CellFormulas::symbols_at(At at, Index cell, const SymbolTable& base,
                                     const ExprVector& densities) const {
  SymbolTable symbols = base;
  add_place(symbols, form(at).positions, cell);
  const Index p = p_.sizes.size();
  const auto mean = [&](const SparseMatrixXd& weights, Index first) {
    Expr sum = 0.0;
    for (SparseMatrixXd::InnerIterator it(weights, cell); it; ++it)
      sum += it.value() * densities[first + it.row()];
    return sum;
  };
  const auto is_there = [&](const SparseMatrixXd& weights) {
    return weights.cols() > 0 && weights.col(cell).nonZeros() > 0;
  };
  if (at == At::p) {
    symbols.add(names_[0], densities[cell]);
    if (has_q() && is_there(q_at_p_)) symbols.add(names_[1], mean(q_at_p_, p));
  } else {
    if (is_there(p_at_q_)) symbols.add(names_[0], mean(p_at_q_, 0));
    if (has_q()) symbols.add(names_[1], densities[p + cell]);
  }
  return symbols;
}

ExprVector CellFormulas::at_cells(At at, const WrittenFormula& formula, const ExprVector& point,
                                  const std::optional<Expr>& t) const {
  const SymbolTable symbols = base(point, t);
  const ExprVector all = densities(point);
  ExprVector result(form(at).sizes.size());
  for (Index cell = 0; cell < result.size(); ++cell)
    result[cell] = evaluate(formula, symbols_at(at, cell, symbols, all));
  return result;
}

bool CellFormulas::is_right(At at, const WrittenFormula& formula, bool has_time,
                            Findings& findings) const {
  const Graph graph;
  const ExprVector point = graph.variables("x", words_.coordinates.size());
  const SymbolTable symbols =
      base(point, has_time ? std::optional(graph.variable("t")) : std::nullopt);
  const ExprVector all = densities(point);
  for (Index cell = 0; cell < form(at).sizes.size(); ++cell)
    if (!check(formula, symbols_at(at, cell, symbols, all), findings)) return false;
  return true;
}

}  // namespace courant
