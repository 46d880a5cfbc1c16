#include "courant/plotting/sheet.hpp"

#include <algorithm>

#include "courant/plotting/svg.hpp"

namespace courant::plot {

namespace {

constexpr double margin = 10, gap = 14, line_height = 20;
constexpr double narrow = 400;        // panels below this width go two abreast
constexpr double letter_width = 6.4;  // at most, of text of 12 pixels on average

Markup placed(double x, double y, const Markup& content) {
  const std::string move = "translate(" + coordinate(x) + " " + coordinate(y) + ")";
  return element("g", {{"transform", move}}, content);
}

std::size_t letters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

// The entries in lines no longer than `width`, and the height of these.
std::pair<Markup, double> legend_lines(const std::vector<LegendEntry>& entries, double width) {
  Markup lines;
  double x = 0, y = 0;
  for (const LegendEntry& entry : entries) {
    const double length = 34 + letter_width * static_cast<double>(letters(entry.label)) + 20;
    if (x > 0 && x + length > width) x = 0, y += line_height;
    const std::string_view ink = palette()[entry.colour % palette().size()].light;
    lines += element("line", {{"x1", x},
                              {"y1", y + 10},
                              {"x2", x + 26},
                              {"y2", y + 10},
                              {"stroke", ink},
                              {"stroke-width", 2.5}});
    lines += element("text", {{"x", x + 34}, {"y", y + 14}}, entry.label);
    x += length;
  }
  return {element("g", {{"font-size", 12.0}, {"font-family", "serif"}}, lines),
          entries.empty() ? 0 : y + line_height + gap / 2};
}

}  // namespace

Markup draw(const Sheet& sheet) {
  double width = 0, widest = 0;
  for (const Panel& panel : sheet.panels) widest = std::max(widest, panel.width);
  const bool abreast = sheet.abreast.value_or(widest < narrow) && sheet.panels.size() > 1;
  width = abreast ? 2 * widest + gap : widest;
  const auto [legend, legend_height] = legend_lines(sheet.legend, width);
  const double heading_height = sheet.heading.empty() ? 0 : line_height + gap / 2;
  Markup content = placed(margin, margin + heading_height, legend);
  if (!sheet.heading.empty())
    content += element("text",
                       {{"x", margin + width / 2},
                        {"y", margin + 14},
                        {"text-anchor", "middle"},
                        {"font-size", 14.0},
                        {"font-family", "serif"}},
                       sheet.heading);
  double y = margin + heading_height + legend_height, tallest = 0;
  for (std::size_t i = 0; i < sheet.panels.size(); ++i) {
    const Panel& panel = sheet.panels[i];
    const bool second = abreast && i % 2 == 1;
    content += placed(margin + (second ? widest + gap : 0), y, draw(panel));
    tallest = std::max(tallest, drawn_height(panel));
    if (!abreast || second || i + 1 == sheet.panels.size()) y += tallest + gap, tallest = 0;
  }
  const double height = y - (sheet.panels.empty() ? 0 : gap) + margin;
  const Markup paper =
      element("rect", {{"width", width + 2 * margin}, {"height", height}, {"fill", "#fff"}});
  return svg(width + 2 * margin, height, sheet.title, sheet.description, paper + content,
             sheet.scale);
}

}  // namespace courant::plot
