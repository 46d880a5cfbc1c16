// Figures as files of their own, for a paper.
#pragma once

#include <filesystem>

#include "courant/reporting/figure_drawing.hpp"

namespace courant {

// Writes the figure as SVG, PDF, PNG (at 300 dots an inch) or for LaTeX (.pgf), as the extension of `file` says, and
// its numbers beside it with the extension .csv. PDF and PNG are made by the program rsvg-convert.
// Files that are there are replaced if they are as this function wrote them; with `force` the picture
// is in any case, as it was named, but never other numbers. Throws RefusedOutput, before anything is
// written, where a file may not be replaced; std::invalid_argument for another extension; OutputError
// where a file cannot be written or rsvg-convert is missing or fails.
void write_figure(const Figure& figure, const std::filesystem::path& file, bool force = false);

}  // namespace courant
