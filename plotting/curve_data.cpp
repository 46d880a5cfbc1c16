#include "courant/plotting/curve_data.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "courant/plotting/decimation.hpp"
#include "courant/plotting/drawing.hpp"

namespace courant::plot {

namespace {

constexpr std::size_t most_in_space = 4000;

bool is_over_time(const Series& series) { return series.t.empty(); }
bool is_in_space(const Series& series) { return !series.z.empty(); }

std::span<const double> times_of(const Series& series) {
  return is_over_time(series) ? series.x : series.t;
}

std::size_t rows_of(const Series& series, std::size_t most) {
  return std::min({series.x.size(), most, is_in_space(series) ? most_in_space : most});
}

// One, two or four bytes of each step between the rows.
std::string step_text(std::span<const std::size_t> rows) {
  std::size_t longest = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) longest = std::max(longest, rows[i] - rows[i - 1]);
  const int width = longest < 1u << 8 ? 1 : longest < 1u << 16 ? 2 : 4;
  std::string bytes;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    for (int byte = 0; byte < width; ++byte)
      bytes += static_cast<char>((rows[i] - rows[i - 1]) >> 8 * byte & 255u);
  }
  return base64(bytes);
}

// Letters in the attributes for each row that goes along: four of base64 for three bytes.
double letters_a_row(const Series& series) {
  const double times = even_times(times_of(series)) ? 0 : 1;
  const double numbers = is_over_time(series) ? times + 1 : times + (is_in_space(series) ? 3 : 2);
  return (4 * numbers + (is_over_time(series) ? 1 : 0)) * 4 / 3;
}

}  // namespace

std::optional<EvenTimes> even_times(std::span<const double> times) {
  if (times.size() < 3) return std::nullopt;
  const double steps = static_cast<double>(times.size() - 2);
  const EvenTimes even{times.front(), (times[times.size() - 2] - times.front()) / steps,
                       times.back()};
  if (!(even.distance > 0) || !std::isfinite(even.distance) || !std::isfinite(even.last))
    return std::nullopt;
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    const double defect = times[k] - (even.first + static_cast<double>(k) * even.distance);
    if (!(std::abs(defect) <= 1e-6 * even.distance)) return std::nullopt;
  }
  return even;
}

CurveData curve_data(const Series& series, std::size_t most, std::array<double, 2> origin) {
  CurveData data;
  data.rows = series.x.size();
  const std::size_t count = rows_of(series, most);
  const bool thinned = is_over_time(series) && data.rows > count && count >= 4;
  const std::vector<std::size_t> rows =
      thinned ? rows_of_extrema(series.y, count) : evenly_spaced_rows(data.rows, count);
  if (thinned) {
    data.stretches = stretches_of_extrema(count);
    data.steps = step_text(rows);
  }
  const auto even = even_times(times_of(series));
  if (even) data.times = number_list({even->first, even->distance, even->last});
  if (!is_over_time(series) || !even) data.x = float_text(series.x, rows, origin[0]);
  data.y = float_text(series.y, rows, origin[1]);
  if (is_in_space(series)) data.z = float_text(series.z, rows);
  if (!is_over_time(series) && !even) data.t = float_text(series.t, rows);
  return data;
}

Markup with_data(std::string_view style, const CurveData& data, const Markup& content) {
  return element("g",
                 {{"class", style},
                  {"stroke-linejoin", "round"},
                  {"data-rows", static_cast<double>(data.rows)},
                  {"data-stretches", static_cast<double>(data.stretches)},
                  {"data-steps", data.steps},
                  {"data-times", data.times},
                  {"data-x", data.x},
                  {"data-y", data.y},
                  {"data-z", data.z},
                  {"data-t", data.t}},
                 content);
}

std::size_t rows_that_fit(std::span<const Series* const> all, std::size_t letters) {
  struct Cost {
    const Series* series;
    double letters;
  };
  std::vector<Cost> costs;
  std::size_t longest = 0;
  for (const Series* series : all) {
    costs.push_back({series, letters_a_row(*series)});
    longest = std::max(longest, series->x.size());
  }
  const auto fit = [&](std::size_t rows) {
    double needed = 0;
    for (const Cost& cost : costs)
      needed += cost.letters * static_cast<double>(rows_of(*cost.series, rows));
    return needed <= static_cast<double>(letters);
  };
  std::size_t fitting = 16, too_many = longest + 1;
  while (too_many > fitting + 1) {
    const std::size_t middle = fitting + (too_many - fitting) / 2;
    (fit(middle) ? fitting : too_many) = middle;
  }
  return fitting;
}

}  // namespace courant::plot
