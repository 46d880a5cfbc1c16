#include "courant/reporting/sweep_figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include "courant/running/sweep.hpp"

namespace courant {

namespace {

using plot::Panel;
using plot::Series;

constexpr std::size_t most_quantities = 8;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::string text_of(const Json& value) {
  return value.is_string()         ? value.get<std::string>()
         : value.is_number_float() ? plot::readable(value.get<double>())
                                   : value.dump();
}

// The values of a swept place as positions on an axis, and the axis.
class Places {
 public:
  Places(const Json& range, const std::string& name) : values_(range.at("values")) {
    axis_.label = name;
    numeric_ = std::ranges::all_of(values_, [](const Json& value) { return value.is_number(); });
    if (!numeric_) {
      std::vector<std::string> words;
      for (const Json& value : values_) words.push_back(text_of(value));
      axis_.interval = {-0.5, static_cast<double>(words.size()) - 0.5};
      axis_.scale = std::make_shared<plot::WordScale>(std::move(words));
      return;
    }
    std::vector<double> numbers = values_.get<std::vector<double>>();
    if (is_over_decades(numbers)) axis_.scale = std::make_shared<plot::LogScale>();
  }

  const plot::Axis& axis() const { return axis_; }
  double operator()(const Json& value) const {
    if (numeric_) return value.get<double>();
    const auto found = std::find(values_.begin(), values_.end(), value);
    return static_cast<double>(found - values_.begin());
  }

  static bool is_over_decades(std::span<const double> numbers) {
    constexpr double far = 30;
    double least = std::numeric_limits<double>::infinity(), greatest = 0;
    for (const double number : numbers) {
      if (!std::isfinite(number)) continue;
      least = std::min(least, number);
      greatest = std::max(greatest, number);
    }
    return least > 0 && greatest >= far * least;
  }

 private:
  Json values_;
  bool numeric_;
  plot::Axis axis_;
};

// The swept places but the first, "theta=0.2, step=0.1", and what is tied to it.
std::string label_of(const Json& settings, const Json& ranges,
                     const std::vector<std::string>& names) {
  std::string label;
  std::size_t place = 0, end = 1;
  while (end < ranges.size() && ranges[end].value("tied", false)) ++end;
  for (const auto& [pointer, value] : settings.items()) {
    if (place >= end) label += (label.empty() ? "" : ", ") + names[place] + " = " + text_of(value);
    ++place;
  }
  return label;
}

// Which of the values are drawn, with what their axis says.
std::vector<std::pair<std::string, std::string>> shown_values(const Json& runs) {
  std::vector<std::string> names;
  for (const Json& run : runs)
    for (const auto& [name, value] : run.at("values").items())
      if (value.is_number() && std::ranges::find(names, name) == names.end()) names.push_back(name);
  const auto is_there = [&](const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  std::vector<std::pair<std::string, std::string>> shown;
  const std::pair<const char*, const char*> known[] = {
      {"H.max_drift", "greatest |H − H(0)|"},       {"max_violation", "greatest |constraint|"},
      {"degrees_of_freedom", "degrees of freedom"}, {"index", "index"},
      {"gap", "gap of the weakest rank decision"},  {"order", "measured order"},
      {"error", "error at the smallest step"}};
  for (const auto& [name, label] : known)
    if (is_there(name)) shown.emplace_back(name, label);
  const auto ends = [&](bool observables) {
    for (const std::string& name : names) {
      if (!name.ends_with(".final")) continue;
      const std::string quantity = name.substr(0, name.size() - 6);
      if (is_there(quantity + ".max_drift") == observables && quantity != "H")
        shown.emplace_back(name, quantity + " at the end");
    }
  };
  const std::size_t before = shown.size();
  ends(true);
  if (shown.size() == before) ends(false);
  if (shown.size() > most_quantities) shown.resize(most_quantities);
  return shown;
}

Panel panel_of(const std::string& name, const std::string& label, const Json& table,
               const Places& places, const std::vector<std::string>& names) {
  Panel panel;
  panel.title = label;
  panel.x = places.axis();
  panel.y.label = label;
  panel.points = true;
  panel.height = 220;
  std::vector<double> all;
  for (const Json& run : table.at("runs")) {
    const Json& settings = run.at("settings");
    const std::string curve = label_of(settings, table.at("sweep"), names);
    auto found = std::ranges::find(panel.series, curve, &Series::label);
    if (found == panel.series.end())
      found = panel.series.insert(found, Series{curve, {}, {}, panel.series.size()});
    const Json value = run.at("values").value(name, Json());
    found->x.push_back(places(settings.begin().value()));
    found->y.push_back(value.is_number() ? value.get<double>() : nothing);
    all.push_back(found->y.back());
  }
  if (Places::is_over_decades(all)) panel.y.scale = std::make_shared<plot::LogScale>();
  const auto count = std::ranges::count_if(all, [](double value) { return std::isfinite(value); });
  panel.description = std::to_string(count) + " values of " + label + ".";
  return panel;
}

}  // namespace

std::optional<Figure> sweep_figure(const Json& table) {
  const Json& runs = table.at("runs");
  const Json& ranges = table.at("sweep");
  if (runs.empty() || ranges.empty()) return std::nullopt;
  const std::vector<std::string> names = swept_names(table);
  const Places places(ranges.front(), names.front());
  Figure figure;
  figure.name = "sweep";
  const auto shown = shown_values(runs);
  for (const auto& [name, label] : shown) {
    figure.panels.push_back(panel_of(name, label, table, places, names));
    if (shown.size() > 3) figure.panels.back().width = 380;
  }
  if (figure.panels.empty()) return std::nullopt;
  for (const Series& one : figure.panels.front().series)
    if (!one.label.empty()) figure.legend.push_back({one.label, one.colour});
  // More than there are colours cannot be told apart.
  if (const std::size_t most = 2 * plot::palette().size(); figure.legend.size() > most)
    figure.legend = {figure.legend.begin(),
                     figure.legend.begin() + static_cast<std::ptrdiff_t>(most)};
  figure.caption = "A sweep over " + names.front();
  for (std::size_t i = 1; i < names.size(); ++i)
    figure.caption += (i + 1 == names.size() ? " and " : ", ") + names[i];
  figure.caption += ".";
  return figure;
}

}  // namespace courant
