// What one panel of a figure shows: curves over two axes, or in space.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "courant/plotting/scale.hpp"

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

// An axis of a panel: what stands beside it, how numbers lie along it, and which of them it shows.
struct Axis {
  std::string label;
  std::shared_ptr<const Scale> scale = std::make_shared<LinearScale>();
  Interval interval = {};  // empty: what the series need
  bool is_window = false;  // shows the interval and no more: curves are cut off there
};

// How curves (x, y, z) in space are seen: from a side, all in a cube about them; or on a sphere about
// the origin, whose far side is paler.
struct Space {
  std::string z_label;
  double radius = 0;  // of the sphere; 0: there is none
};

// A rod between the points of two curves, or between that of one and the origin: drawn by the script of a page at the
// moment that it shows.
struct Rod {
  std::size_t from = 0;                // a series
  std::optional<std::size_t> to = {};  // another one; nothing: the origin
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
  bool scattered = false;     // rows that are no curve: a dot for each, no line
  std::vector<Rod> rods = {};
  std::optional<Space> space = {};  // curves in space, then without axes
};

}  // namespace courant::plot
