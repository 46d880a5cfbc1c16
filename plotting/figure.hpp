// One panel of a figure: curves over two axes, drawn as an SVG.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
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
  std::vector<double> t = {};  // the time of each row, where x is something else
  std::vector<double> z = {};  // of curves in space
};

struct Axis {
  std::string label;
  std::shared_ptr<const Scale> scale = std::make_shared<LinearScale>();
  Interval interval = {};  // empty: what the series need
};

// How curves (x, y, z) in space are seen: from a side, all in a cube about them; or on a sphere about
// the origin, whose far side is paler.
struct Space {
  std::string z_label;
  double radius = 0;  // of the sphere; 0: there is none
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
  bool equal_aspect = false;        // a circle is a circle: the height follows from the data
  bool endpoints = false;           // ○ at the start of each curve, ● at its end
  bool points = false;              // ● at each row, for curves of few
  bool scattered = false;           // rows that are no curve: a dot for each, no line
  std::optional<Space> space = {};  // curves in space, then without axes
};

// With `rows`, the numbers of at most as many rows of each curve go along, for the script of a page.
// Then the <g class="panel"> has
//   data-x-name, data-y-name  the labels of the axes
//   data-area                 left, top, right and bottom of the plotted area, in pixels
//   data-view                 least and greatest x and y
//   data-origin               what has been subtracted from all x and all y
//   data-zone                 the greatest value within which each axis is linear; 0 on a logarithmic one
//   data-exponent             the power of ten that the labels at each axis leave out
//   data-equal                "equal" where a circle is a circle
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
