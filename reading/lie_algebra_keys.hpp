// The keys of a Lie algebra.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "courant/reading/json_reader.hpp"
#include "courant/structures/lie_algebra.hpp"

namespace courant {

// `algebra` (a name) with `n` where it has a size, `constants`, `brackets` with a `basis`, or `matrices`.
std::vector<Key> lie_algebra_keys();
// Those of which one has to be there: KindDescription::one_of.
const std::vector<std::string>& lie_algebra_choice();
std::optional<LieAlgebra> read_lie_algebra(ObjectReader& object);

// An array of square matrices of numbers, by rows.
std::optional<std::vector<MatrixXd>> read_matrices(const JsonReader& value);

// g ⋉ V for a representation that is read from `place`; a problem there if it is none.
std::optional<LieAlgebra> semidirect(const LieAlgebra& g, const std::vector<MatrixXd>& rho,
                                     const JsonReader& place);

}  // namespace courant
