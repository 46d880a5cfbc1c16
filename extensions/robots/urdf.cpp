#include "courant/extensions/robots/urdf.hpp"

#include <set>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"

namespace courant::robots {
namespace {

Place place_of(const Element& element) { return {element.line, element.origin}; }

const Element& required_child(const Element& parent, const std::string& name) {
  const Element* child = parent.child(name);
  if (!child) parent.fail("has no <" + name + ">; expected one");
  return *child;
}

Pose origin_of(const Element& parent) {
  const Element* origin = parent.child("origin");
  if (!origin) return {};
  return {of_rpy(origin->vector("rpy").value_or(Vector3d::Zero())),
          origin->vector("xyz").value_or(Vector3d::Zero())};
}

double required_number(const Element& element, const std::string& name) {
  element.required(name);
  return *element.number(name);
}

class UrdfReader {
 public:
  explicit UrdfReader(const Element& root) : root_(root) {}

  Robot read() {
    refuse_xacro(root_);
    if (const std::string* name = root_.attribute("name")) robot_.title = *name;
    for (const Element& element : root_.children)
      if (element.name == "link") add_link(element);
    require_different_names(robot_);
    if (robot_.links.size() == 1) root_.fail("has no <link>; expected at least one");
    for (const Element& element : root_.children)
      if (element.name == "joint") add_joint(element);
    require_different_names(robot_);
    for (const auto& [element, joint] : mimics_) add_mimic(*element, joint);
    for (const Element& element : root_.children) pass_over(element);
    fix_root();
    return robot_;
  }

 private:
  static void refuse_xacro(const Element& element) {
    if (element.name.starts_with("xacro:") || element.name == "macro")
      element.fail("is of xacro, the macros of URDF; run `xacro FILE.xacro > FILE.urdf` first");
    for (const Element& child : element.children) refuse_xacro(child);
  }

  void add_link(const Element& element) {
    Link link{.name = element.required("name"), .place = place_of(element)};
    if (const Element* inertial = element.child("inertial")) {
      const Element& inertia = required_child(*inertial, "inertia");
      const auto entry = [&](const char* name) { return required_number(inertia, name); };
      const Inertia given{required_number(required_child(*inertial, "mass"), "value"),
                          Vector3d::Zero(),
                          symmetric(entry("ixx"), entry("iyy"), entry("izz"), entry("ixy"),
                                    entry("ixz"), entry("iyz"))};
      check_inertia(given, place_of(*inertial), "the link " + in_quotes(link.name));
      link.inertia = origin_of(*inertial) * given;
    }
    robot_.links.push_back(link);
  }

  void add_joint(const Element& element) {
    Joint joint{.name = element.required("name"), .place = place_of(element)};
    joint.type = type_of(element);
    const auto link = [&](const char* end) {
      const Element& named = required_child(element, end);
      return link_named(robot_, named.required("link"), place_of(named));
    };
    joint.parent = link("parent");
    joint.child = link("child");
    if (const auto [first, is_new] = parent_of_.try_emplace(joint.child, robot_.joints.size());
        !is_new)
      element.fail("has the child " + in_quotes(robot_.links[joint.child].name) +
                   ", which is that of the joint " + in_quotes(robot_.joints[first->second].name) +
                   " already; expected a tree");
    joint.origin = origin_of(element);
    if (joint.type == JointType::revolute || joint.type == JointType::prismatic ||
        joint.type == JointType::planar)
      joint.axes = {axis_of(element)};
    if (const Element* dynamics = element.child("dynamics")) {
      joint.damping = dynamics->number("damping").value_or(0.0);
      if (joint.damping < 0.0) dynamics->fail("has a damping below 0; expected at least 0");
      if (dynamics->number("friction").value_or(0.0) != 0.0)
        robot_.notes.add(place_of(*dynamics), "dry friction of joints is left out");
    }
    if (element.child("limit") && element.required("type") != "continuous" &&
        joint.type != JointType::fixed)
      robot_.notes.add(
          place_of(*element.child("limit")),
          "limits of joints are left out: they move beyond them, with any effort and velocity");
    if (const Element* mimic = element.child("mimic"))
      mimics_.emplace_back(mimic, robot_.joints.size());
    robot_.joints.push_back(joint);
  }

  static JointType type_of(const Element& element) {
    static const std::vector<std::pair<std::string, JointType>> known = {
        {"revolute", JointType::revolute},   {"continuous", JointType::revolute},
        {"prismatic", JointType::prismatic}, {"fixed", JointType::fixed},
        {"floating", JointType::floating},   {"planar", JointType::planar}};
    const std::string& type = element.required("type");
    std::vector<std::string> names;
    for (const auto& [name, of] : known) {
      if (name == type) return of;
      names.push_back(name);
    }
    element.fail("has the type " + in_quotes(type) +
                 "; expected revolute, continuous, prismatic, fixed, floating or planar" +
                 did_you_mean(type, names));
  }

  static Vector3d axis_of(const Element& element) {
    const Element* axis = element.child("axis");
    if (!axis) return Vector3d::UnitX();
    axis->required("xyz");
    const Vector3d direction = *axis->vector("xyz");
    if (!(direction.norm() > 1e-6)) axis->fail("is zero; expected a direction");
    return direction;
  }

  void add_mimic(const Element& element, std::size_t joint) {
    const std::string& name = element.required("joint");
    std::vector<std::string> names;
    for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
      names.push_back(robot_.joints[i].name);
      if (names.back() != name) continue;
      robot_.couplings.push_back({place_of(element), joint, i,
                                  element.number("multiplier").value_or(1.0),
                                  element.number("offset").value_or(0.0)});
      return;
    }
    element.fail("has an unknown joint " + in_quotes(name) + did_you_mean(name, names));
  }

  void pass_over(const Element& element) {
    static const std::set<std::string> read = {"link", "joint", "material", "version"};
    if (!read.contains(element.name))
      robot_.notes.add(place_of(element),
                       "<" + element.name + "> is left out, with all that is in it");
  }

  // A tree has one root.
  void fix_root() {
    std::vector<std::size_t> roots;
    for (std::size_t i = 1; i < robot_.links.size(); ++i)
      if (!parent_of_.contains(i)) roots.push_back(i);
    if (roots.empty())
      fail(robot_.links[1].place,
           "every link is the child of a joint: joints form a circle; expected a tree with one "
           "root");
    if (roots.size() > 1)
      fail(robot_.links[roots[1]].place,
           "no joint has the link " + in_quotes(robot_.links[roots[1]].name) +
               " as its child, as it is with " + in_quotes(robot_.links[roots[0]].name) +
               "; expected a tree with one root");
    const Link& root = robot_.links[roots[0]];
    require_no_circle(roots[0]);
    if (root.name != "world")
      robot_.notes.add(
          root.place,
          "the root link " + in_quotes(root.name) +
              " is fixed to the ground; a link \"world\" with a joint of the type floating to it "
              "would let it move");
    robot_.joints.push_back({.name = "",
                             .place = root.place,
                             .type = JointType::fixed,
                             .parent = 0,
                             .child = roots[0]});
  }

  // All links hang on the root, or those that do not form a circle.
  void require_no_circle(std::size_t root) const {
    std::vector<bool> hangs(robot_.links.size(), false);
    hangs[root] = true;
    for (std::size_t i = 1; i < robot_.links.size(); ++i) {
      std::vector<std::size_t> path;
      for (std::size_t at = i; !hangs[at]; at = robot_.joints[parent_of_.at(at)].parent) {
        path.push_back(at);
        if (path.size() > robot_.links.size())
          fail(robot_.joints[parent_of_.at(i)].place,
               "the link " + in_quotes(robot_.links[i].name) +
                   " hangs on a circle of joints; expected a tree");
      }
      for (const std::size_t at : path) hangs[at] = true;
    }
  }

  const Element& root_;
  Robot robot_;
  std::map<std::size_t, std::size_t> parent_of_;  // the joint of which a link is the child
  std::vector<std::pair<const Element*, std::size_t>> mimics_;
};

}  // namespace

Robot read_urdf(const Element& root) { return UrdfReader(root).read(); }

}  // namespace courant::robots
