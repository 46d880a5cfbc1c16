// Which figures tell the story of some runs.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "courant/plotting/figure.hpp"
#include "courant/running/run_files.hpp"

namespace courant {

// Panels that belong together, with one legend and one caption.
struct Figure {
  std::vector<plot::Panel> panels;
  std::vector<plot::LegendEntry> legend;
  std::string caption;
};

// How the runs are told apart: by their methods, or by their folders where methods repeat.
std::vector<std::string> run_labels(std::span<const Run> runs);

// The names of a body's two coordinates in the plane.
using PlanarBody = std::pair<std::string, std::string>;
// The bodies among some coordinates: (x, y), (x[i], y[i]), (xi, yi); (a[i][0], a[i][1]) of any
// array of points; (r[0], r[1]).
std::vector<PlanarBody> planar_bodies(std::span<const std::string> coordinates);

// The first rows of planar curves that can be told apart in one picture: all of them, or as many as
// stay in a box eight times as long as wide and make no path longer than forty of its diagonals. At
// least 50.
std::size_t legible_rows(const TrajectoryTable& trajectory, std::span<const PlanarBody> bodies);

// The motion. A system with two coordinates: its phase portrait and both over time. With planar
// bodies: their trajectories, a panel for each run. Any other: its coordinates over time, the first
// twelve.
std::vector<Figure> motion_figures(std::span<const Run> runs);

// H - H(0) of all runs that have H, on a symmetric-log axis; then, when the greatest errors are a
// decade or more above all others, the others alone on a linear axis: of long runs their beginning,
// and the whole.
std::vector<Figure> energy_figures(std::span<const Run> runs);

// Every other observable over time.
std::optional<Figure> observable_figure(std::span<const Run> runs);

// The greatest |constraint[i]| over time, of the runs that have constraints.
std::optional<Figure> constraint_figure(std::span<const Run> runs);

// The threshold of a symmetric-log axis that shows all of the curves: a decade below the greatest
// value of the smallest, but no more than twelve decades below the greatest of all; a power of ten.
double symmetric_log_threshold(std::span<const plot::Series> series);

}  // namespace courant
