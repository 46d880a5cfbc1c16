// What the constraint algorithm found, drawn and said.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "courant/plotting/svg.hpp"

namespace courant {

// The ladder of a summary.json as a commutative diagram:
//
//   S₀ ⊇ S₁ = S₂
//   ↓τ   ↓τ   ↓τ
//   M₀ ⊇ M₁ = M₂
//
// Each set stands with its dimension, an empty one as ∅; "=" stands where the dimensions repeat.
plot::Markup ladder_diagram(const nlohmann::ordered_json& ladder);

// The verdict as a sentence: where the algorithm stopped, what S_f is, and what that means for
// solutions.
std::string verdict_in_words(const nlohmann::ordered_json& ladder);

// The same of a discrete ladder, where S_f are pairs of points.
std::string discrete_verdict_in_words(const nlohmann::ordered_json& ladder);

}  // namespace courant
