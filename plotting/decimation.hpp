// Fewer vertices for the same picture: what is left out cannot be seen at the size it is drawn.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "courant/plotting/scale.hpp"

namespace courant::plot {

// A point of a curve.
struct Vertex {
  double x, y;
};

// The rows of a curve between two that are not finite: [begin, end).
struct Stretch {
  std::size_t begin, end;
  std::size_t size() const { return end - begin; }
};

// The maximal stretches of rows in which both x and y are finite.
std::vector<Stretch> finite_stretches(std::span<const double> x, std::span<const double> y);

// A function of x seen through `columns` equal pieces of an interval: in each piece that has rows,
// the least and the greatest value. So the extrema are kept, whatever the number of rows.
struct Envelope {
  std::vector<double> x, lower, upper;
};

// x is increasing and finite, y finite, of the same size; rows outside the interval count in its
// end pieces.
Envelope envelope(std::span<const double> x, std::span<const double> y, Interval interval,
                  int columns);

// At most `most` ≥ 2 rows that stand for all, in order, with the first and the last. All rows where
// they are few enough.
//
// As many as fit at equal distances: row ⌊i (rows - 1) / (count - 1)⌋ for i < count.
std::vector<std::size_t> evenly_spaced_rows(std::size_t rows, std::size_t most);
// With the extrema: the rows of the least and of the greatest value in s = stretches_of_extrema()
// equal stretches, so that a spike stays; stretch i begins at row 1 + ⌊i (rows - 2) / s⌋.
std::vector<std::size_t> rows_of_extrema(std::span<const double> y, std::size_t most);
std::size_t stretches_of_extrema(std::size_t most);

// A polyline through some of the vertices of `path`, the first and the last among them, from which
// none of the others is farther than `tolerance`. Linear time: one vertex after the other is left
// out while a ray from the last one kept passes all of them (the sleeve of Zhao and Saalfeld, 1997)
// and moves on.
std::vector<Vertex> simplified(std::span<const Vertex> path, double tolerance);

}  // namespace courant::plot
