// Curves in space, as they are seen from a side.
#pragma once

#include <cstddef>

#include "courant/plotting/panel.hpp"
#include "courant/plotting/svg.hpp"

namespace courant::plot {

// The curves of a panel that has `space`. A point (x, y, z) is seen at
//   p = (x, y, z) - centre,  (a, b, c) = (p·right, p·up, p·toward) / size,
//   pixel = middle + scale (a, -b) w,  w = d / (d - c),
// with the unit vectors right, up and toward the eye of the camera's azimuth and elevation, and the
// distance d of the eye; w = 1 on a sphere, which is seen from infinity. Behind the curves is a
// graticule of the sphere, or the cube centre ± size. A panel with `points` has a point at each row and no
// line.
//
// With `rows`, the <g class="panel"> has data-area and
//   data-space   the centre's x, y and z, size, middle's x and y, scale, d (0: infinity)
//   data-camera  azimuth and elevation in radians
//   data-points  "points" where there is a point at each row and no line
//   data-x-name, data-y-name, data-z-name
// and each <g class="series"> has its CurveData.
Markup draw_in_space(const Panel& panel, std::size_t rows);

}  // namespace courant::plot
