// What a paper wants of a figure: its width, the size of its letters, limits, a title.
#pragma once

#include <optional>
#include <string>

#include "courant/reporting/run_figure.hpp"

namespace courant {

// What a figure is asked to look like; what is not given stays as it is drawn.
struct FigureLook {
  std::optional<double> width = {};              // of the whole, in centimetres
  std::optional<double> font_size = {};          // in points; 9 as drawn
  std::optional<plot::Interval> x = {}, y = {};  // of all panels: their axes end there
  std::string title = {};
};

// The figure so. Throws std::invalid_argument for a width below 3 or above 100 cm, letters below 4 or above 40 points,
// a width that leaves no room for letters of this size, and limits that are no interval.
Figure with_look(Figure figure, const FigureLook& look);

}  // namespace courant
