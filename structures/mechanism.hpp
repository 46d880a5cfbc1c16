// Mechanism: rigid bodies, joints and springs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "courant/manifolds/manifold.hpp"
#include "courant/structures/joint.hpp"

namespace courant {

// Rigid bodies that joints connect to each other and to the ground, in SI units: what a Lagrangian, constraints and
// forces need. Frames of bodies are right-handed; the world is the frame of the ground, which has the number -1.
//
// Joint coordinates: joints whose child nothing holds yet make trees, which grow from the ground; a body that is no
// joint's child is the root of another one, free. With
//
//   q     coordinates of the joints of the trees, and of the free bodies: a point of Q, a product of Rⁿ and SO(3)
//   w     their velocities, in the representation of Q
//
// every other joint closes a loop and is constraints. In absolute coordinates all bodies are free, with the centre of
// mass as their position, and all joints are constraints.
//
// Numbers are expressions, so that masses and lengths may be parameters of a graph; every function here is then in that
// graph. A value.
class Mechanism {
 public:
  static constexpr Index ground = -1;

  struct Body {
    std::string name;
    Expr mass = 0.0;                          // kg
    ExprVector center = ExprVector::Zero(3);  // m, in the body's frame
    ExprMatrix inertia =
        ExprMatrix::Zero(3, 3);  // kg m², about the centre, along the axes of the body's frame
  };
  struct Joint {
    std::string name;
    JointType type = JointType::fixed;
    Index parent = ground, child = ground;
    Pose origin = {}, child_origin = {};  // P in the frame of the parent, C in that of the child
    ExprMatrix axes = ExprMatrix::Identity(3, 3);
    // Of each degree of freedom, or empty: -damping w; potential stiffness (x - rest)²/2.
    ExprVector damping = {}, stiffness = {}, rest = {};
  };
  struct Point {
    Index body = ground;
    ExprVector at = ExprVector::Zero(3);  // in the frame of the body
  };
  // Potential stiffness (l - rest)²/2 of the distance l of two points, and a force -damping l' along it.
  struct Spring {
    Point from, to;
    Expr stiffness = 0.0, rest = 0.0, damping = 0.0;
  };
  struct Parts {
    std::vector<Body> bodies;
    std::vector<Joint> joints = {};
    std::vector<Spring> springs = {};
    ExprVector gravity = ExprVector::Zero(3);  // m/s²
    bool is_plane = false;                     // all in z = 0, with axes along z
    bool is_absolute = false;
  };

  // What moves a body relative to another one: a joint of a tree, or nothing (a free body, on the ground).
  struct Branch {
    Index joint = -1;  // -1: free
    Index body = 0;
    Index position = 0, velocity = 0;  // the first of its entries in q and w
  };

  // Throws std::invalid_argument where a part does not fit: sizes, numbers of bodies, a joint of a body with itself.
  explicit Mechanism(Parts parts);

  const Parts& parts() const { return parts_; }
  // Parents before their children.
  const std::vector<Branch>& branches() const { return branches_; }
  const std::vector<Index>& loops() const { return loops_; }  // joints that are constraints
  JointType type_of(const Branch& branch) const;
  const std::shared_ptr<const Manifold>& manifold() const { return manifold_; }  // Q
  VectorXd rest()
      const;  // the q where nothing has moved, and free bodies are where they were written

  // Where everything is at q: frames, and the velocities of bodies as linear maps of w.
  struct Motion {
    std::vector<Pose> body;
    std::vector<ExprMatrix> angular,
        linear;  // 3 × Ñ: ω, and the velocity of the frame's origin, in the world
  };
  Motion motion(const ExprVector& q) const;

  // 3 × Ñ, the velocity of a point of a body that is at `at` in the world.
  ExprMatrix velocity_of(const Motion& motion, Index body, const ExprVector& at) const;
  ExprVector place_of(const Motion& motion, const Point& point) const;  // in the world
  ExprVector center_of(const Motion& motion, Index body) const;
  JointPlace place_of(const Motion& motion, Index joint) const;
  // (relative velocity at the origin of C, ω_C - ω_P) as a linear map of w, 6 × Ñ.
  ExprMatrix relative_velocity(const Motion& motion, Index joint) const;

  // ½ Σ m ‖v‖² + ⟨ω, J ω⟩.
  Expr kinetic_energy(const Motion& motion, const ExprVector& w) const;
  // Of gravity and springs, those of joints included.
  Expr potential(const Motion& motion, const ExprVector& q) const;

  // The constraints of joints_[loop].
  std::vector<JointCondition> conditions(const Motion& motion, Index loop) const;

  // A force at a point and a torque (world) on a body.
  struct Load {
    Index body = ground;
    ExprVector at, force, torque;
  };
  // The covector of Q (Ñ) that does the work of these.
  ExprVector generalised(const Motion& motion, const std::vector<Load>& loads) const;
  // What dissipates in joints and springs.
  std::vector<Load> dampers(const Motion& motion, const ExprVector& w) const;
  // Of springs between points, with their dampers.
  std::vector<Load> spring_loads(const Motion& motion, const ExprVector& w) const;
  // -stiffness (x - rest) - damping w of a joint (n), or empty if it has neither.
  ExprVector passive_effort(const Motion& motion, const ExprVector& q, const ExprVector& w,
                            Index joint) const;
  // A joint's force of these generalised components (n) on the child, and its opposite on the parent.
  std::vector<Load> joint_loads(const Motion& motion, Index joint, const ExprVector& effort) const;
  // The same of a wrench.
  std::vector<Load> joint_loads(const Motion& motion, Index joint, const Wrench& wrench) const;

  // Coordinates (n) of any joint, by the poses; those of q where they are numbers of it.
  ExprVector displacement(const Motion& motion, const ExprVector& q, Index joint) const;
  // Their velocities for joints that have angles, else the relative angular (and linear) velocity.
  ExprVector rate(const Motion& motion, const ExprVector& w, Index joint) const;

 private:
  void grow_trees();
  void lay_out();
  const Branch* branch_of(Index joint) const;

  Parts parts_;
  std::vector<Branch> branches_;
  std::vector<Index> loops_;
  std::shared_ptr<const Manifold> manifold_;
};

}  // namespace courant
