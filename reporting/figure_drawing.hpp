// Figures as texts.
#pragma once

#include <cstddef>
#include <string>

#include "courant/plotting/svg.hpp"
#include "courant/reporting/run_figure.hpp"

namespace courant {

// The legend and the panels of a figure, for a page that has content_style(); with at most `rows` rows of
// each curve for the script of the page, see plot::draw.
plot::Markup panels_and_legend(const Figure& figure, std::size_t rows);

// The figure as an SVG on white, its legend in it, its caption as its description.
std::string figure_svg(const Figure& figure);

// Its numbers, all of them, as comma-separated values: for each curve a column of its x, unless that
// is the same as of the curve before, and a column of its y. Columns of several panels stand side by
// side, and have the names of their panels where there are several.
std::string figure_csv(const Figure& figure);

// The figure for LaTeX: a tikzpicture of axes that needs the package pgfplots alone. Curves have at most two thousand
// vertices; what an axis is that is not linear is in its ticks.
std::string figure_pgf(const Figure& figure);

}  // namespace courant
