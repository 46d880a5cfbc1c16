#include "courant/reporting/report_figures.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/core/words/text_layout.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/reporting/energy_figures.hpp"
#include "courant/reporting/section_figures.hpp"
#include "courant/reporting/space_figures.hpp"

namespace courant {

namespace {

using plot::Interval;
using plot::LegendEntry;
using plot::Panel;
using plot::Series;

constexpr double narrow = 352, narrow_height = 200;  // two panels abreast
constexpr std::size_t most_small_panels = 12;

// An entry for each series, when there is something to tell apart.
std::vector<LegendEntry> entries(std::span<const Series> series) {
  std::vector<LegendEntry> legend;
  if (series.size() < 2) return legend;
  // More colours than there are cannot be told apart.
  const std::size_t most = plot::palette().size();
  for (const Series& one : series.first(std::min(series.size(), most)))
    legend.push_back({one.label, one.colour});
  if (series.size() > most)
    legend.push_back(
        {"and " + std::to_string(series.size() - most) + " more", series[most].colour});
  return legend;
}

// A panel for each column, over time, all runs in each; two abreast.
Figure over_time(std::span<const Run> runs, std::span<const std::string> columns,
                 std::string caption, std::string name) {
  Figure figure;
  figure.name = std::move(name);
  for (const std::string& column :
       columns.subspan(0, std::min(columns.size(), most_small_panels))) {
    Panel panel;
    panel.title = column + " over time";
    panel.x.label = axis_label(runs, "t");
    panel.y.label = axis_label(runs, column);
    panel.series = columns_over_time(runs, column);
    panel.description = counted(std::ssize(panel.series), "curve") + ".";
    if (columns.size() > 1) panel.width = narrow, panel.height = narrow_height;
    if (figure.legend.empty()) figure.legend = entries(panel.series);
    figure.panels.push_back(std::move(panel));
  }
  if (columns.size() > most_small_panels) {
    caption += " The first " + std::to_string(most_small_panels) + " of " +
               std::to_string(columns.size()) + ".";
  }
  figure.caption = std::move(caption);
  return figure;
}

Figure phase_portrait(std::span<const Run> runs, const std::string& q, const std::string& p) {
  const std::vector<std::string> labels = run_labels(runs);
  const PlanarBody plane{q, p};
  Panel panel;
  panel.title = "Phase portrait";
  panel.x.label = axis_label(runs, q);
  panel.y.label = axis_label(runs, p);
  panel.width = 480;
  panel.height = 360;
  panel.endpoints = true;
  bool all = true;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const TrajectoryTable& table = runs[i].trajectory;
    if (!table.contains(q) || !table.contains(p)) continue;
    const std::size_t rows = legible_rows(table, std::span(&plane, 1));
    all = all && rows == table.rows();
    panel.series.push_back({labels[i], first_rows(table.column(q), rows),
                            first_rows(table.column(p), rows), i,
                            first_rows(table.column("t"), rows)});
  }
  panel.description =
      "The curves (" + q + ", " + p + ") of " + counted(std::ssize(panel.series), "run") + ".";
  const std::string part = all ? "" : " Only the first rows of long runs are drawn.";
  return {{panel}, entries(panel.series), "Phase portrait. ○ start, ● end." + part, "phase"};
}

// Points that a run observes: the columns P_x and P_y.
std::vector<PlanarBody> observed_points(const Run& run) {
  const std::vector<std::string> observables = run.observables();
  std::vector<PlanarBody> points;
  for (const std::string& name : observables) {
    if (!name.ends_with("_x")) continue;
    const std::string partner = name.substr(0, name.size() - 1) + "y";
    if (std::ranges::find(observables, partner) != observables.end())
      points.emplace_back(name, partner);
  }
  return points;
}

// Whether points of the system are held by constraints on their places.
bool has_links(const Run& run) {
  const auto system = run.experiment.find("system");
  if (system == run.experiment.end() || !system->is_object()) return false;
  return system->contains("holonomic") || system->value("type", "") == "implicit";
}

// Where two points are as far from each other in all rows, or one from the origin: the distance changes by less than a
// hundredth of how far one moves about the other. Not between points that do not move.
std::vector<plot::Rod> rods_between(std::span<const Series> series) {
  constexpr double alike = 1e-2;
  constexpr std::size_t most = 12;
  if (series.size() > most) return {};
  const auto is_rod = [](const Series& from, const Series* to) {
    Interval length, x, y;
    for (std::size_t row = 0; row < from.x.size(); ++row) {
      const double dx = from.x[row] - (to != nullptr ? to->x[row] : 0.0);
      const double dy = from.y[row] - (to != nullptr ? to->y[row] : 0.0);
      x.include(dx);
      y.include(dy);
      length.include(std::hypot(dx, dy));
    }
    return length.upper > 0.0 && length.length() <= alike * std::max(x.length(), y.length());
  };
  const auto moves = [](const Series& one) {
    Interval x, y;
    x.include(one.x);
    y.include(one.y);
    return x.length() > 0.0 || y.length() > 0.0;
  };
  std::vector<plot::Rod> rods;
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (moves(series[i]) && is_rod(series[i], nullptr)) rods.push_back({i, std::nullopt});
    for (std::size_t j = i + 1; j < series.size(); ++j)
      if ((moves(series[i]) || moves(series[j])) && is_rod(series[i], &series[j]))
        rods.push_back({i, j});
  }
  return rods;
}

// Of the coordinates A_x and A_y it is A.
std::string name_of_point(const std::string& first, const std::string& second) {
  if (first.size() > 2 && first.ends_with("_x") && second.ends_with("_y") &&
      std::string_view(first).substr(0, first.size() - 2) ==
          std::string_view(second).substr(0, second.size() - 2))
    return first.substr(0, first.size() - 2);
  return "(" + first + ", " + second + ")";
}

Figure planar_figure(std::span<const Run> runs, std::span<const PlanarBody> bodies) {
  const std::vector<std::string> labels = run_labels(runs);
  Figure figure;
  figure.name = "paths";
  Interval x, y;
  bool all = true;
  double until = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const TrajectoryTable& table = runs[i].trajectory;
    Panel panel;
    panel.title = "Trajectories: " + labels[i];
    panel.heading = runs.size() > 1 ? labels[i] : "";
    panel.x.label = bodies.size() == 1 ? axis_label(runs, bodies[0].first) : "x";
    panel.y.label = bodies.size() == 1 ? axis_label(runs, bodies[0].second) : "y";
    panel.equal_aspect = panel.endpoints = true;
    std::vector<PlanarBody> present;
    std::copy_if(bodies.begin(), bodies.end(), std::back_inserter(present),
                 [&](const PlanarBody& body) {
                   return table.contains(body.first) && table.contains(body.second);
                 });
    if (present.empty() || table.rows() == 0) continue;
    const std::size_t rows = legible_rows(table, present);
    all = all && rows == table.rows();
    until = std::max(until, table.column("t")[rows - 1]);
    for (std::size_t b = 0; b < present.size(); ++b) {
      const auto& [first_name, second_name] = present[b];
      panel.series.push_back(
          {name_of_point(first_name, second_name), first_rows(table.column(first_name), rows),
           first_rows(table.column(second_name), rows), b, first_rows(table.column("t"), rows)});
      x.include(panel.series.back().x);
      y.include(panel.series.back().y);
    }
    if (has_links(runs[i])) panel.rods = rods_between(panel.series);
    const bool is_hinged =
        std::ranges::any_of(panel.rods, [](const plot::Rod& rod) { return !rod.to.has_value(); });
    if (is_hinged) x.include(0.0), y.include(0.0);
    panel.description = "The paths of " + counted(std::ssize(present), "point") + " in the plane.";
    if (figure.legend.empty() && present.size() <= plot::palette().size()) {
      figure.legend = entries(panel.series);
    }
    figure.panels.push_back(std::move(panel));
  }
  for (Panel& panel : figure.panels) panel.x.interval = x, panel.y.interval = y;
  figure.caption = std::string("Trajectories in the plane, ") + (all ? "" : "the beginning, ") +
                   "t ≤ " + plot::readable(until) + ". ○ start, ● end.";
  return figure;
}

}  // namespace

std::vector<PlanarBody> planar_bodies(std::span<const std::string> coordinates) {
  const auto exists = [&](const std::string& name) {
    return std::find(coordinates.begin(), coordinates.end(), name) != coordinates.end();
  };
  std::vector<PlanarBody> bodies;
  for (const std::string& name : coordinates) {
    const std::size_t head = name.find_first_of("[0123456789");
    if (name.substr(0, head) == "x") {
      const std::string partner = "y" + name.substr(1);
      if (exists(partner)) bodies.emplace_back(name, partner);
    } else if (name.ends_with("[0]") && (name.find("][") != std::string::npos || name == "r[0]") &&
               !name.starts_with("p_")) {
      const std::string array = name.substr(0, name.size() - 3);
      const bool in_space = exists(array + "[3]");
      if (exists(array + "[1]") && !in_space) bodies.emplace_back(name, array + "[1]");
    }
  }
  return bodies;
}

std::size_t legible_rows(const TrajectoryTable& trajectory, std::span<const PlanarBody> bodies) {
  constexpr double longest_box = 8, longest_path = 40;
  constexpr std::size_t fewest = 50;
  struct Path {
    std::span<const double> x, y;
    double length = 0;
  };
  std::vector<double> lengths;  // of the longest path up to each row
  std::vector<Path> paths;
  for (const auto& [x, y] : bodies) paths.push_back({trajectory.column(x), trajectory.column(y)});
  Interval width, height;
  std::size_t legible = 0;
  for (std::size_t row = 0; row < trajectory.rows(); ++row) {
    double longest = 0;
    for (Path& path : paths) {
      width.include(path.x[row]);
      height.include(path.y[row]);
      if (row > 0) {
        const double step =
            std::hypot(path.x[row] - path.x[row - 1], path.y[row] - path.y[row - 1]);
        if (std::isfinite(step)) path.length += step;
      }
      longest = std::max(longest, path.length);
    }
    lengths.push_back(longest);
    const auto [shorter, longer] = std::minmax({width.length(), height.length()});
    const double diagonal = std::hypot(shorter, longer);
    if (longer <= longest_box * shorter && longest <= longest_path * diagonal) legible = row + 1;
  }
  if (legible >= fewest) return legible;
  const double diagonal = std::hypot(width.length(), height.length());
  const auto end = std::ranges::upper_bound(lengths, longest_path * diagonal);
  return std::min(trajectory.rows(),
                  std::max(fewest, static_cast<std::size_t>(end - lengths.begin())));
}

namespace {

std::vector<Figure> curves_of_motion(std::span<const Run> runs) {
  const std::vector<std::string> coordinates = runs[0].coordinates();
  if (coordinates.empty()) return {};
  const std::string caption = "The coordinates over time.";
  if (coordinates.size() == 2) {
    return {phase_portrait(runs, coordinates[0], coordinates[1]),
            over_time(runs, coordinates, caption, "coordinates")};
  }
  std::vector<Figure> figures = space_figures(runs);
  std::vector<PlanarBody> bodies = planar_bodies(coordinates);
  if (has_links(runs[0])) std::ranges::copy(observed_points(runs[0]), std::back_inserter(bodies));
  // What is seen in space is not seen in a plane once more; rows of a rotation are no places.
  for (const SpatialPoints& seen : spatial_points(runs[0])) {
    std::erase_if(bodies, [&](const PlanarBody& body) {
      return std::ranges::any_of(seen.points, [&](const SpatialPoint& point) {
        return std::ranges::find(point.columns, body.first) != point.columns.end();
      });
    });
  }
  if (!bodies.empty()) figures.push_back(planar_figure(runs, bodies));
  const bool is_one_point =
      coordinates.size() == 3 && std::ranges::count(figures, "space", &Figure::name) > 0;
  if (figures.empty() || is_one_point)
    figures.push_back(over_time(runs, coordinates, caption, "coordinates"));
  return figures;
}

}  // namespace

std::vector<Figure> motion_figures(std::span<const Run> runs) {
  if (runs.empty()) return {};
  std::vector<Figure> figures = curves_of_motion(runs);
  if (auto section = section_figure(runs)) figures.push_back(std::move(*section));
  return figures;
}

std::optional<Figure> observable_figure(std::span<const Run> runs) {
  std::vector<std::string> names;
  for (const Run& run : runs) {
    const auto error = energy_error(run);
    const auto is_of_energy = [&](const std::string& name) {
      return name == "H" || (error && (name == "supplied" || name == "dissipated"));
    };
    for (const std::string& name : run.observables()) {
      if (!is_of_energy(name) && std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
    }
  }
  if (names.empty()) return std::nullopt;
  return over_time(runs, names, "The other observables over time.", "observables");
}

Figure chosen_figure(std::span<const Run> runs, std::span<const std::string> columns,
                     bool overlay) {
  for (const std::string& column : columns) {
    std::vector<std::string> names;
    for (const Run& run : runs)
      names.insert(names.end(), run.trajectory.names().begin() + 1, run.trajectory.names().end());
    if (std::ranges::find(names, column) == names.end())
      throw std::invalid_argument("chosen_figure: there is no column " + in_quotes(column) +
                                  did_you_mean(column, names) + ".");
  }
  Figure figure = over_time(runs, columns, word_list(columns) + " over time.", "chosen");
  if (!overlay || figure.panels.empty()) return figure;
  Panel all = std::move(figure.panels.front());
  all.width = 720;
  all.height = 320;
  all.series.clear();
  // The colours count curves: a column of a run.
  const std::vector<std::string> labels = run_labels(runs);
  std::vector<std::string> units;
  for (const std::string& column : columns) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (!runs[i].trajectory.contains(column)) continue;
      Series one = columns_over_time(runs.subspan(i, 1), column).front();
      one.label = runs.size() > 1 ? column + ", " + labels[i] : column;
      one.colour = all.series.size();
      all.series.push_back(std::move(one));
    }
    const std::string label = axis_label(runs, column);
    const std::size_t bracket = label.find(" [");
    units.push_back(bracket == std::string::npos ? "" : label.substr(bracket + 1));
  }
  const bool share = std::ranges::all_of(units, [&](const auto& unit) { return unit == units[0]; });
  all.title = word_list(columns) + " over time";
  all.y.label = columns.size() == 1 ? axis_label(runs, columns[0]) : share ? units[0] : "";
  all.description = counted(std::ssize(all.series), "curve") + ".";
  figure.legend = entries(all.series);
  figure.panels = {std::move(all)};
  return figure;
}

std::optional<Figure> constraint_figure(std::span<const Run> runs) {
  const std::vector<std::string> labels = run_labels(runs);
  std::vector<Series> series;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const TrajectoryTable& table = runs[i].trajectory;
    const std::vector<std::string> names = runs[i].constraints();
    if (names.empty()) continue;
    std::vector<double> violation(table.rows(), 0);
    for (const std::string& name : names) {
      const auto values = table.column(name);
      for (std::size_t row = 0; row < violation.size(); ++row) {
        violation[row] =
            std::isnan(values[row]) ? values[row] : std::max(violation[row], std::abs(values[row]));
      }
    }
    series.push_back(
        {labels[i], first_rows(table.column("t"), table.rows()), std::move(violation), i});
  }
  if (series.empty()) return std::nullopt;
  Panel panel;
  panel.title = "Constraint violation over time";
  panel.x.label = axis_label(runs, "t");
  panel.y.label = "greatest |constraint|";
  const double threshold = symmetric_log_threshold(series);
  panel.y.scale = std::make_shared<plot::SymmetricLogScale>(threshold);
  panel.y.interval = {0, threshold};
  panel.height = 220;
  for (const Series& one : series) {
    panel.y.interval.include(one.y);
    panel.description += one.label + ": at most " + plot::readable(greatest_size(one.y), 3) + ". ";
  }
  panel.series = series;
  return Figure{{panel},
                entries(series),
                "How far the constraints are from being satisfied; linear within " +
                    plot::readable(threshold, 1) + " (shaded).",
                "constraints"};
}

std::vector<Figure> all_figures(std::span<const Run> runs) {
  std::vector<Figure> all = motion_figures(runs);
  for (Figure& figure : energy_figures(runs)) all.push_back(std::move(figure));
  if (auto figure = constraint_figure(runs)) all.push_back(std::move(*figure));
  if (auto figure = observable_figure(runs)) all.push_back(std::move(*figure));
  return all;
}

}  // namespace courant
