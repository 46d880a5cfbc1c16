// Panels that belong together, as one picture.
#pragma once

#include <string>
#include <vector>

#include "courant/plotting/figure.hpp"

namespace courant::plot {

// A legend, and panels below it: one under the other, or two abreast where they are narrow.
struct Sheet {
  std::string title;        // what it is, in a line
  std::string description;  // what one sees, for who does not
  std::vector<LegendEntry> legend;
  std::vector<Panel> panels;
};

// An SVG on white that needs no page and no style sheet.
Markup draw(const Sheet& sheet);

}  // namespace courant::plot
