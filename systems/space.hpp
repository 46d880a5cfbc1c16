// The manifold of an experiment's system, with names for its coordinates.
#pragma once

#include <memory>
#include <optional>

#include "courant/manifolds/manifold.hpp"
#include "courant/systems/registry.hpp"
#include "courant/systems/vocabulary.hpp"

namespace courant {

// A manifold M ⊂ R^N with N names. On a cotangent bundle those of the base come first, then the
// momenta p_<name>.
struct Space {
  std::shared_ptr<const Manifold> manifold;
  NameList coordinates;
};

// The kinds of `manifold`; the coordinates are what the experiment declares, for a cotangent bundle
// on its base.
const Registry<std::shared_ptr<const Manifold>, NameList>& manifold_kinds();

// Reads the keys `coordinates` and `manifold` (or `otherwise`, where it is missing). `taken` has
// the names that may not be used again, and gets the new ones.
std::optional<Space> read_space(ObjectReader& system, const Json& otherwise, SymbolTable& taken);

// The cotangent bundle of a space, with momenta. A momentum has the shape of its coordinate, but
// where covectors are not represented in R^N (n < N on groups) it is an array of Ñ: "R[3][3]" has
// p_R[3]. On SE(3) with "R[3][3]", "r[3]" there are p_R[3] and p_r[3].
std::optional<Space> cotangent_bundle(const Space& base, SymbolTable& taken,
                                      const JsonReader& coordinates);

}  // namespace courant
