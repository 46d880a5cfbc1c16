// The numbers of a curve that go along with its picture, for the script of a page.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "courant/plotting/panel.hpp"
#include "courant/plotting/svg.hpp"

namespace courant::plot {

// Times first + k·distance of the rows k, except that of the last row.
struct EvenTimes {
  double first, distance, last;
};

// The times of at least three rows that are even to a millionth of their distance; nothing where
// they are not.
std::optional<EvenTimes> even_times(std::span<const double> times);

// Rows of a series and their numbers, as attributes of its <g class="series">:
//   data-rows       the number of all its rows
//   data-stretches  n > 0: the first row, the last one, and of n equal stretches between them those
//                   of the least and of the greatest y are here; 0: all rows, or rows at equal
//                   distances, as evenly_spaced_rows() has them
//   data-steps      with stretches: from each of these rows to the next one, how many rows; unsigned,
//                   little-endian, of one, two or four bytes each, in base64
//   data-times      of even times their first, distance and last
//   data-x, data-y, data-z, data-t  the numbers, as float_text() writes them. A z or a t only where
//                   the series has them; no times, which are x or t, where they are even.
// What is not there is an empty text.
struct CurveData {
  std::size_t rows = 0, stretches = 0;
  std::string steps, times, x, y, z, t;
};

// Of at most `most` rows of the series; of one in space of at most 4000, because it is drawn anew
// whenever it turns. `origin` is subtracted from x and y.
CurveData curve_data(const Series& series, std::size_t most, std::array<double, 2> origin = {});

// <g class="STYLE" data-…>content</g>
Markup with_data(std::string_view style, const CurveData& data, const Markup& content);

// The greatest number of rows of each of some series of which all together have at most as many
// letters in their attributes; at least 16.
std::size_t rows_that_fit(std::span<const Series* const> all, std::size_t letters);

}  // namespace courant::plot
