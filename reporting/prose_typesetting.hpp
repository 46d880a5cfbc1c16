// Prose as it is written in pages, in LaTeX and in Markdown: its words, and its formulas set as mathematics.
#pragma once

#include <string>
#include <string_view>

#include "courant/plotting/svg.hpp"
#include "courant/reporting/prose.hpp"

namespace courant {

// A text with $formulas$ in the language of experiments.
Prose marked_prose(std::string_view text);

plot::Markup typeset_prose(const Prose& prose);
// On a line of its own, which begins further to the right and may be longer than the page.
plot::Markup displayed_prose(const Prose& prose);

// For LaTeX with amsmath and amssymb, which reads UTF-8.
std::string latex_prose(const Prose& prose);
// A sentence without formulas: M_f has its subscript, letters that are not ASCII their commands.
std::string latex_sentence(std::string_view text);

// Formulas stand between $.
std::string markdown_prose(const Prose& prose);
// A text in which Markdown sees no marks.
std::string markdown_text(std::string_view text);

}  // namespace courant
