#include "courant/integrators/methods/verlet_multipliers.hpp"

#include <algorithm>
#include <utility>

#include "courant/core/algebra/affine_parts.hpp"
#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/linear/block_triangular_form.hpp"

namespace courant {
namespace {

// Equations in the order in which they can be solved: all unknowns y in those of the parts, of which each is given by the
// parts up to its own.
struct Blocks {
  struct Part {
    ExprVector unknowns, equations;
    bool is_affine;
  };
  std::vector<Part> parts;
  ExprVector unknowns;
  ExprVector left;  // no equation contains them
};

// A block of equations. What one of them gives as a formula, once a few unknowns are known, is put into the others.
class TornBlock {
 public:
  TornBlock(ExprVector equations, const ExprVector& unknowns)
      : equations_(std::move(equations)), unknowns_(unknowns), formulas_(unknowns) {
    for (Index i = 0; i < unknowns.size(); ++i) {
      open_.push_back(i);
      rows_.push_back(i);
    }
    while (!open_.empty())
      if (!solve_rows()) tear();
  }

  ExprVector torn() const { return unknowns_(torn_); }
  ExprVector equations() const { return equations_(rows_); }
  const ExprVector& formulas() const {
    return formulas_;
  }  // of all its unknowns, in those that are torn

 private:
  static bool is_never_zero(const Expr& a) { return a.is_constant() && a.value() != 0.0; }

  SparseExprMatrix jacobian_of_open() const {
    return jacobian(ExprVector(equations_(rows_)), ExprVector(unknowns_(open_)));
  }

  // Equations of one open unknown each. Whether there were some.
  bool solve_rows() {
    const SparseExprMatrix J = jacobian_of_open();
    std::vector<Index> entries(rows_.size(), 0), entry(rows_.size(), -1);
    for (std::size_t k = 0; k < J.row.size(); ++k) {
      ++entries[static_cast<std::size_t>(J.row[k])];
      entry[static_cast<std::size_t>(J.row[k])] = static_cast<Index>(k);
    }
    std::vector<Index> rows_left, solved, open_left;
    std::vector<bool> is_solved(open_.size(), false);
    ExprVector formulas(0);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows_left.push_back(rows_[i]);
      if (entries[i] != 1) continue;
      const auto column = static_cast<std::size_t>(J.col[static_cast<std::size_t>(entry[i])]);
      const Expr slope = J.values[entry[i]];
      if (is_solved[column] || !is_never_zero(slope)) continue;
      const ExprVector unknown = ExprVector::Constant(1, unknowns_[open_[column]]);
      const Expr rest = substitute(equations_[rows_[i]], unknown, ExprVector::Zero(1));
      formulas =
          joined(formulas, ExprVector::Constant(1, slope.value() == -1.0 ? rest : -rest / slope));
      is_solved[column] = true;
      solved.push_back(open_[column]);
      rows_left.pop_back();
    }
    if (solved.empty()) return false;
    const ExprVector given = unknowns_(solved);
    equations_ = substitute(equations_, given, formulas);
    formulas_ = substitute(formulas_, given, formulas);
    for (std::size_t j = 0; j < open_.size(); ++j)
      if (!is_solved[j]) open_left.push_back(open_[j]);
    open_ = std::move(open_left);
    rows_ = std::move(rows_left);
    return true;
  }

  // The last unknown that no equation gives as a formula, as a multiplier; else the last one.
  void tear() {
    const SparseExprMatrix J = jacobian_of_open();
    std::vector<bool> is_given(open_.size(), false);
    for (std::size_t k = 0; k < J.row.size(); ++k)
      if (is_never_zero(J.values[static_cast<Index>(k)]))
        is_given[static_cast<std::size_t>(J.col[k])] = true;
    std::size_t last = open_.size() - 1;
    for (std::size_t j = 0; j < open_.size(); ++j)
      if (!is_given[j]) last = j;
    torn_.insert(torn_.begin(), open_[last]);
    open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(last));
  }

  ExprVector equations_, unknowns_, formulas_;
  std::vector<Index> open_, rows_, torn_;
};

// No value where equations and unknowns are not as many, or no step can be determined by them.
std::optional<Blocks> divided(ExprVector equations, const ExprVector& y) {
  const SparseExprMatrix J = jacobian(equations, y);
  std::vector<Index> place(static_cast<std::size_t>(y.size()), -1), contained, left;
  for (const Index column : J.col) place[static_cast<std::size_t>(column)] = 0;
  for (Index j = 0; j < y.size(); ++j) {
    Index& at = place[static_cast<std::size_t>(j)];
    if (at == 0) at = std::ssize(contained);
    (at < 0 ? left : contained).push_back(j);
  }
  if (J.rows != std::ssize(contained)) return std::nullopt;
  std::vector<PatternEntry> entries;
  for (std::size_t k = 0; k < J.row.size(); ++k)
    entries.push_back({J.row[k], place[static_cast<std::size_t>(J.col[k])]});
  const auto blocks = block_triangular_form(J.rows, entries);
  if (!blocks) return std::nullopt;
  Blocks result{.parts = {}, .unknowns = y, .left = y(left)};
  const auto put = [&](const ExprVector& unknowns, const ExprVector& formulas) {
    result.unknowns = substitute(result.unknowns, unknowns, formulas);
    equations = substitute(equations, unknowns, formulas);
  };
  for (const DiagonalBlock& block : *blocks) {
    std::vector<Index> columns;
    for (const Index column : block.columns)
      columns.push_back(contained[static_cast<std::size_t>(column)]);
    const ExprVector all = y(columns);
    const TornBlock torn(equations(block.rows), all);
    put(all, torn.formulas());
    const ExprVector unknowns = torn.torn(), rows = torn.equations();
    const bool is_affine = courant::is_affine(rows, unknowns);
    if (!is_affine || unknowns.size() > 1)
      result.parts.push_back({unknowns, rows, is_affine});
    else if (unknowns.size() == 1)
      // The determinant of the equations is the product of those of the blocks, and not zero.
      put(unknowns, -substitute(rows, unknowns, ExprVector::Zero(1)).array() /
                        jacobian(rows, unknowns).values.array());
  }
  return result;
}

// x₁, u and the last changes of u after Newton's iterations for one equation after the other.
ExprVector after_iterations(const std::vector<VerletMultipliers::Block>& blocks,
                            const ExprVector& known, const ExprVector& x1) {
  ExprVector values = known, changes = known;
  for (Index b = 0; b < known.size(); ++b) {
    const ExprVector& equation = blocks[static_cast<std::size_t>(b)].formulas.outputs;
    const ExprVector u = known.segment(b, 1), both = joined(equation, jacobian(equation, u).values);
    for (int i = 0; i < VerletMultipliers::kIterations; ++i) {
      const ExprVector there =
          substitute(both, ExprVector(known.head(b + 1)), ExprVector(values.head(b + 1)));
      changes[b] = there[0] / there[1];
      values[b] -= changes[b];
    }
  }
  return joined(substitute(with_affine_parts(x1, known), known, values), values, changes);
}

}  // namespace

std::optional<VerletMultipliers> VerletMultipliers::of(const VerletTrace& trace,
                                                       const Manifold& manifold) {
  if (trace.codimension == 0 || !manifold.has_identity_frame() ||
      manifold.dimension() != manifold.ambient_dimension())
    return std::nullopt;
  const Index N = manifold.ambient_dimension(), n = manifold.dimension(), m = trace.multipliers;
  const StepFormulas& equations = trace.step;
  const ExprVector &y = equations.inputs[0].variables, &h = equations.inputs[3].variables;
  const std::vector<Function::Input> point = {
      {"x0", equations.inputs[1].variables}, {"h", h}, {"t", equations.inputs[4].variables}};

  const ExprVector lambda = y.segment(y.size() - 2 * m, m);
  const auto blocks = divided(equations.equations, y);
  if (!blocks) return std::nullopt;
  const ExprVector all = substitute(joined(trace.ended, trace.advanced), y, blocks->unknowns);
  if (depends(all, blocks->left)) return std::nullopt;
  const ExprVector outputs = substitute(all, blocks->left, ExprVector::Zero(blocks->left.size()));
  const ExprVector x1 = outputs.head(N), ending = outputs.segment(N, n + m),
                   stages = outputs.tail(trace.advanced.size()),
                   middle = stages.segment(N + n + m, N);

  // What x₁ depends on, or a block that does so.
  const std::vector<Blocks::Part>& parts = blocks->parts;
  std::vector<bool> moves(parts.size(), false);
  for (std::size_t b = parts.size(); b-- > 0;) {
    moves[b] = depends(x1, parts[b].unknowns);
    for (std::size_t later = b + 1; later < parts.size(); ++later)
      moves[b] = moves[b] || (moves[later] && depends(parts[later].equations, parts[b].unknowns));
  }
  VerletMultipliers result;
  ExprVector known(0);
  for (const bool moving : {true, false}) {
    for (std::size_t b = 0; b < parts.size(); ++b) {
      if (moves[b] != moving) continue;
      const auto& [u, rows, is_affine] = parts[b];
      Block block{.formulas = {.inputs = {{"u", u}, {"known", known}},
                               .outputs = with_affine_parts(rows, u)},
                  .is_affine = is_affine,
                  .begins = {}};
      block.formulas.inputs.insert(block.formulas.inputs.end(), point.begin(), point.end());
      for (Index i = 0; i < u.size() && !is_affine; ++i) {
        const auto found = std::find(lambda.begin(), lambda.end(), u[i]);
        if (found == lambda.end() || !moving) return std::nullopt;
        block.begins.push_back(found - lambda.begin());
      }
      result.blocks.push_back(std::move(block));
      known = joined(known, u);
    }
    const auto with_known = [&](ExprVector outputs) {
      Function::Formulas formulas{.inputs = point, .outputs = std::move(outputs)};
      formulas.inputs.push_back({"u", known});
      return formulas;
    };
    if (moving) {
      result.moving = result.blocks.size();
      result.step = with_known(x1);
      const bool has_single_ones =
          std::ranges::all_of(result.blocks, [](const Block& block) { return block.size() == 1; });
      if (has_single_ones) result.iterated = with_known(after_iterations(result.blocks, known, x1));
      result.stages = with_known(stages);
      result.middle = with_known(middle);
    } else {
      result.unknowns = known.size();
      result.ending = with_known(ending);
    }
  }
  return result;
}

}  // namespace courant
