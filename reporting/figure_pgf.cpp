#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "courant/core/words/message.hpp"
#include "courant/plotting/decimation.hpp"
#include "courant/plotting/palette.hpp"
#include "courant/reporting/figure_drawing.hpp"
#include "courant/reporting/formula_typesetting.hpp"

namespace courant {

namespace {

constexpr double kPointsOfPixel = 0.75;
constexpr std::size_t kMostVertices = 2000;

// "H − H(0) [J]" with the letters that LaTeX has by commands.
std::string in_latex(std::string_view text) {
  std::string result = latex_text(text);
  const auto replace = [&](std::string_view from, std::string_view to) {
    for (std::size_t at = result.find(from); at != std::string::npos;
         at = result.find(from, at + to.size()))
      result.replace(at, from.size(), to);
  };
  replace("−", "$-$");
  replace("×", "$\\times$");
  replace("·", "$\\cdot$");
  replace("≤", "$\\le$");
  replace("∞", "$\\infty$");
  static constexpr std::string_view raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  for (std::size_t digit = 0; digit < 10; ++digit)
    replace(raised[digit], "$^{" + std::to_string(digit) + "}$");
  replace("⁻", "$^{-}$");
  return result;
}

std::string number(double value) { return std::isfinite(value) ? number_text(value, 7) : "nan"; }

// The ticks of a scale that is not linear, which pgfplots does not know: places and labels.
std::string ticks(const char* axis, const plot::Axis& of, const plot::Interval& interval) {
  const std::string linear = number(of.scale->transform(interval.upper) - interval.upper) +
                             number(of.scale->transform(interval.lower) - interval.lower);
  if (linear == "00" || interval.empty() || !(interval.length() > 0.0)) return "";
  std::string places, labels;
  for (const plot::Tick& tick : of.scale->ticks(interval, 6).marks) {
    if (tick.label.empty()) continue;
    places += (places.empty() ? "" : ",") + number(of.scale->transform(tick.value));
    labels += (labels.empty() ? "{" : ",{") + in_latex(tick.label) + "}";
  }
  return std::string("  ") + axis + "tick={" + places + "}, " + axis + "ticklabels={" + labels +
         "},\n";
}

plot::Interval interval_of(const plot::Panel& panel, const plot::Axis& axis,
                           std::vector<double> plot::Series::*values) {
  plot::Interval interval = axis.interval;
  if (interval.empty())
    for (const plot::Series& series : panel.series) interval.include(series.*values);
  return interval;
}

std::string curve(const plot::Series& series, const plot::Panel& panel) {
  const bool in_space = panel.space.has_value();
  std::string line = in_space ? "\\addplot3[" : "\\addplot[";
  line += "courant" + std::to_string(series.colour % plot::palette().size()) +
          (panel.points || panel.scattered ? ", only marks, mark size=0.6pt" : ", no markers") +
          "] coordinates {";
  const std::vector<std::size_t> rows =
      in_space ? plot::evenly_spaced_rows(series.x.size(), kMostVertices)
               : plot::rows_of_extrema(series.y, kMostVertices);
  std::size_t on_line = 0;
  for (const std::size_t row : rows) {
    line += (on_line++ % 6 == 0 ? "\n  (" : " (") +
            number(panel.x.scale->transform(series.x[row])) + "," +
            number(panel.y.scale->transform(series.y[row])) +
            (in_space ? "," + number(series.z[row]) : "") + ")";
  }
  return line + "\n};\n";
}

std::string axis(const plot::Panel& panel, const Figure& figure, double above) {
  const double size = kPointsOfPixel * figure.scale;
  std::string text = "\\begin{axis}[\n  at={(0pt," + number(-size * above) +
                     "pt)}, anchor=north west, width=" + number(size * panel.width) +
                     "pt, height=" + number(size * panel.height) + "pt, unbounded coords=jump,\n";
  text += "  xlabel={" + in_latex(panel.x.label) + "}, ylabel={" + in_latex(panel.y.label) + "},\n";
  if (panel.space) text += "  zlabel={" + in_latex(panel.space->z_label) + "},\n";
  if (panel.equal_aspect) text += "  axis equal image,\n";
  if (!panel.heading.empty()) text += "  title={" + in_latex(panel.heading) + "},\n";
  const auto limits = [&](const char* name, const plot::Axis& of) {
    if (!of.is_window) return;
    text += std::string("  ") + name + "min=" + number(of.scale->transform(of.interval.lower)) +
            ", " + name + "max=" + number(of.scale->transform(of.interval.upper)) + ",\n";
  };
  limits("x", panel.x);
  limits("y", panel.y);
  if (!panel.space) {
    text += ticks("x", panel.x, interval_of(panel, panel.x, &plot::Series::x));
    text += ticks("y", panel.y, interval_of(panel, panel.y, &plot::Series::y));
  }
  text += "  legend style={draw=none, font=\\small}, legend cell align=left]\n";
  for (const plot::Series& series : panel.series) text += curve(series, panel);
  const bool is_told = figure.legend.size() > 1 && &panel == &figure.panels.front();
  if (is_told) {
    text += "\\legend{";
    for (std::size_t i = 0; i < panel.series.size(); ++i)
      text += (i > 0 ? ",{" : "{") + in_latex(panel.series[i].label) + "}";
    text += "}\n";
  }
  return text + "\\end{axis}\n";
}

}  // namespace

std::string figure_pgf(const Figure& figure) {
  std::string text = "% \\usepackage{pgfplots}\n% " + in_latex(figure.caption) + "\n";
  for (std::size_t i = 0; i < plot::palette().size(); ++i) {
    std::string ink(plot::palette()[i].light.substr(1));
    std::ranges::transform(ink, ink.begin(), [](unsigned char c) { return std::toupper(c); });
    text += "\\definecolor{courant" + std::to_string(i) + "}{HTML}{" + ink + "}\n";
  }
  text += "\\begin{tikzpicture}\n";
  if (!figure.heading.empty())
    text += "\\node[anchor=south west] at (0,6pt) {" + in_latex(figure.heading) + "};\n";
  constexpr double gap = 50;
  double above = 0;
  for (const plot::Panel& panel : figure.panels) {
    text += axis(panel, figure, above);
    above += panel.height + gap;
  }
  return text + "\\end{tikzpicture}\n";
}

}  // namespace courant
