#include "courant/plotting/figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "courant/plotting/curve_data.hpp"
#include "courant/plotting/decimation.hpp"
#include "courant/plotting/drawing.hpp"
#include "courant/plotting/space.hpp"

namespace courant::plot {

namespace {

constexpr double left_margin = 62, right_margin = 18, top_margin = 26, bottom_margin = 42;
constexpr double padding = 0.03;  // of the axis, between data and frame

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
    return axis.is_window ? interval : axis.scale->padded(interval, padding);
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

Ticks x_ticks(const Panel& panel, const Layout& layout) {
  const int about = static_cast<int>((layout.right() - layout.left()) / 80);
  return panel.x.scale->ticks(layout.x_interval(), about);
}

Ticks y_ticks(const Panel& panel, const Layout& layout) {
  const int about = std::max(5, static_cast<int>((layout.bottom() - layout.top()) / 40));
  return panel.y.scale->ticks(layout.y_interval(), about);
}

Markup x_axis(const Panel& panel, const Layout& layout) {
  const double bottom = layout.bottom();
  const Ticks ticks = x_ticks(panel, layout);
  Markup marks;
  for (const Tick& tick : ticks.marks) {
    const double x = layout.x(tick.value);
    marks += line("frame", x, bottom, x, bottom + (tick.label.empty() ? 2.5 : 5), "#777");
    if (!tick.label.empty()) marks += text(x, bottom + 18, "middle", tick.label);
  }
  const std::string label = with_exponent(panel.x.label, ticks.exponent);
  return element(
      "g", {{"class", "axis"}},
      line("frame", layout.left(), bottom, layout.right(), bottom, "#777") +
          element("g", {{"class", "x-ticks"}}, marks) +
          text((layout.left() + layout.right()) / 2, bottom + 36, "middle", mathematics(label)));
}

Markup y_axis(const Panel& panel, const Layout& layout) {
  const double left = layout.left();
  const Ticks ticks = y_ticks(panel, layout);
  Markup marks;
  for (const Tick& tick : ticks.marks) {
    const double y = layout.y(tick.value);
    if (!tick.label.empty()) {
      marks += line(tick.value == 0 && !panel.equal_aspect ? "zero" : "grid", left, y,
                    layout.right(), y, "#ddd");
      marks += text(left - 8, y + 4, "end", tick.label);
    }
    marks += line("frame", left - (tick.label.empty() ? 2.5 : 5), y, left, y, "#777");
  }
  const std::string label = with_exponent(panel.y.label, ticks.exponent);
  return element("g", {{"class", "axis"}},
                 element("g", {{"class", "y-ticks"}}, marks) +
                     line("frame", left, layout.top(), left, layout.bottom(), "#777") +
                     text(left - 5, layout.top() - 10, "start", mathematics(label)));
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

// What is subtracted from the values of a linear axis before they become float32: 0, or, where they
// are large next to their differences, the least of them, so that six digits of these stay.
double data_origin(const Scale& scale, Interval shown) {
  const bool far = std::abs(shown.lower + shown.upper) > 16 * shown.length();
  return far && std::isinf(scale.linear_zone().upper) ? shown.lower : 0;
}

// The curves of one series.
class Curve {
 public:
  Curve(const Series& series, const Panel& panel, const Layout& layout, std::size_t rows)
      : series_(series), panel_(panel), layout_(layout), rows_(rows) {
    const bool function = std::is_sorted(series.x.begin(), series.x.end());
    const auto columns = static_cast<int>(layout.right() - layout.left());
    for (const Stretch stretch : finite_stretches(series.x, series.y)) {
      if (panel.scattered) {
        dots(stretch);
      } else if (function && stretch.size() > 4 * static_cast<std::size_t>(columns)) {
        band(stretch, columns);
      } else {
        polyline(stretch);
      }
    }
  }

  Markup markup() const {
    const std::string style = "series " + colour_class(series_.colour);
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
      curve += element("path", {{"class", panel_.scattered ? "dots" : "line"},
                                {"d", line_.str()},
                                {"fill", "none"},
                                {"stroke", ink(series_.colour)},
                                {"stroke-width", panel_.scattered ? 3.0 : 1.4},
                                {"stroke-linecap", panel_.scattered ? "round" : "butt"}});
    }
    if (rows_ == 0) return element("g", {{"class", style}, {"stroke-linejoin", "round"}}, curve);
    const double x_origin = data_origin(*panel_.x.scale, layout_.x_interval());
    const double y_origin = data_origin(*panel_.y.scale, layout_.y_interval());
    return with_data(style, curve_data(series_, rows_, {x_origin, y_origin}), curve);
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
    // A rough path has a vertex at every row: then some stand for all, and it stays as rough.
    constexpr std::size_t most_vertices = 4000;
    for (const std::size_t i : evenly_spaced_rows(kept.size(), most_vertices))
      if (i > 0) line_.line_to(kept[i].x, kept[i].y);
  }

  // Lines without length, whose round caps are seen.
  void dots(Stretch stretch) {
    for (std::size_t row = stretch.begin; row < stretch.end; ++row) {
      const Vertex at = pixel(series_.x[row], series_.y[row]);
      line_.move_to(at.x, at.y);
      line_.close();
    }
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
  const Panel& panel_;
  const Layout& layout_;
  std::size_t rows_;
  PathData line_, band_;
};

Markup points(const Series& series, const Layout& layout) {
  Markup dots;
  for (std::size_t row = 0; row < series.x.size(); ++row) {
    const double x = layout.x(series.x[row]), y = layout.y(series.y[row]);
    if (std::isfinite(x) && std::isfinite(y)) dots += dot("end", x, y, 3, series.colour);
  }
  return element("g", {{"class", "endpoints " + colour_class(series.colour)}}, dots);
}

Markup endpoints(const Series& series, const Layout& layout) {
  const std::vector<Stretch> stretches = finite_stretches(series.x, series.y);
  if (stretches.empty()) return {};
  const auto at = [&](std::string_view style, std::size_t row) {
    return dot(style, layout.x(series.x[row]), layout.y(series.y[row]), 3.6, series.colour);
  };
  return element("g", {{"class", "endpoints " + colour_class(series.colour)}},
                 at("start", stretches.front().begin) + at("end", stretches.back().end - 1));
}

// "0-1 1-": between the first two curves, between the second and the origin.
std::string rods(const Panel& panel) {
  std::string all;
  for (const Rod& rod : panel.rods)
    all += (all.empty() ? "" : " ") + std::to_string(rod.from) + "-" +
           (rod.to ? std::to_string(*rod.to) : "");
  return all;
}

// What a script has to know to draw the panel again.
Markup for_script(const Panel& panel, const Layout& layout, const Markup& content) {
  const Interval x = layout.x_interval(), y = layout.y_interval();
  const auto zone = [](const Scale& scale) {
    const double upper = scale.linear_zone().upper;
    return std::isfinite(upper) ? upper : std::numeric_limits<double>::max();
  };
  const auto exponent = [](const Ticks& ticks) { return static_cast<double>(ticks.exponent); };
  return element(
      "g",
      {{"class", "panel"},
       {"font-size", 12.0},
       {"font-family", "serif"},
       {"data-x-name", panel.x.label},
       {"data-y-name", panel.y.label},
       {"data-area", number_list({layout.left(), layout.top(), layout.right(), layout.bottom()})},
       {"data-view", number_list({x.lower, x.upper, y.lower, y.upper})},
       {"data-origin",
        number_list({data_origin(*panel.x.scale, x), data_origin(*panel.y.scale, y)})},
       {"data-zone", number_list({zone(*panel.x.scale), zone(*panel.y.scale)})},
       {"data-exponent",
        number_list({exponent(x_ticks(panel, layout)), exponent(y_ticks(panel, layout))})},
       {"data-equal", panel.equal_aspect ? "equal" : ""},
       {"data-rods", rods(panel)}},
      content);
}

// What is inside of the plotted area.
Markup cut_off(const Layout& layout, const Markup& curves) {
  const double width = layout.right() - layout.left(), height = layout.bottom() - layout.top();
  return element("svg",
                 {{"x", layout.left()},
                  {"y", layout.top()},
                  {"width", width},
                  {"height", height},
                  {"overflow", "hidden"},
                  {"viewBox", number_list({layout.left(), layout.top(), width, height})}},
                 curves);
}

}  // namespace

Markup draw(const Panel& panel, std::size_t rows) {
  if (panel.space) return draw_in_space(panel, rows);
  const Layout layout(panel);
  Markup content = linear_zone(panel, layout) + y_axis(panel, layout) + x_axis(panel, layout);
  Markup curves;
  for (const Series& series : panel.series) curves += Curve(series, panel, layout, rows).markup();
  if (panel.endpoints) {
    for (const Series& series : panel.series) curves += endpoints(series, layout);
  }
  if (panel.points) {
    for (const Series& series : panel.series) curves += points(series, layout);
  }
  content += panel.x.is_window || panel.y.is_window ? cut_off(layout, curves) : curves;
  if (!panel.heading.empty()) {
    content += element("text",
                       {{"class", "heading"},
                        {"x", layout.right()},
                        {"y", layout.top() - 10},
                        {"text-anchor", "end"}},
                       panel.heading);
  }
  const Markup styled = rows == 0
                            ? element("g", {{"font-size", 12.0}, {"font-family", "serif"}}, content)
                            : for_script(panel, layout, content);
  return svg(panel.width, layout.height(), panel.title, panel.description, styled);
}

double drawn_height(const Panel& panel) {
  return panel.space ? panel.height : Layout(panel).height();
}

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

std::string figure_style() {
  std::string light, dark, classes;
  for (std::size_t i = 0; i < palette().size(); ++i) {
    const std::string name = colour_class(i);
    light.append("--").append(name).append(":").append(palette()[i].light).append(";");
    dark.append("--").append(name).append(":").append(palette()[i].dark).append(";");
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
.wire{stroke:var(--rule)}
.start{fill:var(--page)}
.end{fill:var(--ink)}
)css";
}

}  // namespace courant::plot
