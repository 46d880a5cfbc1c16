#include "courant/extensions/robots/mjcf_geom.hpp"

#include <cmath>
#include <numbers>

#include "courant/core/words/message.hpp"

namespace courant::robots {
namespace {

using std::numbers::pi;

// Half sizes along the axes of the geom: radius and half length of round ones, as <geom size> has them.
struct Shape {
  std::string type;
  Vector3d size = Vector3d::Zero();
  Pose pose;
};

double volume(const Shape& shape) {
  const auto [a, b, c] = std::tuple(shape.size[0], shape.size[1], shape.size[2]);
  if (shape.type == "sphere") return 4.0 / 3.0 * pi * a * a * a;
  if (shape.type == "capsule") return pi * a * a * (4.0 / 3.0 * a + 2.0 * b);
  if (shape.type == "cylinder") return 2.0 * pi * a * a * b;
  if (shape.type == "ellipsoid") return 4.0 / 3.0 * pi * a * b * c;
  return 8.0 * a * b * c;
}

// The principal moments of a body of mass 1.
Vector3d moments(const Shape& shape) {
  const auto [a, b, c] = std::tuple(shape.size[0], shape.size[1], shape.size[2]);
  if (shape.type == "sphere") return Vector3d::Constant(0.4 * a * a);
  if (shape.type == "cylinder") {
    const double across = (3.0 * a * a + 4.0 * b * b) / 12.0;
    return {across, across, 0.5 * a * a};
  }
  if (shape.type ==
      "capsule") {  // a cylinder between two halves of a ball, whose centres are 3/8 of the radius away
    const double balls = 4.0 / 3.0 * a / (4.0 / 3.0 * a + 2.0 * b), cylinder = 1.0 - balls;
    const double across = cylinder * (3.0 * a * a + 4.0 * b * b) / 12.0 +
                          balls * (0.4 * a * a + b * b + 0.75 * a * b);
    return {across, across, cylinder * 0.5 * a * a + balls * 0.4 * a * a};
  }
  const double part = shape.type == "ellipsoid" ? 5.0 : 3.0;
  return Vector3d(b * b + c * c, a * a + c * c, a * a + b * b) / part;
}

Shape shape_of(const Element& geom, const MjcfDocument& document, const std::string& type) {
  const bool is_round = type == "capsule" || type == "cylinder";
  Shape shape{type, Vector3d::Zero(), document.pose(geom)};
  const std::vector<double> size = geom.attribute("size")
                                       ? numbers_in(geom, *geom.attribute("size"), "size")
                                       : std::vector<double>();
  const auto ends = geom.numbers("fromto", 6);
  const bool has_ends = ends && type != "sphere";
  const std::size_t needed = has_ends || type == "sphere" ? 1 : is_round ? 2 : 3;
  if (size.size() < needed || size.size() > 3)
    geom.fail("has " + std::to_string(size.size()) + (size.size() == 1 ? " number" : " numbers") +
              " in size; expected " + std::to_string(needed) + " of a " + type);
  for (std::size_t i = 0; i < size.size(); ++i) shape.size[static_cast<Eigen::Index>(i)] = size[i];
  if (has_ends) {
    const Vector3d from(ends->data()), to(ends->data() + 3);
    const double length = (to - from).norm();
    if (!(length > 1e-10)) geom.fail("has two equal points in fromto; expected different ones");
    shape.pose = {z_to((from - to) / length), 0.5 * (from + to)};
    if (is_round)
      shape.size[1] = 0.5 * length;
    else
      shape.size = {size[0], size[0], 0.5 * length};
  }
  for (std::size_t i = 0; i < (type == "sphere" ? 1U : is_round ? 2U : 3U); ++i)
    if (!(shape.size[static_cast<Eigen::Index>(i)] > 0.0))
      geom.fail("has a size of " + number_text(shape.size[static_cast<Eigen::Index>(i)]) +
                "; expected above 0");
  return shape;
}

}  // namespace

GeomInertia geom_inertia(const Element& geom, const MjcfDocument& document) {
  const std::string* written = geom.attribute("type");
  const std::string type = written ? *written : geom.attribute("mesh") ? "mesh" : "sphere";
  if (type == "plane" || type == "hfield") return {};
  const auto mass = geom.number("mass");
  if (mass && *mass < 0.0) geom.fail("has a mass below 0; expected at least 0");
  const double density = geom.number("density").value_or(1000.0);
  if (density < 0.0) geom.fail("has a density below 0; expected at least 0");
  if (mass.value_or(density) == 0.0) return {};
  if (type == "mesh" || type == "sdf" || geom.attribute("mesh"))
    return {{}, "the mass of a mesh is not computed; expected an <inertial> in its body"};
  if (type != "sphere" && type != "capsule" && type != "cylinder" && type != "ellipsoid" &&
      type != "box")
    geom.fail("has the type " + in_quotes(type) +
              "; expected plane, hfield, sphere, capsule, ellipsoid, cylinder, box, mesh or sdf");
  if (const std::string* shell = geom.attribute("shellinertia"); shell && *shell == "true")
    return {{}, "the inertia of a shell is not computed; expected an <inertial> in its body"};
  const Shape shape = shape_of(geom, document, type);
  const double amount = mass.value_or(density * volume(shape));
  return {shape.pose * Inertia{amount, Vector3d::Zero(), (amount * moments(shape)).asDiagonal()},
          ""};
}

}  // namespace courant::robots
