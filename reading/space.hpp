// The manifold of an experiment's system, with names for its coordinates.
#pragma once

#include <memory>
#include <optional>

#include "courant/manifolds/manifold.hpp"
#include "courant/reading/registry.hpp"
#include "courant/reading/vocabulary.hpp"

namespace courant {

// A manifold M ⊂ R^N with N names. On a bundle those of the base come first, then those of the
// fibres: momenta p_<name> on T*Q, velocities v_<name> on TQ.
struct Space {
  std::shared_ptr<const Manifold> manifold;
  NameList coordinates;
};

// The kinds of `manifold`. The vocabulary has the coordinates that the experiment declares, for a
// bundle on its base, and what else formulas of them may contain.
Registry<std::shared_ptr<const Manifold>, Vocabulary>& manifold_kinds();

// Reads the keys `coordinates` (or another `key` of names) and `manifold`, whose formulas may use the parameters and
// definitions of a vocabulary. Where there is no `manifold`, it is the declared default, or
// `otherwise`. `taken` has the names that may not be used again, and gets the new ones.
std::optional<Space> read_space(ObjectReader& system, const Vocabulary& vocabulary,
                                SymbolTable& taken, const std::string& key = "coordinates");
std::optional<Space> read_space(ObjectReader& system, const Json& otherwise,
                                const Vocabulary& vocabulary, SymbolTable& taken,
                                const std::string& key = "coordinates");

// The cotangent bundle of a space, with momenta. A momentum has the shape of its coordinate, but
// where covectors are not represented in R^N (n < N on groups) it is an array of Ñ: "R[3][3]" has
// p_R[3]. On SE(3) with "R[3][3]", "r[3]" there are p_R[3] and p_r[3].
std::optional<Space> cotangent_bundle(const Space& base, SymbolTable& taken,
                                      const JsonReader& coordinates);

}  // namespace courant
