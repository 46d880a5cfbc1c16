// A model of MuJoCo with its included files in place, its settings and its classes of defaults.
#pragma once

#include <map>
#include <set>
#include <string>

#include "courant/extensions/importing/included_text.hpp"
#include "courant/extensions/robots/robot.hpp"
#include "courant/extensions/robots/xml.hpp"

namespace courant::robots {

// A model as its file has it, after <include>: elements with the attributes that classes of defaults give them, and what
// <compiler> says of angles and poses.
class MjcfDocument {
 public:
  // `root` is the element <mujoco>. Throws LineError.
  MjcfDocument(const Element& root, const IncludedText& included);

  const Element& root() const { return root_; }
  // The element with the attributes that its class gives it: its own `class`, else `childclass`, else that of all.
  Element with_defaults(const Element& element, const std::string& childclass) const;
  // An attribute of <compiler>, or what it is without.
  std::string setting(const std::string& name, const std::string& otherwise) const;
  std::optional<double> setting_number(const std::string& name) const;

  // In radians, as <compiler angle> says.
  double angle(double written) const {
    return is_degree_ ? written * (kHalfTurn / 180.0) : written;
  }
  // By `pos` and `quat`, `axisangle`, `euler`, `xyaxes` or `zaxis`.
  Pose pose(const Element& element) const;

 private:
  static constexpr double kHalfTurn = 3.14159265358979323846;
  using Attributes = std::vector<std::pair<std::string, std::string>>;
  using Class = std::map<std::string, Attributes>;  // by the name of the element

  Element opened(const Element& element, const IncludedText& included);
  void read_class(const Element& element, const Class& parent, bool is_outermost);
  Matrix3d orientation(const Element& element) const;

  std::set<std::string> files_;  // which have been included
  Element root_;
  std::map<std::string, Class> classes_;
  bool is_degree_ = true;
};

// Lays the attributes of the first over those of the second.
std::vector<std::pair<std::string, std::string>> laid_over(
    const std::vector<std::pair<std::string, std::string>>& first,
    const std::vector<std::pair<std::string, std::string>>& second);

}  // namespace courant::robots
