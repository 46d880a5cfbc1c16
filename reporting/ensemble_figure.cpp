#include "courant/reporting/ensemble_figure.hpp"

#include <string>
#include <vector>

namespace courant {

Figure ensemble_figure(const EnsembleTables& tables) {
  constexpr std::size_t most = 8;
  constexpr const char *mean_label = "mean", *band_label = "mean ± standard deviation",
                       *range_label = "least and greatest";
  const TrajectoryTable& table = tables.statistics;
  const auto column = [&](const std::string& name) {
    const auto values = table.column(name);
    return std::vector<double>(values.begin(), values.end());
  };
  const std::vector<double> t = column("t");
  Figure figure;
  figure.name = "ensemble";
  for (const std::string& name : table.names()) {
    constexpr std::string_view ending = ".mean";
    if (!name.ends_with(ending) || name.starts_with("constraint[")) continue;
    if (figure.panels.size() == most) break;
    const std::string quantity = name.substr(0, name.size() - ending.size());
    const std::vector<double> mean = column(name),
                              deviation = column(quantity + ".standard_deviation");
    std::vector<double> below = mean, above = mean;
    for (std::size_t k = 0; k < mean.size(); ++k) {
      below[k] -= deviation[k];
      above[k] += deviation[k];
    }
    plot::Panel panel;
    panel.title = quantity + " of the members over time";
    panel.description =
        "The mean of " + quantity +
        ", a standard deviation below and above it, and the least and the greatest.";
    panel.x.label = "t";
    panel.y.label = quantity;
    panel.height = 220;
    panel.series = {{mean_label, t, mean, 0},
                    {band_label, t, below, 1},
                    {band_label, t, above, 1},
                    {range_label, t, column(quantity + ".min"), 2},
                    {range_label, t, column(quantity + ".max"), 2}};
    figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.size() > 3)
    for (plot::Panel& panel : figure.panels) panel.width = 380;
  figure.legend = {{mean_label, 0}, {band_label, 1}, {range_label, 2}};
  figure.caption = "An ensemble of " + tables.summary.at("members").dump() + " members, of which " +
                   tables.summary.at("completed").dump() + " completed.";
  return figure;
}

}  // namespace courant
