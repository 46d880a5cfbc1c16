#include "courant/reporting/section_figures.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace courant {
namespace {

constexpr std::size_t fewest_occurrences = 10, most_occurrences = 4000;

using Plane = std::pair<std::string, std::string>;  // the names of its two axes

double spread(std::span<const double> values) {
  double least = INFINITY, greatest = -INFINITY;
  for (const double value : values)
    if (std::isfinite(value)) least = std::min(least, value), greatest = std::max(greatest, value);
  return greatest > least ? greatest - least : 0.0;
}

// The plane of what differs from one occurrence to the next.
std::optional<Plane> plane_of(const Run& run, const TrajectoryTable& event) {
  std::vector<std::string> differ;
  for (const std::string& name : run.coordinates())
    if (event.contains(name) &&
        spread(event.column(name)) > 1e-3 * spread(run.trajectory.column(name)))
      differ.push_back(name);
  for (const std::string& name : differ)
    if (std::ranges::count(differ, "p_" + name) > 0) return Plane{name, "p_" + name};
  if (differ.size() < 2) return std::nullopt;
  return Plane{differ[0], differ[1]};
}

std::vector<std::string> frequent_events(std::span<const Run> runs) {
  std::vector<std::string> names;
  for (const Run& run : runs)
    for (const auto& [name, table] : run.events)
      if (table.rows() >= fewest_occurrences && std::ranges::count(names, name) == 0)
        names.push_back(name);
  return names;
}

}  // namespace

std::optional<Figure> section_figure(std::span<const Run> runs) {
  const std::vector<std::string> labels = run_labels(runs);
  Figure figure;
  figure.name = "section";
  std::string planes;
  for (const std::string& name : frequent_events(runs)) {
    std::optional<Plane> plane;
    plot::Panel panel;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const auto found = runs[i].events.find(name);
      if (found == runs[i].events.end()) continue;
      const TrajectoryTable& table = found->second;
      if (!plane) plane = plane_of(runs[i], table);
      if (!plane || !table.contains(plane->first) || !table.contains(plane->second)) continue;
      panel.series.push_back({labels[i], first_rows(table.column(plane->first), most_occurrences),
                              first_rows(table.column(plane->second), most_occurrences), i,
                              first_rows(table.column("t"), most_occurrences)});
    }
    if (panel.series.empty()) continue;
    panel.title = "Poincaré section: " + name;
    panel.description =
        "The points (" + plane->first + ", " + plane->second + ") where " + name + " occurs.";
    panel.x.label = axis_label(runs, plane->first);
    panel.y.label = axis_label(runs, plane->second);
    panel.width = 480;
    panel.height = 360;
    panel.scattered = true;
    planes += (planes.empty() ? "" : ", ") + std::string("(") + plane->first + ", " +
              plane->second + ") where " + name + " occurs";
    if (figure.legend.empty() && panel.series.size() > 1)
      for (const plot::Series& series : panel.series)
        figure.legend.push_back({series.label, series.colour});
    if (runs.size() == 1) planes += ", " + std::to_string(panel.series[0].x.size()) + " times";
    figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.empty()) return std::nullopt;
  for (plot::Panel& panel : figure.panels)
    if (figure.panels.size() > 1) panel.heading = panel.title.substr(panel.title.rfind(' ') + 1);
  figure.caption = "Poincaré section: " + planes + ".";
  return figure;
}

}  // namespace courant
