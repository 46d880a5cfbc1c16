#include "courant/reporting/figure_drawing.hpp"

#include <algorithm>
#include <vector>

#include "courant/plotting/figure.hpp"
#include "courant/plotting/sheet.hpp"
#include "courant/running/comma_separated.hpp"

namespace courant {

namespace {

struct Column {
  std::string name;
  const std::vector<double>* values;
};

std::vector<Column> columns(const Figure& figure) {
  std::vector<Column> found;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const plot::Panel& panel = figure.panels[i];
    const std::string of_panel =
        figure.panels.size() == 1
            ? ""
            : (panel.heading.empty() ? std::to_string(i + 1) : panel.heading) + ": ";
    const std::vector<double>* x = nullptr;
    for (const plot::Series& one : panel.series) {
      const std::string of_curve =
          panel.series.size() == 1 || one.label.empty() ? "" : one.label + ": ";
      if (x == nullptr || *x != one.x) {
        const bool is_shared = std::ranges::all_of(
            panel.series, [&](const plot::Series& other) { return other.x == one.x; });
        found.push_back({of_panel + (is_shared ? "" : of_curve) + panel.x.label, &one.x});
      }
      found.push_back({of_panel + of_curve + panel.y.label, &one.y});
      if (panel.space) found.push_back({of_panel + of_curve + panel.space->z_label, &one.z});
      x = &one.x;
    }
  }
  return found;
}

}  // namespace

plot::Markup panels_and_legend(const Figure& figure, std::size_t rows) {
  using plot::element;
  using plot::Markup;
  Markup panels;
  bool abreast = figure.panels.size() > 1;
  for (const plot::Panel& panel : figure.panels) {
    panels += plot::draw(panel, rows);
    abreast = abreast && panel.width < 400;
  }
  const std::string style = abreast ? "panels abreast" : "panels";
  const Markup content = figure.legend.empty() ? Markup() : plot::legend(figure.legend);
  return content + element("div", {{"class", style}}, panels);
}

std::string figure_svg(const Figure& figure) {
  const std::string title = figure.panels.empty() ? "" : figure.panels.front().title;
  return plot::draw(plot::Sheet{title, figure.caption, figure.legend, figure.panels, figure.heading,
                                figure.scale, figure.abreast})
             .str() +
         "\n";
}

std::string figure_csv(const Figure& figure) {
  const std::vector<Column> all = columns(figure);
  std::string csv;
  std::size_t rows = 0;
  for (const Column& column : all) {
    csv += (csv.empty() ? "" : ",") + csv_cell(column.name);
    rows = std::max(rows, column.values->size());
  }
  csv += '\n';
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i > 0) csv += ',';
      if (row < all[i].values->size()) csv += csv_cell((*all[i].values)[row]);
    }
    csv += '\n';
  }
  return csv;
}

}  // namespace courant
