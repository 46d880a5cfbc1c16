#include "courant/reporting/space_figures.hpp"

#include <algorithm>
#include <cmath>

namespace courant {

namespace {

using Kind = SpatialPoints::Kind;
using Columns = std::array<std::span<const double>, 3>;

bool is_momentum(const std::string& name) { return name.starts_with("p_"); }

Columns columns_of(const Run& run, const SpatialPoint& point) {
  Columns columns;
  for (std::size_t k = 0; k < 3; ++k) columns[k] = run.trajectory.column(point.columns[k]);
  return columns;
}

bool has(const Run& run, const SpatialPoint& point) {
  return std::ranges::all_of(
      point.columns, [&](const std::string& name) { return run.trajectory.contains(name); });
}

double norm(const Columns& columns, std::size_t row) {
  return std::hypot(columns[0][row], columns[1][row], columns[2][row]);
}

// The length that a point has in all rows, to a thousandth; 0 if it has not.
double common_norm(const Run& run, const SpatialPoint& point) {
  const Columns columns = columns_of(run, point);
  plot::Interval norms;
  for (std::size_t row = 0; row < run.trajectory.rows(); ++row) norms.include(norm(columns, row));
  constexpr double alike = 1e-3;
  return !norms.empty() && norms.length() <= alike * norms.upper ? norms.upper : 0;
}

// The three columns of array[3][3], where array[0][0] is `name`; none where it is no rotation.
std::vector<SpatialPoint> body_axes(const Run& run, const std::string& name) {
  const std::string array = name.substr(0, name.size() - 6);
  const auto entry = [&](int i, int j) {
    return array + "[" + std::to_string(i) + "][" + std::to_string(j) + "]";
  };
  const auto value = [&](int i, int j) { return run.trajectory.column(entry(i, j))[0]; };
  if (run.trajectory.contains(entry(3, 0)) || run.trajectory.contains(entry(0, 3))) return {};
  constexpr std::array<const char*, 3> names = {"e₁", "e₂", "e₃"};
  std::vector<SpatialPoint> axes;
  for (int j = 0; j < 3; ++j) {
    axes.push_back({{entry(0, j), entry(1, j), entry(2, j)},
                    array + " " + names[static_cast<std::size_t>(j)]});
    if (!has(run, axes.back())) return {};
  }
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k <= j; ++k) {
      double product = 0;
      for (int i = 0; i < 3; ++i) product += value(i, j) * value(i, k);
      constexpr double about = 1e-6;
      if (!(std::abs(product - (j == k ? 1 : 0)) < about)) return {};
    }
  }
  return axes;
}

// Whether a formula of the system takes the array for a vector: norm(q), dot(q, e), cross(w, q).
bool is_vector(const Run& run, const std::string& array) {
  if (!run.experiment.is_object() || !run.experiment.contains("system")) return false;
  const std::string text = run.experiment["system"].dump();
  for (const std::string function : {"norm(", "dot(", "cross("})
    for (std::size_t at = text.find(function); at != std::string::npos;
         at = text.find(function, at + 1)) {
      const std::size_t first = at + function.size(), end = text.find(')', first);
      std::string arguments = text.substr(first, end - first);
      std::erase(arguments, ' ');
      if (("," + arguments + ",").find("," + array + ",") != std::string::npos) return true;
    }
  return false;
}

// The points by their names, and whether they are surely in space.
struct Candidate {
  SpatialPoint point;
  bool is_place;
};

std::vector<Candidate> candidates(const Run& run, const std::vector<std::string>& coordinates) {
  std::vector<Candidate> found;
  const auto exists = [&](const std::string& name) {
    return std::find(coordinates.begin(), coordinates.end(), name) != coordinates.end();
  };
  for (const std::string& name : coordinates) {
    if (is_momentum(name)) continue;
    SpatialPoint point;
    bool is_place = true;
    const std::size_t head = name.find_first_of("[0123456789");
    const std::string index = head == std::string::npos ? "" : name.substr(head);
    if (name.substr(0, head) == "x" && exists("y" + index)) {
      point = {{name, "y" + index, "z" + index}, "(" + name + ", y" + index + ", z" + index + ")"};
    } else if (name.ends_with("[0]")) {
      const std::string array = name.substr(0, name.size() - 3);
      if (exists(array + "[3]") || !body_axes(run, name.substr(0, head) + "[0][0]").empty())
        continue;
      point = {{name, array + "[1]", array + "[2]"}, array};
      is_place = array.ends_with("]") || array == "x" || array == "r" || is_vector(run, array);
    }
    if (std::ranges::all_of(point.columns, exists)) found.push_back({point, is_place});
  }
  return found;
}

bool is_flat(const Run& run, const std::vector<SpatialPoint>& points) {
  return std::ranges::all_of(points, [&](const SpatialPoint& point) {
    plot::Interval extent, z;
    for (const auto& column : columns_of(run, point)) extent.include(column);
    z.include(run.trajectory.column(point.columns[2]));
    return z.length() <= 1e-9 * extent.length();
  });
}

// The first rows that can be told apart: paths no longer than forty times the picture; at least 50.
std::size_t legible_rows(const Run& run, const SpatialPoints& all) {
  constexpr double longest = 40;
  constexpr std::size_t fewest = 50;
  const std::size_t rows = run.trajectory.rows();
  std::size_t legible = rows;
  for (const SpatialPoint& point : all.points) {
    const Columns columns = columns_of(run, point);
    plot::Interval extent;
    double length = 0;
    for (std::size_t row = 0; row < legible; ++row) {
      for (const auto& column : columns) extent.include(column[row]);
      if (row > 0) {
        const double step =
            std::hypot(columns[0][row] - columns[0][row - 1], columns[1][row] - columns[1][row - 1],
                       columns[2][row] - columns[2][row - 1]);
        if (std::isfinite(step)) length += step;
      }
      if (row >= fewest && length > longest * extent.length()) legible = row;
    }
  }
  return legible;
}

// Whether the rows are so far apart that lines between them would be chords: half of the steps are
// longer than a quarter of the extent.
bool is_coarse(const plot::Series& series) {
  plot::Interval extent;
  extent.include(series.x);
  extent.include(series.y);
  extent.include(series.z);
  std::vector<double> steps;
  for (std::size_t row = 1; row < series.x.size(); ++row) {
    const double step =
        std::hypot(series.x[row] - series.x[row - 1], series.y[row] - series.y[row - 1],
                   series.z[row] - series.z[row - 1]);
    if (std::isfinite(step)) steps.push_back(step);
  }
  if (steps.size() < 10) return false;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle > extent.length() / 4;
}

plot::Panel panel_of(const Run& run, const SpatialPoints& all, std::size_t rows) {
  plot::Panel panel;
  const bool named = all.points.size() == 1 && all.kind != Kind::body_axes;
  const auto label = [&](std::size_t k, const char* otherwise) {
    return named ? run.axis_label(all.points[0].columns[k]) : otherwise;
  };
  panel.x.label = label(0, "x");
  panel.y.label = label(1, "y");
  panel.space = plot::Space{label(2, "z"), all.radius};
  panel.endpoints = true;
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    if (!has(run, all.points[i])) continue;
    const Columns columns = columns_of(run, all.points[i]);
    panel.series.push_back(
        {all.points[i].label, first_rows(columns[0], rows), first_rows(columns[1], rows), i,
         first_rows(run.trajectory.column("t"), rows), first_rows(columns[2], rows)});
  }
  // All of them in one way, that of most.
  const auto coarse = static_cast<std::size_t>(std::ranges::count_if(panel.series, is_coarse));
  panel.points = 2 * coarse > panel.series.size();
  return panel;
}

Figure figure_of(std::span<const Run> runs, const SpatialPoints& all) {
  constexpr double narrow = 352;
  const std::vector<std::string> labels = run_labels(runs);
  Figure figure;
  bool whole = true;
  double until = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Run& run = runs[i];
    if (run.trajectory.rows() == 0 ||
        !std::ranges::any_of(all.points,
                             [&](const SpatialPoint& point) { return has(run, point); }))
      continue;
    SpatialPoints present = all;
    std::erase_if(present.points, [&](const SpatialPoint& point) { return !has(run, point); });
    const std::size_t rows = legible_rows(run, present);
    whole = whole && rows == run.trajectory.rows();
    until = std::max(until, run.trajectory.column("t")[rows - 1]);
    plot::Panel panel = panel_of(run, all, rows);
    panel.width = runs.size() > 1 ? narrow : 480;
    panel.height = runs.size() > 1 ? narrow : 440;
    panel.heading = runs.size() > 1 ? labels[i] : "";
    panel.title = "Paths: " + labels[i];
    panel.description = "The paths of " + std::to_string(panel.series.size()) +
                        (panel.series.size() == 1 ? " point" : " points") +
                        (all.kind == Kind::space ? " in space." : " on a sphere.");
    if (figure.legend.empty() && panel.series.size() > 1 &&
        panel.series.size() <= plot::palette().size())
      for (const plot::Series& one : panel.series) figure.legend.push_back({one.label, one.colour});
    figure.panels.push_back(std::move(panel));
  }
  const std::string what =
      all.kind == Kind::body_axes ? "The paths of the body's axes on the sphere"
      : all.kind == Kind::sphere ? "The paths on the sphere of radius " + plot::readable(all.radius)
                                 : "The paths in space";
  figure.caption =
      what + (whole ? ", " : ", the beginning, ") + "t ≤ " + plot::readable(until) +
      (all.kind == Kind::space ? ". ○ start, ● end." : "; the far side is paler. ○ start, ● end.");
  if (std::ranges::any_of(figure.panels, &plot::Panel::points))
    figure.caption += " A point for each row.";
  figure.name = all.kind == Kind::body_axes ? "axes"
                : all.kind == Kind::sphere  ? "sphere"
                                            : "space";
  return figure;
}

}  // namespace

std::vector<SpatialPoints> spatial_points(const Run& run) {
  if (run.trajectory.rows() == 0) return {};
  const std::vector<std::string> coordinates = run.coordinates();
  std::vector<SpatialPoints> all;
  for (const std::string& name : coordinates) {
    if (!name.ends_with("[0][0]") || is_momentum(name)) continue;
    if (auto axes = body_axes(run, name); !axes.empty())
      all.push_back({Kind::body_axes, 1, std::move(axes)});
  }
  SpatialPoints space{Kind::space, 0, {}};
  for (const auto& [point, is_place] : candidates(run, coordinates)) {
    const double radius = common_norm(run, point);
    if (radius == 0) {
      if (is_place) space.points.push_back(point);
      continue;
    }
    const auto same = std::ranges::find_if(all, [&](const SpatialPoints& other) {
      return other.kind == Kind::sphere && std::abs(other.radius - radius) <= 1e-3 * radius;
    });
    if (same == all.end())
      all.push_back({Kind::sphere, radius, {point}});
    else
      same->points.push_back(point);
  }
  if (!space.points.empty() && !is_flat(run, space.points)) all.push_back(std::move(space));
  return all;
}

std::vector<Figure> space_figures(std::span<const Run> runs) {
  std::vector<Figure> figures;
  if (runs.empty()) return figures;
  for (const SpatialPoints& points : spatial_points(runs[0])) {
    Figure figure = figure_of(runs, points);
    const auto same = std::ranges::count_if(
        figures, [&](const Figure& other) { return other.name.starts_with(figure.name); });
    if (same > 0) figure.name += "-" + std::to_string(same + 1);
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace courant
