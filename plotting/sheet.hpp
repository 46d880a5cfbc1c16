// Panels that belong together, as one picture.
#pragma once

#include <optional>
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
  std::string heading = {};          // drawn above all of it
  double scale = 1;                  // of the drawing, letters and lines included
  std::optional<bool> abreast = {};  // two panels beside each other; by default narrow ones are
};

// An SVG on white that needs no page and no style sheet.
Markup draw(const Sheet& sheet);

}  // namespace courant::plot
