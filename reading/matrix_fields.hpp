// Matrices of formulas of the point: bivectors, forms, distributions, as an experiment writes them.
#pragma once

#include <memory>
#include <vector>

#include "courant/manifolds/manifold.hpp"
#include "courant/reading/vocabulary.hpp"
#include "courant/structures/matrix_field.hpp"

namespace courant {

// Where a structure lives, and the names that its formulas may use (coordinates, parameters and
// definitions of them).
struct StructureSite {
  std::shared_ptr<const Manifold> manifold;
  Vocabulary vocabulary;
};

// Whether the formulas are right as functions of the point; a problem where not.
bool check_at_point(const WrittenFormulas& formulas, const StructureSite& site,
                    const JsonReader& place);

// A matrix of formulas of the point, rows × columns; nothing, and a problem, if it is none.
std::optional<MatrixField> read_matrix_field(const JsonReader& value, const StructureSite& site,
                                             Index rows, Index columns);
// A skew matrix of formulas, or "canonical": the form dq ∧ dp or its bivector on a cotangent bundle,
// and on Rⁿ (n even) with the first half of the coordinates as q, the second as p.
enum class SkewMatrix { form, bivector };
std::optional<MatrixField> read_skew_matrix(const JsonReader& value, const StructureSite& site,
                                            SkewMatrix kind);
// Vector fields or one-forms of Ñ entries each. As rows, one each: [["-y", 0, 1]], or ["-y", 0, 1]
// for a single one. As the columns of an Ñ × m matrix by rows: [["0"], ["1"]].
struct ColumnField {
  MatrixField field;  // Ñ × count
  Index count = 0;
};
std::optional<ColumnField> read_row_field(const JsonReader& value, const StructureSite& site);
std::optional<ColumnField> read_column_field(const JsonReader& value, const StructureSite& site);

// The values at some random points of the manifold where they are finite.
std::vector<MatrixXd> sampled(const Manifold& manifold, const MatrixField& field);
// Whether A(x) + A(x)ᵀ = 0, up to round-off, at those points; a problem where it is not.
bool is_skew(const Manifold& manifold, const MatrixField& field, const JsonReader& place);

}  // namespace courant
