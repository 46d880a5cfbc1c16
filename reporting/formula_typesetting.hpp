// Formulas set as mathematics: MathML for pages, LaTeX for papers.
#pragma once

#include <string>
#include <string_view>

#include "courant/plotting/svg.hpp"

namespace courant {

// A formula or an equation of the language of experiments as a reader of mathematics expects it:
//
//   p_x^2/(2*m) - k*cos(theta_1)    p_x²/2m - k cos θ₁, with a bar
//   q[0]' = sqrt(a[1][2])           q̇₀ = √a₁₂
//   sum(i, 0, n-1, x[i]^2)          with Σ and its bounds
//
//   l = [0.2, 0.5]                  l = (0.2, 0.5); an array of arrays in JSON is a matrix
//
// x' is ẋ, names of Greek letters are these letters, what follows _ in a name stands below. A text that is no
// formula is set as text, so that nothing is lost.

// MathML Core, a <math> element of its own; a browser needs no script for it.
plot::Markup math(std::string_view formula);
// The same for a line of its own, with full-sized fractions. A long formula is several <math> elements, between which
// a line may end: before + and - of its sums.
plot::Markup displayed_math(std::string_view formula);

// What goes between the $ of LaTeX with amsmath.
std::string latex_math(std::string_view formula);
// What goes between \[ and \]: several lines where the formula is longer than one.
std::string latex_displayed(std::string_view formula);
// Whether it is as long as a line of a page.
bool is_long_formula(std::string_view formula);

// A text in which LaTeX sees no commands.
std::string latex_text(std::string_view text);

}  // namespace courant
