// Figures as files of their own, for a paper.
#pragma once

#include <filesystem>
#include <string>

#include "courant/reporting/report_figures.hpp"

namespace courant {

// The figure as an SVG on white, its legend in it, its caption as its description.
std::string figure_svg(const Figure& figure);

// Its numbers, all of them, as comma-separated values: for each curve a column of its x, unless that
// is the same as of the curve before, and a column of its y. Columns of several panels stand side by
// side, and have the names of their panels where there are several.
std::string figure_csv(const Figure& figure);

// Writes the figure as SVG, PDF or PNG (at 300 dots an inch), as the extension of `file` says, and
// its numbers beside it with the extension .csv. PDF and PNG are made by the program rsvg-convert.
// Files that are there are replaced if they are as this function wrote them; with `force` the picture
// is in any case, as it was named, but never other numbers. Throws RefusedOutput, before anything is
// written, where a file may not be replaced; std::invalid_argument for another extension; OutputError
// where a file cannot be written or rsvg-convert is missing or fails.
void write_figure(const Figure& figure, const std::filesystem::path& file, bool force = false);

}  // namespace courant
