// The cell complex of an experiment's fields.
#pragma once

#include <memory>
#include <optional>

#include "courant/reading/kind.hpp"
#include "courant/reading/vocabulary.hpp"
#include "courant/structures/stokes_dirac/cell_complex.hpp"

namespace courant {

// The keys of `complex`.
const KindDescription& complex_keys();

// Reads an object with these keys: an interval, a rectangle, a box, a graph, or the vertices and simplices of a mesh.
// Sizes and counts may be formulas of the parameters.
std::optional<CellComplex> read_complex(const JsonReader& value, const Vocabulary& vocabulary);

// Adds the regions of an object by name: a condition on x, y, z, the centre of a cell of the boundary, such as "x < 0.1".
std::optional<CellComplex> with_regions(CellComplex complex, const JsonReader& regions,
                                        const Vocabulary& vocabulary);

}  // namespace courant
