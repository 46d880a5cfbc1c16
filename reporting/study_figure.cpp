#include "courant/reporting/study_figure.hpp"

#include <algorithm>
#include <limits>

#include "courant/plotting/decimation.hpp"

namespace courant {

namespace {

using plot::Panel;
using plot::Series;

Panel panel_over(const Json& study, const char* key, const std::string& label) {
  Panel panel;
  panel.title = "Error over " + label;
  panel.x.label = label;
  panel.y.label = "error";
  panel.x.scale = panel.y.scale = std::make_shared<plot::LogScale>();
  panel.width = 380;
  panel.points = true;
  for (const Json& method : study.at("methods")) {
    Series curve{method.at("method"), {}, {}, panel.series.size()};
    for (const Json& row : method.at("rows")) {
      const auto positive = [&](const char* name) {
        const Json& value = row.at(name);
        return value.is_number() && value.get<double>() > 0
                   ? value.get<double>()
                   : std::numeric_limits<double>::quiet_NaN();
      };
      curve.x.push_back(positive(key));
      curve.y.push_back(positive("error"));
    }
    panel.series.push_back(std::move(curve));
  }
  panel.description = std::to_string(panel.series.size()) + " curves, one for each method.";
  return panel;
}

bool is_empty(const Panel& panel) {
  return std::ranges::all_of(
      panel.series, [](const Series& one) { return plot::finite_stretches(one.x, one.y).empty(); });
}

}  // namespace

std::optional<Figure> study_figure(const Json& study) {
  Figure figure;
  figure.name = "study";
  figure.panels = {panel_over(study, "step", "step h"),
                   panel_over(study, "seconds", "time in seconds")};
  if (is_empty(figure.panels.front())) return std::nullopt;
  std::size_t colour = 0;
  for (const Json& method : study.at("methods")) {
    std::string label = method.at("method");
    if (method.at("order").is_number())
      label += ", order " + plot::readable(method.at("order").get<double>(), 3);
    figure.legend.push_back({label, colour++});
  }
  figure.caption = "Greatest error over the step size, and over the time that the steps took.";
  if (study.at("reference").is_string())
    figure.caption += " Reference: " + study.at("reference").get<std::string>() + ".";
  else
    for (const Json& method : study.at("methods"))
      figure.caption += " Reference of " + method.at("experiment").get<std::string>() + ", " +
                        method.at("method").get<std::string>() + ": " +
                        method.at("reference").get<std::string>() + ".";
  return figure;
}

}  // namespace courant
