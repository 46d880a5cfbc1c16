#include "courant/reporting/energy_figures.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace courant {

namespace {

using plot::Interval;
using plot::Panel;
using plot::Series;

constexpr std::size_t most_panels = 8;
constexpr double alike = 30;            // sizes that one linear axis shows
constexpr std::size_t beginning = 501;  // rows that show an oscillation itself
constexpr std::size_t many = 2000;      // rows of which the oscillation is seen as a band
constexpr double energy_width = 352, energy_height = 180;

// The median of |value| among those that are finite and not zero; 0 if there is none.
double median_size(std::span<const double> values) {
  std::vector<double> sizes;
  for (const double value : values)
    if (std::isfinite(value) && value != 0) sizes.push_back(std::abs(value));
  if (sizes.empty()) return 0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

// A curve for each run that has H, with what it is called.
struct EnergyErrors {
  std::vector<Series> series;
  std::string name = "H − H(0)";
};

EnergyErrors energy_errors(std::span<const Run> runs) {
  EnergyErrors errors;
  const std::vector<std::string> labels = run_labels(runs);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    auto error = energy_error(runs[i]);
    if (!error) continue;
    const auto t = runs[i].trajectory.column("t");
    if (error->is_balance) errors.name = name_of(*error);
    errors.series.push_back({labels[i], {t.begin(), t.end()}, std::move(error->values), i});
  }
  return errors;
}

// " [J]" where H has a unit.
std::string unit_of_energy(std::span<const Run> runs) {
  const std::string label = axis_label(runs, "H");
  const std::size_t unit = label.rfind(" [");
  return unit == std::string::npos ? "" : label.substr(unit);
}

Panel energy_panel(std::span<const Run> runs, const std::string& name, std::vector<Series> series) {
  Panel panel;
  panel.title = "Energy error " + name + " over time";
  panel.x.label = axis_label(runs, "t");
  panel.y.label = name + unit_of_energy(runs);
  for (const Series& one : series)
    panel.description += one.label + ": at most " + plot::readable(greatest_size(one.y), 3) + ". ";
  panel.series = std::move(series);
  return panel;
}

// The errors that are left when the greatest, a decade or more above all others, are left out; all
// of them when there is no such gap.
std::vector<Series> without_greatest(std::vector<Series> errors) {
  std::vector<double> sizes;
  for (const Series& error : errors) sizes.push_back(greatest_size(error.y));
  std::sort(sizes.begin(), sizes.end(), std::greater<>());
  const auto gap = std::adjacent_find(
      sizes.begin(), sizes.end(), [](double above, double below) { return above >= 10 * below; });
  if (gap != sizes.end() && *gap > 0) {
    std::erase_if(errors, [&](const Series& error) { return greatest_size(error.y) >= *gap; });
  }
  return errors;
}

bool are_alike(std::span<const Series> errors) {
  double least = 0, most = 0;
  for (const Series& error : errors) {
    const double size = greatest_size(error.y);
    if (size > 0 && (least == 0 || size < least)) least = size;
    most = std::max(most, size);
  }
  return most <= alike * least;
}

// "rk2: growing, at most …." of each run.
std::string trends(std::span<const Run> runs) {
  const std::vector<std::string> labels = run_labels(runs);
  std::string text;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (const auto trend = energy_trend(runs[i]))
      text += " " + (runs.size() == 1 ? "It is " : labels[i] + ": ") + in_words(*trend) + ".";
  return text;
}

// A panel for each, with the same axes; all in one where there are too many.
std::vector<Panel> panels_of(std::span<const Run> runs, const EnergyErrors& errors,
                             const std::shared_ptr<const plot::Scale>& scale) {
  std::vector<Panel> panels;
  if (errors.series.size() > most_panels)
    panels.push_back(energy_panel(runs, errors.name, errors.series));
  else
    for (const Series& one : errors.series)
      panels.push_back(energy_panel(runs, errors.name, {one}));
  Interval x, y;
  for (const Series& one : errors.series) x.include(one.x), y.include(one.y);
  for (Panel& panel : panels) {
    panel.x.interval = x;
    panel.y.interval = y;
    panel.y.scale = scale;
    if (panels.size() == 1) continue;
    panel.heading = panel.series.front().label;
    panel.height = panels.size() < 4 ? 200 : 160;
  }
  return panels;
}

std::vector<plot::LegendEntry> legend_of(const std::vector<Series>& errors) {
  std::vector<plot::LegendEntry> legend;
  if (errors.size() > most_panels)
    for (const Series& one : errors) legend.push_back({one.label, one.colour});
  return legend;
}

// The smaller errors on linear axes: of long runs their beginning, and the whole, abreast.
Figure detail(std::span<const Run> runs, const std::string& name, const std::vector<Series>& kept,
              bool is_long) {
  Figure figure;
  figure.name = "energy-detail";
  figure.caption = "The smaller energy errors on linear axes";
  if (kept.size() > 1)
    for (const Series& one : kept) figure.legend.push_back({one.label, one.colour});
  Interval y;
  for (const Series& one : kept) y.include(one.y);
  for (const Series& one : kept) {
    std::vector<Series> parts = {one};
    if (is_long) {
      Series start = one;
      start.x.resize(std::min(start.x.size(), beginning));
      start.y.resize(start.x.size());
      parts.insert(parts.begin(), std::move(start));
    }
    for (Series& part : parts) {
      Panel panel = energy_panel(runs, name, {std::move(part)});
      panel.y.interval = y;
      panel.height = energy_height;
      if (is_long) panel.width = energy_width;
      figure.panels.push_back(std::move(panel));
    }
  }
  if (is_long)
    figure.caption += ": on the left the first " + std::to_string(beginning - 1) +
                      " rows, on the right all of them";
  figure.caption += kept.size() == 1 ? ": " + kept[0].label + "." : ".";
  return figure;
}

// What is stored, supplied and dissipated since the start, a panel for each run in which energy comes in or goes
// out, all with the same axes. Nothing if there is no such run.
std::optional<Figure> balance_figure(std::span<const Run> runs) {
  Figure figure;
  figure.name = "energy-balance";
  figure.caption =
      "What is stored, H − H(0), beside what was supplied and dissipated since the start.";
  const std::vector<std::string> labels = run_labels(runs);
  Interval y;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto error = energy_error(runs[i]);
    if (!error || !error->is_balance) continue;
    const TrajectoryTable& table = runs[i].trajectory;
    const auto t = table.column("t");
    Panel panel;
    panel.title = "Energy balance over time";
    panel.heading = runs.size() > 1 ? labels[i] : "";
    panel.x.label = axis_label(runs, "t");
    panel.y.label = "energy" + unit_of_energy(runs);
    if (runs.size() > 1) panel.height = 200;
    for (const char* name : {"H", "supplied", "dissipated"}) {
      const auto values = table.column(name);
      const double before = panel.series.empty() ? values.front() : 0.0;
      const std::string label = panel.series.empty() ? "H − H(0)" : name;
      panel.series.push_back(
          {label, {t.begin(), t.end()}, {values.begin(), values.end()}, panel.series.size()});
      for (double& value : panel.series.back().y) value -= before;
      y.include(panel.series.back().y);
    }
    panel.description = "H − H(0), supplied and dissipated energy of " + labels[i] + ".";
    if (figure.legend.empty())
      for (const Series& one : panel.series) figure.legend.push_back({one.label, one.colour});
    figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.empty() || figure.panels.size() > most_panels) return std::nullopt;
  for (Panel& panel : figure.panels) panel.y.interval = y;
  return figure;
}

}  // namespace

double symmetric_log_threshold(std::span<const Series> series) {
  double smallest = 0, largest = 0;
  for (const Series& one : series) {
    const double size = median_size(one.y);
    if (size > 0 && (smallest == 0 || size < smallest)) smallest = size;
    largest = std::max(largest, greatest_size(one.y));
  }
  if (largest == 0) return 1e-16;
  // A power of ten itself may be a little below it.
  const double power = std::floor(std::log10(smallest) + 1e-9);
  const double least = std::floor(std::log10(largest) + 1e-9) - 12;
  return std::pow(10, std::max(power, least));
}

std::optional<EnergyTrend> energy_trend(const Run& run) {
  const auto error = energy_error(run);
  if (!error) return std::nullopt;
  return energy_trend(run.trajectory.column("t"), error->values, error->size);
}

std::vector<Figure> energy_figures(std::span<const Run> runs) {
  const EnergyErrors errors = energy_errors(runs);
  if (errors.series.empty()) return {};
  std::vector<Figure> figures;
  if (auto balance = balance_figure(runs)) figures.push_back(std::move(*balance));

  Figure all{{}, legend_of(errors.series), "Energy error", "energy"};
  if (!figures.empty()) all.caption += ", " + errors.name;
  if (are_alike(errors.series)) {
    all.panels = panels_of(runs, errors, std::make_shared<plot::LinearScale>());
    all.caption += ".";
  } else {
    const double threshold = symmetric_log_threshold(errors.series);
    all.panels = panels_of(runs, errors, std::make_shared<plot::SymmetricLogScale>(threshold));
    all.caption += " on a symmetric-log axis, linear within ±" +
                   plot::power_of_ten(static_cast<int>(std::lround(std::log10(threshold)))) +
                   " (shaded).";
  }
  all.caption += trends(runs);
  figures.push_back(std::move(all));

  const std::vector<Series> kept = without_greatest(errors.series);
  const bool is_long =
      std::ranges::any_of(kept, [](const Series& one) { return one.x.size() > many; });
  if ((kept.size() < errors.series.size() || is_long) && kept.size() <= most_panels)
    figures.push_back(detail(runs, errors.name, kept, is_long));
  return figures;
}

}  // namespace courant
