#include "courant/plotting/figure.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include "courant/plotting/decimation.hpp"

namespace courant::plot {

namespace {

constexpr std::array<PaletteColour, 7> colours = {{{"#0072b2", "#4aa5e0"},
                                                   {"#d55e00", "#f27b3d"},
                                                   {"#009e73", "#2fc39a"},
                                                   {"#b3578a", "#df97bd"},
                                                   {"#c98a00", "#e9ab22"},
                                                   {"#3b9bd1", "#8fd0f7"},
                                                   {"#444444", "#d0cdc6"}}};

constexpr double left_margin = 62, right_margin = 18, top_margin = 26, bottom_margin = 42;
constexpr double padding = 0.03;  // of the axis, between data and frame

std::string colour_class(std::size_t colour) {
  return "c" + std::to_string(colour % colours.size());
}
std::string_view ink(std::size_t colour) { return colours[colour % colours.size()].light; }

// Single letters are variables, and stand in italics; what follows one after an underscore is its
// subscript.
Markup mathematics(std::string_view text) {
  const auto word = [](std::string_view from) {
    const auto end = std::find_if(from.begin(), from.end(), [](char c) {
      return std::isalpha(static_cast<unsigned char>(c)) == 0;
    });
    return from.substr(0, static_cast<std::size_t>(end - from.begin()));
  };
  Markup markup;
  while (!text.empty()) {
    const std::size_t size = std::max<std::size_t>(1, word(text).size());
    const bool variable = word(text).size() == 1;
    markup += variable ? element("tspan", {{"font-style", "italic"}}, text.substr(0, 1))
                       : Markup(text.substr(0, size));
    text.remove_prefix(size);
    if (!variable || !text.starts_with('_')) continue;
    const std::string_view index = word(text.substr(1));
    if (index.empty()) continue;
    markup += element("tspan", {{"dy", 3.0}, {"font-size", 9.0}, {"font-style", "italic"}}, index);
    text.remove_prefix(1 + index.size());
    return text.empty() ? markup : markup + element("tspan", {{"dy", -3.0}}, mathematics(text));
  }
  return markup;
}

Markup text(double x, double y, std::string_view anchor, const Markup& content) {
  return element("text", {{"x", x}, {"y", y}, {"text-anchor", anchor}}, content);
}

Markup line(std::string_view style, double x1, double y1, double x2, double y2,
            std::string_view stroke) {
  return element(
      "line",
      {{"class", style}, {"x1", x1}, {"y1", y1}, {"x2", x2}, {"y2", y2}, {"stroke", stroke}});
}

// The map from values to pixels: an interval of a scale onto [begin, end].
class PixelMap {
 public:
  PixelMap(const Scale& scale, Interval interval, double begin, double end)
      : scale_(scale),
        origin_(scale.transform(interval.lower)),
        pixels_((end - begin) / (scale.transform(interval.upper) - origin_)),
        begin_(begin) {}

  double operator()(double value) const {
    return begin_ + pixels_ * (scale_.transform(value) - origin_);
  }

 private:
  const Scale& scale_;
  double origin_, pixels_, begin_;
};

// Where everything of a panel goes.
class Layout {
 public:
  explicit Layout(const Panel& panel)
      : panel_(panel),
        x_(padded(panel.x, &Series::x)),
        y_(padded(panel.y, &Series::y)),
        height_(panel.height) {
    if (panel.equal_aspect) equalise();
    x_pixel_.emplace(*panel.x.scale, x_, left(), right());
    y_pixel_.emplace(*panel.y.scale, y_, bottom(), top());
  }

  double left() const { return left_margin; }
  double right() const { return panel_.width - right_margin; }
  double top() const { return top_margin; }
  double bottom() const { return height_ - bottom_margin; }
  double height() const { return height_; }
  Interval x_interval() const { return x_; }
  Interval y_interval() const { return y_; }
  double x(double value) const { return (*x_pixel_)(value); }
  double y(double value) const { return (*y_pixel_)(value); }

 private:
  Interval padded(const Axis& axis, std::vector<double> Series::*values) const {
    Interval interval = axis.interval;
    if (interval.empty()) {
      for (const Series& series : panel_.series) interval.include(series.*values);
    }
    if (interval.empty()) interval = {0, 1};
    return axis.scale->padded(interval, padding);
  }

  // As many pixels to a unit of y as to one of x, with a height from 120 to 480: the shorter
  // interval grows.
  void equalise() {
    const double plot_width = right() - left();
    const double wanted = plot_width * y_.length() / x_.length();
    const double plot_height = std::clamp(wanted, 120.0, 480.0);
    height_ = plot_height + top_margin + bottom_margin;
    const auto grow = [](Interval& interval, double length) {
      const double more = (length - interval.length()) / 2;
      interval = {interval.lower - more, interval.upper + more};
    };
    if (plot_height > wanted) grow(y_, x_.length() * plot_height / plot_width);
    if (plot_height < wanted) grow(x_, y_.length() * plot_width / plot_height);
  }

  const Panel& panel_;
  Interval x_, y_;
  double height_;
  std::optional<PixelMap> x_pixel_, y_pixel_;
};

std::string with_exponent(const std::string& label, int exponent) {
  if (exponent == 0) return label;
  return label + (label.empty() ? "× " : "   (× ") + power_of_ten(exponent) +
         (label.empty() ? "" : ")");
}

Markup x_axis(const Panel& panel, const Layout& layout) {
  const double bottom = layout.bottom();
  const int about = static_cast<int>((layout.right() - layout.left()) / 80);
  const Ticks ticks = panel.x.scale->ticks(layout.x_interval(), about);
  Markup axis = line("frame", layout.left(), bottom, layout.right(), bottom, "#777");
  for (const Tick& tick : ticks.marks) {
    const double x = layout.x(tick.value);
    axis += line("frame", x, bottom, x, bottom + (tick.label.empty() ? 2.5 : 5), "#777");
    if (!tick.label.empty()) axis += text(x, bottom + 18, "middle", tick.label);
  }
  const std::string label = with_exponent(panel.x.label, ticks.exponent);
  axis += text((layout.left() + layout.right()) / 2, bottom + 36, "middle", mathematics(label));
  return element("g", {{"class", "axis"}}, axis);
}

Markup y_axis(const Panel& panel, const Layout& layout) {
  const double left = layout.left();
  const int about = std::max(5, static_cast<int>((layout.bottom() - layout.top()) / 40));
  const Ticks ticks = panel.y.scale->ticks(layout.y_interval(), about);
  Markup axis;
  for (const Tick& tick : ticks.marks) {
    const double y = layout.y(tick.value);
    if (!tick.label.empty()) {
      axis += line(tick.value == 0 && !panel.equal_aspect ? "zero" : "grid", left, y,
                   layout.right(), y, "#ddd");
      axis += text(left - 8, y + 4, "end", tick.label);
    }
    axis += line("frame", left - (tick.label.empty() ? 2.5 : 5), y, left, y, "#777");
  }
  axis += line("frame", left, layout.top(), left, layout.bottom(), "#777");
  axis += text(left - 5, layout.top() - 10, "start",
               mathematics(with_exponent(panel.y.label, ticks.exponent)));
  return element("g", {{"class", "axis"}}, axis);
}

// The part of a symmetric-log axis that is linear, shaded.
Markup linear_zone(const Panel& panel, const Layout& layout) {
  const Interval zone = panel.y.scale->linear_zone(), shown = layout.y_interval();
  const double upper = std::min(zone.upper, shown.upper), lower = std::max(zone.lower, shown.lower);
  if (upper <= lower || (upper == shown.upper && lower == shown.lower)) return {};
  return element("rect", {{"class", "linear-zone"},
                          {"x", layout.left()},
                          {"y", layout.y(upper)},
                          {"width", layout.right() - layout.left()},
                          {"height", layout.y(lower) - layout.y(upper)},
                          {"fill", "#777"},
                          {"fill-opacity", 0.1}});
}

// The curves of one series.
class Curve {
 public:
  Curve(const Series& series, const Layout& layout) : series_(series), layout_(layout) {
    const bool function = std::is_sorted(series.x.begin(), series.x.end());
    const auto columns = static_cast<int>(layout.right() - layout.left());
    for (const Stretch stretch : finite_stretches(series.x, series.y)) {
      if (function && stretch.size() > 4 * static_cast<std::size_t>(columns)) {
        band(stretch, columns);
      } else {
        polyline(stretch);
      }
    }
  }

  Markup markup() const {
    const std::string style = colour_class(series_.colour);
    Markup curve = element("title", {}, series_.label);
    if (!band_.empty()) {
      curve += element("path", {{"class", "band"},
                                {"d", band_.str()},
                                {"fill", ink(series_.colour)},
                                {"fill-opacity", 0.35},
                                {"stroke", ink(series_.colour)},
                                {"stroke-width", 0.8}});
    }
    if (!line_.empty()) {
      curve += element("path", {{"class", "line"},
                                {"d", line_.str()},
                                {"fill", "none"},
                                {"stroke", ink(series_.colour)},
                                {"stroke-width", 1.4}});
    }
    return element("g", {{"class", "series " + style}, {"stroke-linejoin", "round"}}, curve);
  }

 private:
  Vertex pixel(double x, double y) const { return {layout_.x(x), layout_.y(y)}; }

  void polyline(Stretch stretch) {
    std::vector<Vertex> path;
    path.reserve(stretch.size());
    for (std::size_t row = stretch.begin; row < stretch.end; ++row) {
      path.push_back(pixel(series_.x[row], series_.y[row]));
    }
    const std::vector<Vertex> kept = simplified(path, 0.1);
    line_.move_to(kept.front().x, kept.front().y);
    for (std::size_t i = 1; i < kept.size(); ++i) line_.line_to(kept[i].x, kept[i].y);
  }

  void band(Stretch stretch, int columns) {
    const auto rows = [&](const std::vector<double>& values) {
      return std::span(values).subspan(stretch.begin, stretch.size());
    };
    const Envelope bounds =
        envelope(rows(series_.x), rows(series_.y), layout_.x_interval(), columns);
    for (std::size_t i = 0; i < bounds.x.size(); ++i) {
      const Vertex v = pixel(bounds.x[i], bounds.upper[i]);
      i == 0 ? band_.move_to(v.x, v.y) : band_.line_to(v.x, v.y);
    }
    for (std::size_t i = bounds.x.size(); i-- > 0;) {
      const Vertex v = pixel(bounds.x[i], bounds.lower[i]);
      band_.line_to(v.x, v.y);
    }
    band_.close();
  }

  const Series& series_;
  const Layout& layout_;
  PathData line_, band_;
};

Markup points(const Series& series, const Layout& layout) {
  Markup dots;
  for (std::size_t row = 0; row < series.x.size(); ++row) {
    const double x = layout.x(series.x[row]), y = layout.y(series.y[row]);
    if (!std::isfinite(x) || !std::isfinite(y)) continue;
    dots += element("circle", {{"class", "end"},
                               {"cx", x},
                               {"cy", y},
                               {"r", 3.0},
                               {"stroke", ink(series.colour)},
                               {"stroke-width", 1.0},
                               {"fill", ink(series.colour)}});
  }
  return element("g", {{"class", "endpoints " + colour_class(series.colour)}}, dots);
}

Markup endpoints(const Series& series, const Layout& layout) {
  const std::vector<Stretch> stretches = finite_stretches(series.x, series.y);
  if (stretches.empty()) return {};
  const auto dot = [&](std::string_view style, std::size_t row, std::string_view fill) {
    return element("circle", {{"class", style},
                              {"cx", layout.x(series.x[row])},
                              {"cy", layout.y(series.y[row])},
                              {"r", 3.6},
                              {"stroke", ink(series.colour)},
                              {"stroke-width", 1.4},
                              {"fill", fill}});
  };
  return element("g", {{"class", "endpoints " + colour_class(series.colour)}},
                 dot("start", stretches.front().begin, "#fff") +
                     dot("end", stretches.back().end - 1, ink(series.colour)));
}

}  // namespace

Markup draw(const Panel& panel) {
  const Layout layout(panel);
  Markup content = linear_zone(panel, layout) + y_axis(panel, layout) + x_axis(panel, layout);
  for (const Series& series : panel.series) content += Curve(series, layout).markup();
  if (!panel.heading.empty()) {
    content += element("text",
                       {{"class", "heading"},
                        {"x", layout.right()},
                        {"y", layout.top() - 10},
                        {"text-anchor", "end"}},
                       panel.heading);
  }
  if (panel.endpoints) {
    for (const Series& series : panel.series) content += endpoints(series, layout);
  }
  if (panel.points) {
    for (const Series& series : panel.series) content += points(series, layout);
  }
  const Markup styled = element("g", {{"font-size", 12.0}, {"font-family", "serif"}}, content);
  return svg(panel.width, layout.height(), panel.title, panel.description, styled);
}

double drawn_height(const Panel& panel) { return Layout(panel).height(); }

Markup legend(std::span<const LegendEntry> entries) {
  Markup items;
  for (const LegendEntry& entry : entries) {
    const Markup sample = element("line", {{"class", "line"},
                                           {"x1", 0.0},
                                           {"y1", 5.0},
                                           {"x2", 26.0},
                                           {"y2", 5.0},
                                           {"stroke", ink(entry.colour)},
                                           {"stroke-width", 2.5}});
    const Markup swatch = element(
        "svg",
        {{"width", 26.0}, {"height", 10.0}, {"viewBox", "0 0 26 10"}, {"aria-hidden", "true"}},
        sample);
    items += element("li", {{"class", colour_class(entry.colour)}}, swatch + " " + entry.label);
  }
  return element("ul", {{"class", "legend"}}, items);
}

std::span<const PaletteColour> palette() { return colours; }

std::string figure_style() {
  std::string light, dark, classes;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const std::string name = colour_class(i);
    light.append("--").append(name).append(":").append(colours[i].light).append(";");
    dark.append("--").append(name).append(":").append(colours[i].dark).append(";");
    classes.append(".").append(name).append("{--ink:var(--").append(name).append(")}\n");
  }
  return ":root{" + light + "}\n@media screen and (prefers-color-scheme:dark){:root{" + dark +
         "}}\n" + classes +
         R"css(svg text{fill:var(--text);font-family:var(--serif);font-size:12px}
.frame{stroke:var(--rule)}
.grid{stroke:var(--faint)}
.zero{stroke:var(--rule);stroke-width:.8}
.linear-zone{fill:var(--rule)}
.line{stroke:var(--ink)}
.band{stroke:var(--ink);fill:var(--ink)}
.endpoints circle{stroke:var(--ink)}
.start{fill:var(--page)}
.end{fill:var(--ink)}
)css";
}

}  // namespace courant::plot
