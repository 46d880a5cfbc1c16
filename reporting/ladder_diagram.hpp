// What the constraint algorithm found, drawn and said.
#pragma once

#include <string>
#include <vector>

#include "courant/plotting/svg.hpp"
#include "courant/running/ladder_report.hpp"

namespace courant {

// The ladder as a commutative diagram:
//
//   S₀ ⊇ S₁ = S₂
//   ↓τ   ↓τ   ↓τ
//   M₀ ⊇ M₁ = M₂
//
// Each set stands with its dimension, an empty one as ∅; "=" stands where the dimensions repeat.
plot::Markup ladder_diagram(const LadderReport& ladder);

// The verdict as a sentence: where the algorithm stopped, what S_f is, and what that means for
// solutions.
std::string verdict_in_words(const LadderReport& ladder);

// What must be said wherever the verdict is: that it is doubted, and why, an entry each; none where it
// is not.
std::vector<std::string> doubts_in_words(const LadderReport& ladder);

// The same of a discrete ladder, where S_f are pairs of points.
std::string discrete_verdict_in_words(const LadderReport& ladder);

}  // namespace courant
