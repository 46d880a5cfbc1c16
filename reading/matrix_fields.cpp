#include "courant/reading/matrix_fields.hpp"

#include <random>

#include "courant/core/words/message.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/structures/canonical_symplectic.hpp"

namespace courant {
namespace {

// The matrix at x, filled by rows.
ExprMatrix matrix(const WrittenFormulas& formulas, Index rows, Index columns,
                  const Vocabulary& vocabulary, const ExprVector& x) {
  const ExprVector entries = evaluate(formulas, vocabulary.symbols({.x = x}));
  ExprMatrix result(rows, columns);
  for (Index i = 0; i < rows; ++i) result.row(i) = entries.segment(i * columns, columns);
  return result;
}

// The formulas and their shape as a matrix; a vector is one row, or one column.
struct Block {
  WrittenFormulas formulas;
  Index rows, columns;
};
std::optional<Block> read_block(const JsonReader& value, bool vector_is_row) {
  const auto formulas = read_formulas(value);
  if (!formulas) return std::nullopt;
  const auto& shape = formulas->shape;
  if (shape.size() == 2) return Block{*formulas, shape[0], shape[1]};
  if (shape.size() == 1)
    return vector_is_row ? Block{*formulas, 1, shape[0]} : Block{*formulas, shape[0], 1};
  value.expected("a matrix of formulas by rows");
  return std::nullopt;
}

}  // namespace

bool check_at_point(const WrittenFormulas& formulas, const StructureSite& site,
                    const JsonReader& place) {
  Graph graph;
  const ExprVector x = graph.variables("x", site.manifold->ambient_dimension());
  return check(formulas, site.vocabulary.symbols({.x = x}), place.findings());
}

std::optional<MatrixField> read_matrix_field(const JsonReader& value, const StructureSite& site,
                                             Index rows, Index columns) {
  const auto formulas = read_formula_matrix(value, rows, columns);
  if (!formulas || !check_at_point(*formulas, site, value)) return std::nullopt;
  return [formulas = *formulas, vocabulary = site.vocabulary, rows, columns](const ExprVector& x) {
    return matrix(formulas, rows, columns, vocabulary, x);
  };
}

std::optional<MatrixField> read_skew_matrix(const JsonReader& value, const StructureSite& site,
                                            SkewMatrix kind) {
  const Index n = site.manifold->tangent_dimension();
  if (value.value() != "canonical") {
    const auto field = read_matrix_field(value, site, n, n);
    if (!field || !is_skew(*site.manifold, *field, value)) return std::nullopt;
    return field;
  }
  auto phase_space = std::dynamic_pointer_cast<const CotangentBundle>(site.manifold);
  if (!phase_space && std::dynamic_pointer_cast<const Euclidean>(site.manifold) && n % 2 == 0)
    phase_space = std::make_shared<CotangentBundle>(std::make_shared<Euclidean>(n / 2));
  if (!phase_space) {
    value.problem("is on " + site.manifold->name() +
                  "; expected a cotangent bundle, or as many momenta as positions after them");
    return std::nullopt;
  }
  return [structure = CanonicalSymplectic(phase_space), kind](const ExprVector& x) {
    return kind == SkewMatrix::form ? structure.form(x) : structure.bivector(x);
  };
}

std::optional<ColumnField> read_row_field(const JsonReader& value, const StructureSite& site) {
  const auto block = read_block(value, true);
  if (!block) return std::nullopt;
  const Index n = site.manifold->tangent_dimension();
  if (block->columns != n) {
    value.problem("has rows of " + std::to_string(block->columns) + " entries; expected " +
                  std::to_string(n) + " in each");
    return std::nullopt;
  }
  if (!check_at_point(block->formulas, site, value)) return std::nullopt;
  return ColumnField{[formulas = block->formulas, vocabulary = site.vocabulary, rows = block->rows,
                      n](const ExprVector& x) {
                       return ExprMatrix(matrix(formulas, rows, n, vocabulary, x).transpose());
                     },
                     block->rows};
}

std::optional<ColumnField> read_column_field(const JsonReader& value, const StructureSite& site) {
  const auto block = read_block(value, false);
  if (!block) return std::nullopt;
  const Index n = site.manifold->tangent_dimension();
  if (block->rows != n) {
    value.problem("has " + std::to_string(block->rows) + " rows; expected " + std::to_string(n));
    return std::nullopt;
  }
  if (!check_at_point(block->formulas, site, value)) return std::nullopt;
  return ColumnField{
      [formulas = block->formulas, vocabulary = site.vocabulary, n, columns = block->columns](
          const ExprVector& x) { return matrix(formulas, n, columns, vocabulary, x); },
      block->columns};
}

std::vector<MatrixXd> sampled(const Manifold& manifold, const MatrixField& field) {
  std::mt19937 generator(1);
  std::vector<MatrixXd> samples;
  for (int trial = 0; trial < 3; ++trial) {
    const MatrixXd A = values(field(constants(manifold.random_point(generator))));
    if (A.size() > 0 && A.allFinite()) samples.push_back(A);
  }
  return samples;
}

bool is_skew(const Manifold& manifold, const MatrixField& field, const JsonReader& place) {
  for (const MatrixXd& A : sampled(manifold, field)) {
    Index i = 0, j = 0;
    const double defect = (A + A.transpose()).cwiseAbs().maxCoeff(&i, &j);
    if (defect > 1e-12 * A.cwiseAbs().maxCoeff()) {
      const auto entry = [](Index row, Index column) {
        return "[" + std::to_string(row) + "][" + std::to_string(column) + "]";
      };
      place.problem("is not skew-symmetric: at a random point entry " + entry(i, j) +
                    (i == j ? " is " : " and entry " + entry(j, i) + " add up to ") +
                    number_text(i == j ? A(i, i) : A(i, j) + A(j, i)) + "; expected 0");
      return false;
    }
  }
  return true;
}

}  // namespace courant
