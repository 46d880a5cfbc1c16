// A mechanism as an experiment writes it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "courant/reading/written_formula.hpp"
#include "courant/structures/mechanism.hpp"

namespace courant {

// A mechanism whose numbers are formulas of the parameters, so that they can be made expressions of any graph, with the
// formulas of its loads.
struct WrittenMechanism {
  // xyz (3), and a rotation as nine formulas by rows.
  struct Pose {
    std::vector<WrittenFormula> xyz, rotation;
  };
  using Point = std::pair<std::string, std::vector<WrittenFormula>>;  // name, position (3)
  struct Body {
    std::string name, pointer;
    WrittenFormula mass;
    std::vector<WrittenFormula> center, inertia;  // 3; xx yy zz xy xz yz
    std::vector<Point> points = {};
  };
  // The coordinate of a joint is multiplier * that of another one + offset.
  struct Mimic {
    Index of = 0;  // joint
    WrittenFormula multiplier, offset;
  };
  struct Joint {
    std::string name, pointer;
    JointType type = JointType::fixed;
    Index parent = Mechanism::ground, child = Mechanism::ground;
    Pose origin, child_origin;
    bool has_child_origin = false;
    std::vector<WrittenFormula> axis;                      // 3
    std::vector<WrittenFormula> axis2;                     // 3, of universal joints
    Index largest = 2;                                     // component of the axis
    std::vector<WrittenFormula> damping, stiffness, rest;  // n or none
    std::vector<WrittenFormula> effort;  // n or none: of coordinates, velocities, t
    std::optional<Mimic> mimic = {};
  };
  struct Place {
    Index body = Mechanism::ground;
    std::vector<WrittenFormula> at;  // 3; empty: the centre of the body
  };
  struct Spring {
    std::string name;
    Place from, to;
    WrittenFormula stiffness, rest, damping;
  };
  struct Force {
    Place at;
    bool in_body = false;                       // along the axes of the body, not of the world
    std::vector<WrittenFormula> force, torque;  // 3 each: of coordinates, velocities, t
  };

  bool is_plane = false, is_absolute = false;
  std::vector<WrittenFormula> gravity;  // 3
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<Spring> springs;
  std::vector<Force> forces;

  // With the numbers that the parameters have in this table.
  Mechanism at(const SymbolTable& constants) const;
  Mechanism::Point point(const Place& place, const SymbolTable& constants) const;
};

}  // namespace courant
