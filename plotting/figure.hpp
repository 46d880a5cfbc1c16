// One panel of a figure: curves over two axes, drawn as an SVG.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "courant/plotting/scale.hpp"
#include "courant/plotting/svg.hpp"

namespace courant::plot {

// A curve through the rows (x, y); rows that are not finite are gaps. Colours are counted from 0
// and repeat after `palette().size()`.
struct Series {
  std::string label;
  std::vector<double> x, y;
  std::size_t colour = 0;
};

struct Axis {
  std::string label;
  std::shared_ptr<const Scale> scale = std::make_shared<LinearScale>();
  Interval interval = {};  // empty: what the series need
};

// What a panel shows. The plotted area is `width` pixels less the margins wide; a curve whose x
// increases and that has many rows for each pixel is drawn as the band between its least and
// greatest values, any other as a line.
struct Panel {
  std::string title;        // what it is, in a line
  std::string description;  // what one sees, for who does not
  std::string heading;      // drawn above the curves, to tell one of several panels from the others
  Axis x, y;
  std::vector<Series> series;
  double width = 720;
  double height = 320;
  bool equal_aspect = false;  // a circle is a circle: the height follows from the data
  bool endpoints = false;     // ○ at the start of each curve, ● at its end
  bool points = false;        // ● at each row, for curves of few
};

Markup draw(const Panel& panel);
// The height of what is drawn, in pixels.
double drawn_height(const Panel& panel);

// An entry for each label, with a piece of line in its colour; an HTML list.
struct LegendEntry {
  std::string label;
  std::size_t colour = 0;
};
Markup legend(std::span<const LegendEntry> entries);

// Okabe and Ito's colours, told apart by who does not see red or green; on paper, then on a dark
// screen.
struct PaletteColour {
  std::string_view light, dark;
};
std::span<const PaletteColour> palette();

// The style sheet of the panels, to go into the page once. Without it they are drawn in the light
// colours.
std::string figure_style();

}  // namespace courant::plot
