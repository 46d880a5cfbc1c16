#include "courant/reading/mechanism_keys.hpp"

#include <array>

namespace courant {

std::span<const JointWord> joint_types() {
  static constexpr std::array types{JointWord{"revolute", JointType::revolute, "torque"},
                                    JointWord{"continuous", JointType::revolute, "torque"},
                                    JointWord{"prismatic", JointType::prismatic, "force"},
                                    JointWord{"fixed", JointType::fixed, ""},
                                    JointWord{"spherical", JointType::spherical, "torque"},
                                    JointWord{"ball", JointType::spherical, "torque"},
                                    JointWord{"universal", JointType::universal, "torque"},
                                    JointWord{"cylindrical", JointType::cylindrical, "effort"},
                                    JointWord{"planar", JointType::planar, "effort"},
                                    JointWord{"floating", JointType::floating, "effort"}};
  return types;
}

std::vector<std::string> joint_words() {
  std::vector<std::string> words;
  for (const JointWord& joint : joint_types()) words.emplace_back(joint.word);
  return words;
}

const KindDescription& body_keys() {
  static const KindDescription keys{
      "",
      "a rigid body",
      {required_key("mass", takes::formula(), "in kg, at least 0"),
       optional_key("center", takes::formula_vector(),
                    "of mass, in the frame of the body; by default its origin"),
       optional_key(
           "inertia", takes::formulas(),
           "about the centre, [xx, yy, zz, xy, xz, yz] or a matrix, in a plane a number; by "
           "default 0, a point"),
       optional_key("points", takes::places(), "by name, in the frame of the body")}};
  return keys;
}

const KindDescription& mimic_keys() {
  static const KindDescription keys{"",
                                    "the coordinate of a joint by that of another one",
                                    {required_key("joint", takes::text(), "the other one"),
                                     optional_key("multiplier", takes::formula(), "by default 1"),
                                     optional_key("offset", takes::formula(), "by default 0")}};
  return keys;
}

const KindDescription& joint_keys() {
  static const KindDescription keys{
      "",
      "a joint",
      {required_key("type", takes::word(joint_words()), "how the child moves"),
       required_key("parent", takes::text(), "a body, or ground"),
       required_key("child", takes::text(), "a body, or ground"),
       optional_key("origin", takes::pose(),
                    "the frame of the joint on the parent; by default the parent's own"),
       optional_key("child_origin", takes::pose(),
                    "of a joint that closes a loop, its frame on the child"),
       optional_key("axis", takes::formula_vector(),
                    "in the frame of the joint, of any length; by default [1, 0, 0]"),
       optional_key(
           "axis2", takes::formula_vector(),
           "of a universal joint, perpendicular to the axis and moving with it; by default "
           "the next coordinate direction"),
       optional_key("damping", takes::formulas(), "a number, or one for each degree of freedom"),
       optional_key("stiffness", takes::formulas(), "likewise, of a spring in the joint"),
       optional_key("rest", takes::formulas(), "likewise, where that spring is at rest"),
       optional_key("torque", takes::formulas(),
                    "on the child: a formula in coordinates, velocities and t; of universal joints "
                    "two, of spherical ones three along the axes of the child"),
       optional_key("force", takes::formula(), "on the child of a prismatic joint, along the axis"),
       optional_key("effort", takes::formula_vector(),
                    "forces and torques of cylindrical, planar and floating joints, one for each "
                    "degree of freedom"),
       optional_key("mimic", takes::one(mimic_keys()),
                    "its coordinate is multiplier * that of another joint + offset, exactly")}};
  return keys;
}

const KindDescription& spring_keys() {
  static const KindDescription keys{
      "",
      "a spring between two points",
      {required_key("from", takes::place_on_body(), "where it begins"),
       required_key("to", takes::place_on_body(), "where it ends"),
       optional_key("stiffness", takes::formula(), "in N/m; by default 0"),
       optional_key("rest", takes::formula(), "its length without load, in m; by default 0"),
       optional_key("damping", takes::formula(), "in N s/m; by default 0")}};
  return keys;
}

const KindDescription& force_keys() {
  static const KindDescription keys{
      "",
      "a force on a body",
      {required_key("at", takes::place_on_body(), "where it acts"),
       optional_key("force", takes::formula_vector(),
                    "its components, formulas in coordinates, velocities and t; by default 0"),
       optional_key("torque", takes::formulas(), "likewise; in a plane one formula"),
       default_key("frame", takes::word({"world", "body"}), "world",
                   "whose axes the components are along")}};
  return keys;
}

std::vector<Key> mechanism_keys() {
  return {
      required_key("bodies", takes::named(body_keys()), "by name: mass, center, inertia, points"),
      optional_key("joints", takes::named(joint_keys()),
                   "by name: between a parent and a child, bodies or the ground"),
      optional_key("springs", takes::named(spring_keys()), "by name: between two points"),
      optional_key("forces", takes::list_of(force_keys()), "on points of bodies"),
      optional_key("gravity", takes::formula_vector(), "in m/s^2; by default 0"),
      default_key("coordinates", takes::word({"joint", "absolute"}), "joint",
                  "of joints, with constraints where loops close; or of bodies, with joints as "
                  "constraints"),
      default_key("plane", takes::flag(), false,
                  "all in a plane: axes are z, positions [x, y], poses [x, y, angle]")};
}

}  // namespace courant
