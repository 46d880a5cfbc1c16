#include "courant/reporting/study_figure.hpp"

#include <algorithm>
#include <limits>

#include "courant/plotting/decimation.hpp"

namespace courant {

namespace {

using plot::Panel;
using plot::Series;

Panel panel_over(const StudyReport& study, double StudyReport::Row::*key,
                 const std::string& label) {
  Panel panel;
  panel.title = "Error over " + label;
  panel.x.label = label;
  panel.y.label = "error";
  panel.x.scale = panel.y.scale = std::make_shared<plot::LogScale>();
  panel.width = 380;
  panel.points = true;
  const auto positive = [](double value) {
    return value > 0 ? value : std::numeric_limits<double>::quiet_NaN();
  };
  for (const StudyReport::Method& method : study.methods) {
    Series curve{method.method, {}, {}, panel.series.size()};
    for (const StudyReport::Row& row : method.rows) {
      curve.x.push_back(positive(row.*key));
      curve.y.push_back(positive(row.error));
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

std::optional<Figure> study_figure(const StudyReport& study) {
  Figure figure;
  figure.name = "study";
  figure.panels = {panel_over(study, &StudyReport::Row::step, "step h"),
                   panel_over(study, &StudyReport::Row::seconds, "time in seconds")};
  if (is_empty(figure.panels.front())) return std::nullopt;
  std::size_t colour = 0;
  for (const StudyReport::Method& method : study.methods) {
    std::string label = method.method;
    if (method.order) label += ", order " + plot::readable(*method.order, 3);
    figure.legend.push_back({label, colour++});
  }
  figure.caption = "Greatest error over the step size, and over the time that the steps took.";
  if (const auto reference = study.reference())
    figure.caption += " Reference: " + *reference + ".";
  else
    for (const StudyReport::Method& method : study.methods)
      figure.caption += " Reference of " + method.experiment + ", " + method.method + ": " +
                        method.reference + ".";
  return figure;
}

}  // namespace courant
