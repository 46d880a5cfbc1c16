// A robot as its file describes it: links, and joints between two of them.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "courant/extensions/robots/pose.hpp"
#include "courant/reading/findings.hpp"

namespace courant::robots {

// A place in the file, for messages: `origin` is that of an element of an included file.
struct Place {
  int line = 0;
  std::string origin = {};
};

// A rigid body of a robot, with a frame of its own.
struct Link {
  std::string name;
  Place place;
  Inertia inertia = {};                                       // in the frame of the link
  std::vector<std::pair<std::string, Vector3d>> points = {};  // in the frame of the link
  // Why the inertia is not known: of no effect where the link does not move.
  std::optional<std::pair<Place, std::string>> unknown = {};
};

// What a joint leaves free, as URDF, SDF and MJCF have it.
enum class JointType { fixed, revolute, prismatic, planar, universal, ball, floating };

// What connects a link to its parent.
struct Joint {
  std::string name;
  Place place;
  JointType type = JointType::fixed;
  std::size_t parent = 0, child = 0;  // links
  // The frame of the joint at rest, in that of the parent and in that of the child.
  Pose origin = {}, child_origin = {};
  // In the frame of the joint, of any length: of a planar joint the normal of the plane, of a universal one two.
  std::vector<Vector3d> axes = {};
  double damping = 0.0;
  double stiffness = 0.0, reference = 0.0;  // a spring, and where it is at rest
  double armature = 0.0;                    // inertia of the rotor, as the joint sees it
};

// The displacement of `joint` is factor × that of `of` + offset.
struct Coupling {
  Place place;
  std::size_t joint = 0, of = 0;
  double factor = 1.0, offset = 0.0;
};

// What is left out, told once each.
class Notes {
 public:
  void add(const Place& place, const std::string& what);
  std::vector<Problem> problems() const;

 private:
  struct Note {
    Place place;
    int count;
  };
  std::vector<std::string> order_;
  std::map<std::string, Note> notes_;
};

// What is read of a file, whichever of the formats it has. Lengths in m, masses in kg, angles in radians.
struct Robot {
  std::string title;
  Vector3d gravity = {0.0, 0.0, -9.81};
  double step = 1e-3;                                     // s
  std::vector<Link> links = {{.name = "", .place = {}}};  // the first one is the ground
  std::vector<Joint> joints = {};
  std::vector<Coupling> couplings = {};
  Notes notes = {};
};

// Throws LineError.
[[noreturn]] void fail(const Place& place, const std::string& what);
// Throws LineError unless the mass and the principal moments of inertia are at least 0.
void check_inertia(const Inertia& inertia, const Place& place, const std::string& of);
// Throws LineError where two links, or two joints, have one name, or there are more than 1000 links. Names may be
// empty.
void require_different_names(const Robot& robot);
// Throws LineError unless there is one of that name, which the ground has not.
std::size_t link_named(const Robot& robot, const std::string& name, const Place& place);

}  // namespace courant::robots
