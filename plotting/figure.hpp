// A panel drawn as an SVG, its legend and its style sheet.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "courant/plotting/palette.hpp"
#include "courant/plotting/panel.hpp"
#include "courant/plotting/svg.hpp"

namespace courant::plot {

// With `rows`, the numbers of at most as many rows of each curve go along, for the script of a page.
// Then the <g class="panel"> has
//   data-x-name, data-y-name  the labels of the axes
//   data-area                 left, top, right and bottom of the plotted area, in pixels
//   data-view                 least and greatest x and y
//   data-origin               what has been subtracted from all x and all y
//   data-zone                 the greatest value within which each axis is linear; 0 on a logarithmic one
//   data-exponent             the power of ten that the labels at each axis leave out
//   data-equal                "equal" where a circle is a circle
//   data-rods                 pairs of curves with a rod between them: "0-1 1-", "1-" from the second to the origin
// and each <g class="series"> has its CurveData (curve_data.hpp). draw_in_space() says what panels in
// space have.
Markup draw(const Panel& panel, std::size_t rows = 0);
// The height of what is drawn, in pixels.
double drawn_height(const Panel& panel);

// An entry for each label, with a piece of line in its colour; an HTML list.
struct LegendEntry {
  std::string label;
  std::size_t colour = 0;
};
Markup legend(std::span<const LegendEntry> entries);

// The style sheet of the panels, to go into the page once. Without it they are drawn in the light
// colours.
std::string figure_style();

}  // namespace courant::plot
