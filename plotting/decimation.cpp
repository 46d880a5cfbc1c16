#include "courant/plotting/decimation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace courant::plot {

namespace {

// The directions from an anchor that pass every vertex seen so far within the tolerance.
class Sleeve {
 public:
  Sleeve(Vertex anchor, double tolerance) : anchor_(anchor), tolerance_(tolerance) {}

  // Whether a straight line from the anchor to the vertex still passes all; if so, the sleeve
  // narrows.
  bool admits(Vertex vertex) {
    const double dx = vertex.x - anchor_.x, dy = vertex.y - anchor_.y;
    const double distance = std::hypot(dx, dy);
    if (distance <= tolerance_) return reach_ <= 2 * tolerance_;
    const double direction = std::atan2(dy, dx);
    if (reach_ == 0) axis_ = direction;
    const double angle = std::remainder(direction - axis_, 2 * std::numbers::pi);
    const bool turns_back = distance < reach_ - tolerance_;
    if (turns_back || angle < lower_ || angle > upper_) return false;
    const double half = std::asin(tolerance_ / distance);
    lower_ = std::max(lower_, angle - half);
    upper_ = std::min(upper_, angle + half);
    reach_ = std::max(reach_, distance);
    return true;
  }

 private:
  Vertex anchor_;
  double tolerance_;
  double axis_ = 0;
  double lower_ = -std::numbers::pi / 2, upper_ = std::numbers::pi / 2;
  double reach_ = 0;
};

}  // namespace

std::vector<Stretch> finite_stretches(std::span<const double> x, std::span<const double> y) {
  std::vector<Stretch> stretches;
  bool inside = false;
  for (std::size_t row = 0; row < x.size(); ++row) {
    const bool finite = std::isfinite(x[row]) && std::isfinite(y[row]);
    if (finite && !inside) stretches.push_back({row, row});
    if (finite) stretches.back().end = row + 1;
    inside = finite;
  }
  return stretches;
}

Envelope envelope(std::span<const double> x, std::span<const double> y, Interval interval,
                  int columns) {
  Envelope result;
  const double width = interval.length() / columns;
  int current = -1;
  for (std::size_t row = 0; row < x.size(); ++row) {
    const double piece = width > 0 ? std::floor((x[row] - interval.lower) / width) : 0;
    const int column = static_cast<int>(std::clamp(piece, 0.0, columns - 1.0));
    if (column != current) {
      result.x.push_back(interval.lower + (column + 0.5) * width);
      result.lower.push_back(y[row]);
      result.upper.push_back(y[row]);
      current = column;
    } else {
      result.lower.back() = std::min(result.lower.back(), y[row]);
      result.upper.back() = std::max(result.upper.back(), y[row]);
    }
  }
  return result;
}

std::vector<std::size_t> evenly_spaced_rows(std::size_t rows, std::size_t most) {
  std::vector<std::size_t> kept;
  const std::size_t count = std::min(rows, std::max<std::size_t>(most, 2));
  for (std::size_t i = 0; i < count; ++i)
    kept.push_back(count == 1 ? 0 : i * (rows - 1) / (count - 1));
  return kept;
}

std::size_t stretches_of_extrema(std::size_t most) { return (most - 2) / 2; }

std::vector<std::size_t> rows_of_extrema(std::span<const double> y, std::size_t most) {
  if (y.size() <= most || most < 4) return evenly_spaced_rows(y.size(), most);
  const std::size_t stretches = stretches_of_extrema(most);
  std::vector<std::size_t> kept = {0};
  for (std::size_t i = 0; i < stretches; ++i) {
    const std::size_t begin = 1 + i * (y.size() - 2) / stretches;
    const std::size_t end = 1 + (i + 1) * (y.size() - 2) / stretches;
    std::size_t least = begin, greatest = begin;
    for (std::size_t row = begin; row < end; ++row) {
      if (std::isnan(y[least]) || y[row] < y[least]) least = row;
      if (std::isnan(y[greatest]) || y[row] > y[greatest]) greatest = row;
    }
    const auto [earlier, later] = std::minmax(least, greatest);
    kept.push_back(earlier);
    if (later != earlier) kept.push_back(later);
  }
  kept.push_back(y.size() - 1);
  return kept;
}

std::vector<Vertex> simplified(std::span<const Vertex> path, double tolerance) {
  if (path.size() <= 2) return {path.begin(), path.end()};
  std::vector<Vertex> kept = {path.front()};
  Sleeve sleeve(path.front(), tolerance);
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (sleeve.admits(path[i])) continue;
    kept.push_back(path[i - 1]);
    sleeve = Sleeve(path[i - 1], tolerance);
    sleeve.admits(path[i]);
  }
  kept.push_back(path.back());
  return kept;
}

}  // namespace courant::plot
