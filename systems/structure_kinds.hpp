// The Dirac structures that an experiment can ask for.
#pragma once

#include <memory>
#include <vector>

#include "courant/structures/dirac_structure.hpp"
#include "courant/structures/matrix_field.hpp"
#include "courant/systems/registry.hpp"
#include "courant/systems/space.hpp"
#include "courant/systems/vocabulary.hpp"

namespace courant {

// Where a structure lives, and the names that its formulas may use (coordinates, parameters and
// definitions of them).
struct StructureSite {
  std::shared_ptr<const Manifold> manifold;
  Vocabulary vocabulary;
};

// The kinds of `structure`.
const Registry<std::shared_ptr<const DiracStructure>, StructureSite>& structure_kinds();

// The keys `coordinates` and `manifold` of an object with a `structure`. The manifold is by default
// T*Rⁿ for the canonical structure and Rⁿ for others; a product or composed structure has one made
// of its parts, so none may be given, and that of the space is only as large as the coordinates:
// take DiracStructure::manifold() once the structure is read.
std::optional<Space> read_structure_space(ObjectReader& object, SymbolTable& taken);

// A matrix of formulas of the point, rows × columns; nothing, and a problem, if it is none.
std::optional<MatrixField> read_matrix_field(const JsonReader& value, const StructureSite& site,
                                             Index rows, Index columns);
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
