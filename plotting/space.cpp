#include "courant/plotting/space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "courant/plotting/curve_data.hpp"
#include "courant/plotting/decimation.hpp"
#include "courant/plotting/drawing.hpp"

namespace courant::plot {

namespace {

using Point = std::array<double, 3>;

constexpr double azimuth = 0.6, elevation = 0.42;
constexpr double eye_distance = 6;  // of half the cube's edge
constexpr double space_top = 24, space_margin = 14;

double dot_product(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

class Camera {
 public:
  explicit Camera(const Panel& panel) : radius_(panel.space->radius) {
    left_ = space_margin, right_ = panel.width - space_margin;
    top_ = space_top, bottom_ = panel.height - space_margin;
    middle_ = {(left_ + right_) / 2, (top_ + bottom_) / 2};
    const double half = std::min(right_ - left_, bottom_ - top_) / 2;
    Interval x, y, z;
    for (const Series& series : panel.series) {
      x.include(series.x);
      y.include(series.y);
      z.include(series.z);
    }
    if (radius_ > 0) {
      size_ = radius_;
      scale_ = half * 0.88;
    } else if (!x.empty() && !y.empty() && !z.empty()) {
      centre_ = {(x.lower + x.upper) / 2, (y.lower + y.upper) / 2, (z.lower + z.upper) / 2};
      size_ = std::max({x.length(), y.length(), z.length()}) / 2;
      if (!(size_ > 0)) size_ = 1;
      scale_ = half * 0.62;  // 1/√3 at the corners, a little more by the perspective
    }
  }

  bool sphere() const { return radius_ > 0; }
  double size() const { return size_; }
  const Point& centre() const { return centre_; }

  Vertex pixel(const Point& point) const {
    const Point p = relative(point);
    const double w = sphere() ? 1 : eye_distance / (eye_distance - dot_product(p, toward_));
    return {middle_.x + scale_ * w * dot_product(p, right_vector_),
            middle_.y - scale_ * w * dot_product(p, up_)};
  }
  bool in_front(const Point& point) const {
    return !sphere() || dot_product(relative(point), toward_) >= 0;
  }

  Markup outline() const {
    return element("circle", {{"class", "wire"},
                              {"cx", middle_.x},
                              {"cy", middle_.y},
                              {"r", scale_},
                              {"fill", "none"},
                              {"stroke", "#777"},
                              {"stroke-width", 0.9}});
  }
  std::string area() const { return number_list({left_, top_, right_, bottom_}); }
  std::string numbers() const {
    return number_list({centre_[0], centre_[1], centre_[2], size_, middle_.x, middle_.y, scale_,
                        sphere() ? 0 : eye_distance});
  }

 private:
  Point relative(const Point& point) const {
    return {(point[0] - centre_[0]) / size_, (point[1] - centre_[1]) / size_,
            (point[2] - centre_[2]) / size_};
  }

  double radius_, left_, right_, top_, bottom_;
  Vertex middle_{};
  Point centre_ = {0, 0, 0};
  double size_ = 1, scale_ = 1;
  Point right_vector_ = {-std::sin(azimuth), std::cos(azimuth), 0};
  Point up_ = {-std::sin(elevation) * std::cos(azimuth), -std::sin(elevation) * std::sin(azimuth),
               std::cos(elevation)};
  Point toward_ = {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                   std::sin(elevation)};
};

// A polyline in two parts: what is in front, and what is behind.
class Sides {
 public:
  explicit Sides(const Camera& camera) : camera_(camera) {}

  void add(std::span<const Point> points) {
    for (std::size_t begin = 0; begin + 1 < points.size();) {
      const bool front = camera_.in_front(points[begin]);
      std::size_t end = begin + 1;
      while (end + 1 < points.size() && camera_.in_front(points[end]) == front) ++end;
      std::vector<Vertex> path;
      for (std::size_t i = begin; i <= end; ++i) path.push_back(camera_.pixel(points[i]));
      const std::vector<Vertex> kept = simplified(path, 0.1);
      PathData& data = front ? front_ : back_;
      data.move_to(kept.front().x, kept.front().y);
      for (std::size_t i = 1; i < kept.size(); ++i) data.line_to(kept[i].x, kept[i].y);
      begin = end;
    }
  }

  // The points alone, as lines without length, whose round caps are seen.
  void add_points(std::span<const Point> points) {
    for (const Point& point : points) {
      PathData& data = camera_.in_front(point) ? front_ : back_;
      const Vertex at = camera_.pixel(point);
      data.move_to(at.x, at.y);
      data.close();
    }
  }

  const PathData& front() const { return front_; }
  const PathData& back() const { return back_; }

 private:
  const Camera& camera_;
  PathData front_, back_;
};

Markup wire(const PathData& data, double opacity) {
  return element("path", {{"class", "wire"},
                          {"d", data.str()},
                          {"fill", "none"},
                          {"stroke", "#777"},
                          {"stroke-opacity", opacity},
                          {"stroke-width", 0.7}});
}

// The outline, and circles of latitude and longitude every 30 degrees.
Markup graticule(const Camera& camera) {
  Sides sides(camera);
  constexpr int pieces = 72;
  const auto circle = [&](const auto& point) {
    std::vector<Point> points;
    for (int i = 0; i <= pieces; ++i)
      points.push_back(point(2 * std::numbers::pi * i / pieces, camera.size()));
    sides.add(points);
  };
  for (int degrees = -60; degrees <= 60; degrees += 30) {
    const double latitude = degrees * std::numbers::pi / 180;
    circle([&](double angle, double r) {
      return Point{r * std::cos(latitude) * std::cos(angle),
                   r * std::cos(latitude) * std::sin(angle), r * std::sin(latitude)};
    });
  }
  for (int degrees = 0; degrees < 180; degrees += 30) {
    const double longitude = degrees * std::numbers::pi / 180;
    circle([&](double angle, double r) {
      return Point{r * std::cos(angle) * std::cos(longitude),
                   r * std::cos(angle) * std::sin(longitude), r * std::sin(angle)};
    });
  }
  return camera.outline() + wire(sides.back(), 0.25) + wire(sides.front(), 0.55);
}

Markup cube(const Camera& camera) {
  PathData edges;
  const double h = camera.size();
  const Point& c = camera.centre();
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 4; ++corner) {
      Point begin = c;
      begin[static_cast<std::size_t>((axis + 1) % 3)] += (corner & 1) != 0 ? h : -h;
      begin[static_cast<std::size_t>((axis + 2) % 3)] += (corner & 2) != 0 ? h : -h;
      Point end = begin;
      begin[static_cast<std::size_t>(axis)] -= h;
      end[static_cast<std::size_t>(axis)] += h;
      const Vertex from = camera.pixel(begin), to = camera.pixel(end);
      edges.move_to(from.x, from.y);
      edges.line_to(to.x, to.y);
    }
  }
  return wire(edges, 0.55);
}

// The names of the axes: where they leave the sphere, or beside three edges of the cube.
Markup names(const Panel& panel, const Camera& camera) {
  const std::array<std::string, 3> labels = {panel.x.label, panel.y.label, panel.space->z_label};
  Markup all;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Point at = camera.centre();
    if (camera.sphere()) {
      at[axis] += 1.12 * camera.size();
    } else {
      at[0] += (axis == 1 ? 1.12 : 1) * camera.size();
      at[1] += (axis == 1 ? 1 : axis == 0 ? 1.12 : -1.08) * camera.size();
      at[2] -= camera.size();
      at[axis] = camera.centre()[axis];
    }
    const Vertex pixel = camera.pixel(at);
    all += text(pixel.x, pixel.y + 4, "middle", mathematics(labels[axis]));
  }
  return all;
}

Markup curve(const Series& series, const Camera& camera, bool as_points, std::size_t rows) {
  Sides sides(camera);
  std::vector<Point> points;
  const auto finish = [&] {
    as_points ? sides.add_points(points) : sides.add(points);
    points.clear();
  };
  for (std::size_t row = 0; row < series.x.size(); ++row) {
    const Point point = {series.x[row], series.y[row], series.z[row]};
    if (std::ranges::all_of(point, [](double value) { return std::isfinite(value); }))
      points.push_back(point);
    else
      finish();
  }
  finish();
  const auto part = [&](const PathData& data, double opacity) {
    return element("path", {{"class", "line"},
                            {"d", data.str()},
                            {"fill", "none"},
                            {"stroke", ink(series.colour)},
                            {"stroke-width", as_points ? 3.6 : 1.4},
                            {"stroke-linecap", as_points ? "round" : "butt"},
                            {"stroke-opacity", opacity}});
  };
  const Markup content =
      element("title", {}, series.label) + part(sides.back(), 0.4) + part(sides.front(), 1);
  const std::string style = "series " + colour_class(series.colour);
  if (rows == 0) return element("g", {{"class", style}, {"stroke-linejoin", "round"}}, content);
  return with_data(style, curve_data(series, rows), content);
}

Markup endpoints(const Series& series, const Camera& camera) {
  Markup dots;
  const auto place = [&](std::string_view style, std::size_t row) {
    const Vertex at = camera.pixel({series.x[row], series.y[row], series.z[row]});
    if (std::isfinite(at.x) && std::isfinite(at.y))
      dots += dot(style, at.x, at.y, 3.6, series.colour);
  };
  if (series.x.empty()) return {};
  place("start", 0);
  place("end", series.x.size() - 1);
  return element("g", {{"class", "endpoints " + colour_class(series.colour)}}, dots);
}

}  // namespace

Markup draw_in_space(const Panel& panel, std::size_t rows) {
  const Camera camera(panel);
  Markup content =
      element("g", {{"class", "scaffold"}},
              (camera.sphere() ? graticule(camera) : cube(camera)) + names(panel, camera));
  for (const Series& series : panel.series) content += curve(series, camera, panel.points, rows);
  if (panel.endpoints)
    for (const Series& series : panel.series) content += endpoints(series, camera);
  if (!panel.heading.empty())
    content += element("text",
                       {{"class", "heading"},
                        {"x", panel.width - space_margin},
                        {"y", 16.0},
                        {"text-anchor", "end"}},
                       panel.heading);
  const Markup styled = rows == 0
                            ? element("g", {{"font-size", 12.0}, {"font-family", "serif"}}, content)
                            : element("g",
                                      {{"class", "panel"},
                                       {"font-size", 12.0},
                                       {"font-family", "serif"},
                                       {"data-x-name", panel.x.label},
                                       {"data-y-name", panel.y.label},
                                       {"data-z-name", panel.space->z_label},
                                       {"data-area", camera.area()},
                                       {"data-space", camera.numbers()},
                                       {"data-points", panel.points ? "points" : ""},
                                       {"data-camera", number_list({azimuth, elevation})}},
                                      content);
  return svg(panel.width, panel.height, panel.title, panel.description, styled);
}

}  // namespace courant::plot
