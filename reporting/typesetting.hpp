// Text with its mathematics set, for pages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "courant/plotting/svg.hpp"

namespace courant {

// A sentence: S_k and S_{k+1} with subscripts, single letters (but the word "a") and the tangent
// bundle TM in italics.
plot::Markup typeset(std::string_view text);

// A text with names of manifolds in it as one writes them: "CotangentBundle(Sphere(2, exponential))"
// is T*S² then, and "Product(Euclidean(3), SpecialOrthogonal3(cayley))" is ℝ³ × SO(3). Names that are
// not known stay as they are.
plot::Markup typeset_manifolds(std::string_view text);

// The same as plain text: T*S², ℝ³ × SO(3).
std::string manifolds_in_unicode(std::string_view text);

// How many bytes of UTF-8 the first character of a text has; 0 of an empty text.
std::size_t character_size(std::string_view text);

// The same text, whose numbers stay in one line: "1.2 × 10⁻⁴ ± 3 × 10⁻⁵" with spaces that do not break.
std::string unbroken(std::string_view text);

}  // namespace courant
