#include "courant/extensions/robots/mechanism_of_robot.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <deque>
#include <numbers>
#include <set>

#include "courant/core/language/declaration.hpp"
#include "courant/core/words/message.hpp"
#include "courant/extensions/importing/different_names.hpp"

namespace courant::robots {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

// A body: links that are fixed to each other, in the frame of the first one.
struct Body {
  std::size_t link;
  Inertia inertia = {};
  std::vector<std::pair<std::string, Vector3d>> points = {};
  Pose frame = {};            // of the body in the system, in that of the link
  std::size_t joint = kNone;  // by which it hangs on its parent
  std::size_t children = 0;   // how many bodies hang on it
};

std::string type_name(JointType type) {
  switch (type) {
    case JointType::fixed:
      return "fixed";
    case JointType::revolute:
      return "revolute";
    case JointType::prismatic:
      return "prismatic";
    case JointType::planar:
      return "planar";
    case JointType::universal:
      return "universal";
    case JointType::ball:
      return "spherical";
    case JointType::floating:
      break;
  }
  return "floating";
}

// `scale`: the size of what the vector is a difference of.
Json numbers(const Vector3d& vector, double scale = 0.0) {
  scale = std::max(scale, vector.cwiseAbs().maxCoeff());
  Json list = Json::array();
  for (const double entry : vector) list.push_back(tidy(entry, scale));
  return list;
}

Json inertia_entries(const Matrix3d& inertia) {
  const double scale = inertia.cwiseAbs().maxCoeff();
  Json list = Json::array();
  for (const auto& [i, j] : {std::pair(0, 0), {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}})
    list.push_back(tidy(0.5 * (inertia(i, j) + inertia(j, i)), scale));
  return list;
}

// An angle; one that agrees with a part of π to 12 digits is that part, so that cosines that are 0 are 0.
Json angle(double value) {
  for (const int part : {1, 2, 3, 4, 6}) {
    const double count = std::round(value * part / std::numbers::pi);
    if (std::abs(value - count * std::numbers::pi / part) > 1e-12) continue;
    if (count == 0.0) return 0.0;
    const std::string times = std::abs(count) == 1.0 ? "" : number_text(std::abs(count)) + "*";
    return (count < 0.0 ? "-" : "") + times + "pi" + (part == 1 ? "" : "/" + std::to_string(part));
  }
  return tidy(value, 1.0);
}

// A pose; nothing where the frames are one.
Json pose_keys(const Pose& pose, double scale) {
  const Json none = {0.0, 0.0, 0.0}, xyz = numbers(pose.position, scale);
  Json rpy = Json::array();
  for (const double value : rpy_of(pose.rotation)) rpy.push_back(angle(value));
  Json keys = nullptr;
  if (xyz != none) keys["xyz"] = xyz;
  if (rpy != none) keys["rpy"] = rpy;
  return keys;
}

class MechanismMaker {
 public:
  explicit MechanismMaker(Robot& robot) : robot_(robot) {}

  MechanismOfRobot make() {
    for (const Joint& joint : robot_.joints)
      if (joint.armature != 0.0)
        robot_.notes.add(joint.place,
                         "armature, the inertia of a rotor as its joint sees it, is left out");
    join_fixed_links();
    if (bodies_.size() == 1)
      fail(robot_.links[1].place, "all links are fixed to the ground; expected one that moves");
    attach_joints();
    grow_tree();
    require_masses();
    name_all();
    MechanismOfRobot result;
    result.system = {
        {"type", "mechanism"}, {"gravity", numbers(robot_.gravity)}, {"coordinates", "joint"}};
    result.system["bodies"] = bodies(result.bodies);
    result.system["joints"] = joints(result.joints);
    return result;
  }

 private:
  // Bodies of links that fixed joints connect, the ground first.
  void join_fixed_links() {
    std::vector<std::vector<std::pair<std::size_t, Pose>>> beside(robot_.links.size());
    std::vector<bool> is_child(robot_.links.size(), false);
    for (const Joint& joint : robot_.joints) {
      if (joint.type != JointType::fixed) continue;
      const Pose child = joint.origin * inverse(joint.child_origin);  // in the frame of the parent
      beside[joint.parent].emplace_back(joint.child, child);
      beside[joint.child].emplace_back(joint.parent, inverse(child));
      is_child[joint.child] = true;
    }
    body_of_.assign(robot_.links.size(), kNone);
    in_body_.assign(robot_.links.size(), {});
    const auto take = [&](std::size_t first) {
      if (body_of_[first] != kNone) return;
      Body body{.link = first};
      body_of_[first] = bodies_.size();
      std::deque<std::size_t> open = {first};
      while (!open.empty()) {
        const std::size_t at = open.front();
        open.pop_front();
        add_link(at, body);
        for (const auto& [other, pose] : beside[at])
          if (body_of_[other] == kNone) {
            body_of_[other] = bodies_.size();
            in_body_[other] = in_body_[at] * pose;
            open.push_back(other);
          }
      }
      bodies_.push_back(body);
    };
    take(0);
    for (std::size_t link = 0; link < robot_.links.size(); ++link)
      if (!is_child[link]) take(link);
    for (std::size_t link = 0; link < robot_.links.size(); ++link) take(link);
  }

  void add_link(std::size_t index, Body& body) {
    const Link& link = robot_.links[index];
    if (body.link != 0) {
      if (link.unknown) fail(link.unknown->first, link.unknown->second);
      body.inertia = body.inertia + in_body_[index] * link.inertia;
      if (index != body.link) body.points.emplace_back(link.name, in_body_[index].position);
    }
    for (const auto& [name, at] : link.points) body.points.emplace_back(name, in_body_[index] * at);
  }

  // Joints between bodies rather than links.
  void attach_joints() {
    for (std::size_t index = 0; index < robot_.joints.size(); ++index) {
      Joint joint = robot_.joints[index];
      if (joint.type == JointType::fixed) continue;
      joint.origin = in_body_[joint.parent] * joint.origin;
      joint.child_origin = in_body_[joint.child] * joint.child_origin;
      size_ = std::max({size_, joint.origin.position.cwiseAbs().maxCoeff(),
                        joint.child_origin.position.cwiseAbs().maxCoeff()});
      joint.parent = body_of_[joint.parent];
      joint.child = body_of_[joint.child];
      if (joint.parent == joint.child) {
        robot_.notes.add(joint.place,
                         "a joint between links that are fixed to each other is left out");
        continue;
      }
      joints_.push_back(joint);
      written_.push_back(index);
    }
  }

  // Bodies hang on the ground by joints in their own direction, and by one in the other direction where there is no way else.
  void grow_tree() {
    std::vector<std::vector<std::size_t>> down(bodies_.size()), up(bodies_.size());
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      down[joints_[i].parent].push_back(i);
      up[joints_[i].child].push_back(i);
    }
    std::vector<bool> is_placed(bodies_.size(), false), is_in_tree(joints_.size(), false);
    is_placed[0] = true;
    std::vector<std::size_t> placed = {0};
    const auto place = [&](std::size_t joint) {
      const std::size_t child = joints_[joint].child;
      is_placed[child] = true;
      is_in_tree[joint] = true;
      bodies_[child].joint = joint;
      bodies_[child].frame = joints_[joint].child_origin;
      ++bodies_[joints_[joint].parent].children;
      order_.push_back(joint);
      placed.push_back(child);
    };
    std::size_t looked = 0, turned = 0;
    for (;;) {
      for (; looked < placed.size(); ++looked)
        for (const std::size_t joint : down[placed[looked]])
          if (!is_placed[joints_[joint].child]) place(joint);
      std::size_t other = kNone;
      for (; turned < placed.size() && other == kNone; turned += other == kNone ? 1U : 0U)
        for (const std::size_t joint : up[placed[turned]])
          if (!is_placed[joints_[joint].parent]) {
            other = joint;
            break;
          }
      if (other == kNone) break;
      turn_round(joints_[other]);
      place(other);
    }
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (is_in_tree[i]) continue;
      order_.push_back(i);
      ++bodies_[joints_[i].parent].children;  // what a loop holds hangs on both
      ++bodies_[joints_[i].child].children;
    }
  }

  // The same joint, of the same coordinates, from the other side.
  void turn_round(Joint& joint) {
    if (joint.type == JointType::planar || joint.type == JointType::floating ||
        joint.type == JointType::universal || joint.type == JointType::ball)
      robot_.notes.add(joint.place,
                       "a joint is taken from its child to its parent, and its coordinates so");
    std::swap(joint.parent, joint.child);
    std::swap(joint.origin, joint.child_origin);
    std::ranges::reverse(joint.axes);
    for (Vector3d& axis : joint.axes) axis = -axis;
  }

  // What hangs on nothing else has to resist its joint.
  void require_masses() {
    for (const Body& body : bodies_) {
      if (body.joint == kNone || body.children > 0) continue;
      const Link& link = robot_.links[body.link];
      const Joint& joint = joints_[body.joint];
      const Inertia inertia = inverse(body.frame) * body.inertia;
      if (inertia.mass <= 0.0)
        fail(link.place, "the link " + in_quotes(link.name) +
                             " moves, and neither it nor what hangs on it has a mass; expected a "
                             "mass, or a fixed joint");
      if (joint.type != JointType::revolute) continue;
      const Vector3d axis = joint.axes.front().normalized();
      const double distance = inertia.center.squaredNorm() - std::pow(axis.dot(inertia.center), 2);
      if (axis.dot(inertia.about_center * axis) + inertia.mass * distance <= 0.0)
        fail(link.place,
             "the link " + in_quotes(link.name) +
                 " turns about an axis through its centre, and has no inertia about it; "
                 "expected one");
    }
  }

  void name_all() {
    std::set<std::string> of_bodies, of_joints;
    for (const Link& link : robot_.links) of_bodies.insert(link.name);
    for (const Joint& joint : robot_.joints) of_joints.insert(joint.name);
    DifferentNames body_names(of_bodies), joint_names(of_joints);
    const auto named = [&](const std::string& written, const std::string& kind,
                           DifferentNames& names, const Place& place) {
      const std::string name =
          names.of(is_free(identifier(written)) ? written : kind + "-" + written);
      const bool is_of_model = written.find("::") != std::string::npos;  // in SDF, of several
      if (name != written && !is_of_model)
        robot_.notes.add(place, "the " + kind + " " + in_quotes(written) + " is called " + name);
      return name;
    };
    for (std::size_t i = 1; i < bodies_.size(); ++i) {
      const Link& link = robot_.links[bodies_[i].link];
      body_names_.push_back(named(link.name, "body", body_names, link.place));
    }
    for (const Joint& joint : joints_) {
      if (joint.name.empty())  // a joint that the file gives no name
        joint_names_.push_back(
            joint_names.of(name_of_body(joint.child == 0 ? joint.parent : joint.child) + "-joint"));
      else
        joint_names_.push_back(named(joint.name, "joint", joint_names, joint.place));
    }
  }

  // Whether formulas can call a body or a joint so.
  static bool is_free(const std::string& name) {
    static const SymbolTable taken = [] {
      SymbolTable table;
      for (const char* word : {"t", "T", "V", "H", "ground"}) table.add(word, 0.0);
      return table;
    }();
    try {
      return parse_declaration(name, taken).name == name;
    } catch (const FormulaError&) {
      return false;
    }
  }

  std::string name_of_body(std::size_t body) const {
    return body == 0 ? "ground" : body_names_[body - 1];
  }

  Json bodies(std::map<std::string, Place>& places) const {
    Json all = Json::object();
    for (std::size_t i = 1; i < bodies_.size(); ++i) {
      const Body& body = bodies_[i];
      const Pose to_frame = inverse(body.frame);
      const Inertia inertia = to_frame * body.inertia;
      Json entry = {{"mass", tidy(inertia.mass, inertia.mass)}};
      if (!inertia.center.isZero(0.0)) entry["center"] = numbers(inertia.center, size_);
      if (!inertia.about_center.isZero(0.0))
        entry["inertia"] = inertia_entries(inertia.about_center);
      Json points = Json::object();
      std::set<std::string> written;
      for (const auto& [name, at] : body.points) written.insert(name);
      DifferentNames names(written);
      for (const auto& [name, at] : body.points)
        points[names.of(is_reserved_point(name) ? "point-" + name : name)] =
            numbers(to_frame * at, size_);
      if (!points.empty()) entry["points"] = points;
      const std::string name = name_of_body(i);
      places[name] = robot_.links[body.link].place;
      all[name] = entry;
    }
    return all;
  }

  // Components and the angular velocity of a body have names like points.
  static bool is_reserved_point(const std::string& name) {
    return name == "x" || name == "y" || name == "z" || name == "w" || name == "angle" ||
           name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0;
  }

  Json joints(std::map<std::string, Place>& places) const {
    Json all = Json::object();
    for (const std::size_t i : order_) {
      const Joint& joint = joints_[i];
      const Pose origin = inverse(bodies_[joint.parent].frame) * joint.origin;
      const Pose child_origin = inverse(bodies_[joint.child].frame) * joint.child_origin;
      Json entry = {{"type", type_name(joint.type)},
                    {"parent", name_of_body(joint.parent)},
                    {"child", name_of_body(joint.child)}};
      if (const Json keys = pose_keys(origin, size_); !keys.is_null()) entry["origin"] = keys;
      if (bodies_[joint.child].joint != i)
        if (const Json keys = pose_keys(child_origin, size_); !keys.is_null())
          entry["child_origin"] = keys;
      if (!joint.axes.empty()) entry["axis"] = numbers(joint.axes[0]);
      if (joint.axes.size() > 1) entry["axis2"] = numbers(joint.axes[1]);
      if (joint.damping != 0.0) entry["damping"] = joint.damping;
      if (joint.stiffness != 0.0) {
        entry["stiffness"] = joint.stiffness;
        if (joint.reference != 0.0) entry["rest"] = tidy(joint.reference, 0.0);
      }
      places[joint_names_[i]] = joint.place;
      all[joint_names_[i]] = entry;
    }
    for (const Coupling& coupling : robot_.couplings) {
      const std::string name = coupled(coupling, coupling.joint),
                        of = coupled(coupling, coupling.of);
      if (all[name].contains("mimic"))
        fail(coupling.place, "couples the joint " + in_quotes(robot_.joints[coupling.joint].name) +
                                 " a second time; expected one joint that it follows");
      Json mimic = {{"joint", of}};
      if (coupling.factor != 1.0) mimic["multiplier"] = coupling.factor;
      if (coupling.offset != 0.0) mimic["offset"] = coupling.offset;
      all[name]["mimic"] = mimic;
    }
    return all;
  }

  // The name of a joint that is coupled: of one coordinate, in the tree.
  std::string coupled(const Coupling& coupling, std::size_t joint) const {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (written_[i] != joint) continue;
      const JointType type = joints_[i].type;
      if (bodies_[joints_[i].child].joint == i &&
          (type == JointType::revolute || type == JointType::prismatic))
        return joint_names_[i];
    }
    fail(coupling.place, "couples the joint " + in_quotes(robot_.joints[joint].name) +
                             "; expected joints of one degree of freedom that close no loop");
  }

  Robot& robot_;
  double size_ = 0.0;                 // m, the largest coordinate of a joint in its links
  std::vector<std::size_t> body_of_;  // of a link
  std::vector<Pose> in_body_;         // a link, in the frame of the first one of its body
  std::vector<Body> bodies_;
  std::vector<Joint> joints_;         // between bodies
  std::vector<std::size_t> written_;  // of these, which of the robot's they are
  std::vector<std::size_t>
      order_;  // of joints: those of the tree from the ground on, then the others
  std::vector<std::string> body_names_, joint_names_;
};

}  // namespace

MechanismOfRobot mechanism_of(Robot& robot) { return MechanismMaker(robot).make(); }

}  // namespace courant::robots
