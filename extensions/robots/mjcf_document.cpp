#include "courant/extensions/robots/mjcf_document.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/extensions/importing/line_problems.hpp"

namespace courant::robots {
namespace {

// What is in an included file is told at the line that includes it.
void move_to(Element& element, const std::string& file, int line, const std::string& before) {
  element.origin =
      before + "(" + file + ", line " + std::to_string(element.line) + ") " + element.origin;
  element.line = line;
  for (Element& child : element.children) move_to(child, file, line, before);
}

Vector3d direction(const Element& element, const Vector3d& written, const std::string& what) {
  if (!(written.norm() > 1e-10))
    element.fail("has a " + what + " of length 0; expected a direction");
  return written.normalized();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> laid_over(
    const std::vector<std::pair<std::string, std::string>>& first,
    const std::vector<std::pair<std::string, std::string>>& second) {
  auto all = first;
  for (const auto& [name, value] : second)
    if (std::ranges::none_of(first, [&](const auto& one) { return one.first == name; }))
      all.emplace_back(name, value);
  return all;
}

MjcfDocument::MjcfDocument(const Element& root, const IncludedText& included)
    : root_(opened(root, included)) {
  const std::string angle = setting("angle", "degree");
  is_degree_ = angle == "degree";
  for (const Element& element : root_.children) {
    if (element.name == "compiler") {
      if (angle != "degree" && angle != "radian")
        element.fail("has the angle " + in_quotes(angle) + "; expected degree or radian");
      if (setting("coordinate", "local") != "local")
        element.fail("has global coordinates, which MuJoCo reads no more; expected local ones");
      std::string sequence = setting("eulerseq", "xyz");
      if (sequence.size() != 3 || sequence.find_first_not_of("xyzXYZ") != std::string::npos)
        element.fail("has the eulerseq " + in_quotes(sequence) +
                     "; expected three of x, y, z, X, Y and Z");
    }
  }
  classes_["main"];
  for (const Element& element : root_.children)
    if (element.name == "default") read_class(element, classes_.at("main"), true);
}

Element MjcfDocument::opened(const Element& element, const IncludedText& included) {
  Element result;
  result.name = element.name;
  result.line = element.line;
  result.origin = element.origin;
  result.attributes = element.attributes;
  result.text = element.text;
  for (const Element& child : element.children) {
    if (child.name != "include") {
      result.children.push_back(opened(child, included));
      continue;
    }
    const std::string& file = child.required("file");
    if (!included) child.fail("includes " + in_quotes(file) + ", and no files are here");
    if (!files_.insert(file).second)
      child.fail("includes " + in_quotes(file) + " a second time; expected once");
    constexpr std::size_t most = 100;
    if (files_.size() > most)
      child.fail("is one of more than " + std::to_string(most) + " included files");
    Element inner;
    try {
      inner = parse_xml(included(file));
    } catch (const std::runtime_error& error) {
      child.fail("includes " + in_quotes(file) + ", which " + error.what());
    } catch (const LineError& error) {
      throw LineError{child.line, child.origin + "(" + file + ", line " +
                                      std::to_string(error.line) + ") " + error.what};
    }
    move_to(inner, file, child.line, child.origin);
    for (Element& one : opened(inner, included).children) result.children.push_back(std::move(one));
  }
  return result;
}

// A class has what its parent has where it says nothing else.
void MjcfDocument::read_class(const Element& element, const Class& parent, bool is_outermost) {
  const std::string* name = element.attribute("class");
  if (!name && !is_outermost) element.fail("has no class; expected class=\"…\"");
  const std::string called = name ? *name : "main";
  if (!is_outermost && classes_.contains(called))
    element.fail("is the class " + in_quotes(called) +
                 ", which is there already; expected another name");
  Class values = parent;
  for (const Element& child : element.children)
    if (child.name != "default")
      values[child.name] = laid_over(child.attributes, values[child.name]);
  classes_[called] = values;
  if (is_outermost) classes_["main"] = values;
  for (const Element& child : element.children)
    if (child.name == "default") read_class(child, values, false);
}

Element MjcfDocument::with_defaults(const Element& element, const std::string& childclass) const {
  const std::string* own = element.attribute("class");
  const std::string& name = own ? *own : childclass;
  const auto found = classes_.find(name.empty() ? "main" : name);
  if (found == classes_.end()) {
    std::vector<std::string> names;
    for (const auto& [one, values] : classes_) names.push_back(one);
    element.fail("has the class " + in_quotes(name) + ", which no <default> is" +
                 did_you_mean(name, names));
  }
  Element result = element;
  const auto values = found->second.find(element.name);
  if (values != found->second.end())
    result.attributes = laid_over(element.attributes, values->second);
  return result;
}

std::string MjcfDocument::setting(const std::string& name, const std::string& otherwise) const {
  std::string value = otherwise;
  for (const Element& element : root_.children)
    if (element.name == "compiler")
      if (const std::string* given = element.attribute(name)) value = *given;
  return value;
}

std::optional<double> MjcfDocument::setting_number(const std::string& name) const {
  std::optional<double> value;
  for (const Element& element : root_.children)
    if (element.name == "compiler")
      if (const auto given = element.number(name)) value = given;
  return value;
}

Pose MjcfDocument::pose(const Element& element) const {
  return {orientation(element), element.vector("pos").value_or(Vector3d::Zero())};
}

Matrix3d MjcfDocument::orientation(const Element& element) const {
  if (const auto a = element.numbers("axisangle", 4))
    return turn(direction(element, Vector3d(a->data()), "axisangle"), angle((*a)[3]));
  if (const auto e = element.vector("euler")) {
    const Vector3d angles(angle((*e)[0]), angle((*e)[1]), angle((*e)[2]));
    return of_euler(setting("eulerseq", "xyz"), angles);
  }
  if (const auto a = element.numbers("xyaxes", 6)) {
    const Vector3d x = direction(element, Vector3d(a->data()), "xyaxes"), other(a->data() + 3);
    const Vector3d y = direction(element, other - x.dot(other) * x, "xyaxes");
    Matrix3d axes;
    axes << x, y, x.cross(y);
    return axes;
  }
  if (const auto z = element.vector("zaxis")) return z_to(direction(element, *z, "zaxis"));
  if (const auto q = element.numbers("quat", 4)) {
    const double n = std::hypot(std::hypot((*q)[0], (*q)[1]), std::hypot((*q)[2], (*q)[3]));
    if (!(n > 1e-10)) element.fail("has a quat of length 0; expected a quaternion");
    return of_quaternion((*q)[0] / n, (*q)[1] / n, (*q)[2] / n, (*q)[3] / n);
  }
  return Matrix3d::Identity();
}

}  // namespace courant::robots
