// Joint: how a frame of one rigid body moves in a frame of another.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "courant/structures/pose.hpp"

namespace courant {

// A frame C moves in a frame P. With the axes (a, u, v) of the joint, orthonormal and right-handed, in P where nothing
// has moved, Rot(a, φ) the rotation about a by φ, and n degrees of freedom:
//
//   fixed        n = 0   C = P
//   revolute     n = 1   Rot(a, x)
//   prismatic    n = 1   displacement x a
//   cylindrical  n = 2   Rot(a, x₀), then displacement x₁ a
//   universal    n = 2   Rot(a, x₀) Rot(u, x₁)
//   planar       n = 3   displacement x₀ u + x₁ v, then Rot(a, x₂)
//   spherical    n = 3   any rotation about the origin of P
//   floating     n = 6   any displacement and rotation
//
// With coordinates the rotations of the last two are points of SO(3), with their angular velocity in C as velocity. As
// a constraint a joint is 6 - n equations. A value.
enum class JointType {
  fixed,
  revolute,
  prismatic,
  cylindrical,
  universal,
  planar,
  spherical,
  floating
};

// n.
Index degrees_of_freedom(JointType type);
// Whether the velocities are rates of numbers (all but spherical and floating).
bool has_angles(JointType type);

// (a, u, v) as columns from a vector that is not 0, in units of its length: u is the coordinate direction after the
// k-th, made perpendicular to a, so that the axis of z has u = x and v = y. k is where a is largest. 3 × 3.
ExprMatrix joint_axes(const ExprVector& axis, Index k);
// The same for an axis in the plane z = 0: v is that of z.
ExprMatrix joint_axes_in_plane(const ExprVector& axis);

// What a joint does at a point of the configuration: frames P and C in the world, axes 3 × 3 in these frames.
struct JointPlace {
  JointType type;
  ExprMatrix axes;
  Pose P, C;
};

// A force f at the origin of C and a torque m (3 each, in the world): what the parent gives the child, which gives the
// opposite back at the same place.
struct Wrench {
  ExprVector force = ExprVector::Zero(3), torque = ExprVector::Zero(3);
};
Wrench operator+(const Wrench& a, const Wrench& b);
Wrench operator*(const Expr& factor, const Wrench& wrench);

// The pose of C in P at coordinates x: n numbers; of spherical joints R (9, row after row), of floating ones r (3),
// then R.
Pose joint_motion(JointType type, const ExprMatrix& axes, const ExprVector& x);

// The n directions of relative motion: for velocities w of the degrees of freedom
//   velocity of C at its origin - velocity of P there = Σ w_k f_k,   ω_C - ω_P = Σ w_k m_k
// and a generalised force τ acts on the child by Σ τ_k (f_k, m_k): directions are orthonormal.
std::vector<Wrench> joint_directions(const JointPlace& place);

// The coordinates of the degrees of freedom, from the poses alone: angles in (-π, π], displacements; of spherical
// joints the rotation vector (the axis times the angle, at most π), of floating ones the displacement in P, then that.
// n numbers.
ExprVector joint_displacement(const JointPlace& place);

// A constraint φ = 0 of a joint, and (f, m) with dφ/dt = ⟨f, relative velocity at the origin of C⟩ + ⟨m, ω_C - ω_P⟩
// where all of them hold.
struct JointCondition {
  std::string name;  // "x" of the position, "turn about y", in the words of the joint
  Expr value;
  Wrench gradient;
};

// The name of an equation that is a constraint of a joint, and the joint back from it; nothing for other equations.
std::string equation_of(const std::string& joint, const JointCondition& condition);
std::optional<std::string> joint_of_equation(const std::string& equation);

// The 6 - n constraints; those in the plane z = 0 if `plane`, 3 - n then.
std::vector<JointCondition> joint_conditions(const JointPlace& place, bool plane);

}  // namespace courant
