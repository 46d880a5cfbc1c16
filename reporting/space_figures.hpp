// Motion in space, on spheres, and of bodies that turn, as pictures.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "courant/reporting/run_figure.hpp"

namespace courant {

// A point of space whose three coordinates are columns of a run.
struct SpatialPoint {
  std::array<std::string, 3> columns;
  std::string label;
};

// The points of a run that belong into one picture.
struct SpatialPoints {
  enum class Kind { body_axes, sphere, space } kind;
  double radius = 0;  // of the sphere
  std::vector<SpatialPoint> points;
};

// What a run has of them, told by its rows:
//   body_axes  the columns of each array R[3][3] that is orthogonal in the first row
//   sphere     arrays of three, (x, y, z), (x[i], y[i], z[i]) and (xi, yi, zi) with |x| the same in all
//              rows, to a thousandth; one for each radius
//   space      the other ones of these that are no generalised coordinates: arrays x and r, a[i][3],
//              those named x, y, z, and q[3] where a formula of the system has norm(q), dot(q, …) or
//              cross(…, q). None where all stay in a plane z = constant.
std::vector<SpatialPoints> spatial_points(const Run& run);

// A picture of each of these that the first run has, with a panel for each run that has it too. Their
// names are axes, sphere and space.
std::vector<Figure> space_figures(std::span<const Run> runs);

}  // namespace courant
