// Which figures tell the story of some runs.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "courant/reporting/run_figure.hpp"
#include "courant/running/run_files.hpp"

namespace courant {

// The names of a body's two coordinates in the plane.
using PlanarBody = std::pair<std::string, std::string>;
// The bodies among some coordinates: (x, y), (x[i], y[i]), (xi, yi); (a[i][0], a[i][1]) of any
// array of points; (r[0], r[1]).
std::vector<PlanarBody> planar_bodies(std::span<const std::string> coordinates);

// The first rows of planar curves that can be told apart in one picture: all of them, or as many as
// stay in a box eight times as long as wide and make no path longer than forty of its diagonals.
// Where these are less than 50, as many as make no path longer than forty diagonals of the box of
// all rows, and at least 50.
std::size_t legible_rows(const TrajectoryTable& trajectory, std::span<const PlanarBody> bodies);

// The motion. A system with two coordinates: its phase portrait and both over time. One with three that are a point in
// space: its path and all three over time. With rotations,
// points of spheres, points in space, planar bodies or observed points P_x, P_y of the plane: the paths of
// all of these, a panel for each run; a page draws rods between points that constraints hold at one distance. Any other: its coordinates over time, the first twelve. Poincaré sections after that.
std::vector<Figure> motion_figures(std::span<const Run> runs);

// Every observable over time that is not in the pictures of the energy.
std::optional<Figure> observable_figure(std::span<const Run> runs);

// Some columns over time: each in a panel of its own, or all of them in one, whose axis has the unit that they share. Throws
// std::invalid_argument for a column that no run has.
Figure chosen_figure(std::span<const Run> runs, std::span<const std::string> columns, bool overlay);

// The greatest |constraint[i]| over time, of the runs that have constraints.
std::optional<Figure> constraint_figure(std::span<const Run> runs);

// All of these and those of the energy, in the order of a report. Their names are phase, coordinates,
// axes, sphere, space, paths, section, energy-balance, energy, energy-detail, constraints, observables.
std::vector<Figure> all_figures(std::span<const Run> runs);

}  // namespace courant
