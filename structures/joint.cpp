#include "courant/structures/joint.hpp"

#include <string_view>

#include "courant/manifolds/rotation.hpp"

namespace courant {
namespace {

// How names of equations of joints begin; formulas do not.
constexpr std::string_view kJoint = "joint ";

ExprMatrix columns(const ExprVector& a, const ExprVector& u, const ExprVector& v) {
  ExprMatrix axes(3, 3);
  axes << a, u, v;
  return axes;
}

ExprMatrix rotation_about(const ExprVector& a, const ExprVector& u, const ExprVector& v,
                          const Expr& angle) {
  return a * a.transpose() + cos(angle) * (u * u.transpose() + v * v.transpose()) +
         sin(angle) * (v * u.transpose() - u * v.transpose());
}

ExprMatrix from_rows(const ExprVector& entries) {
  ExprMatrix R(3, 3);
  for (Index i = 0; i < 3; ++i) R.row(i) = entries.segment(3 * i, 3).transpose();
  return R;
}

// The displacement of C in the world, and one axis of each frame there.
struct WorldAxes {
  explicit WorldAxes(const JointPlace& place)
      : d(place.C.r - place.P.r), of_P(place.P.R * place.axes), of_C(place.C.R * place.axes) {}
  ExprVector d;
  ExprMatrix of_P, of_C;
  // Of P: a, u, v; of C likewise.
  ExprVector a() const { return of_P.col(0); }
  ExprVector u() const { return of_P.col(1); }
  ExprVector v() const { return of_P.col(2); }
  ExprVector b() const { return of_C.col(0); }
  ExprVector s() const { return of_C.col(1); }
};

JointCondition at_one_place(Index k) {
  return {
      std::string("position ") + "xyz" [k], 0.0, { ExprVector::Unit(3, k), ExprVector::Zero(3) }};
}

// ⟨p, c⟩ - value, of directions that P and C carry.
JointCondition between(std::string name, const ExprVector& p, const ExprVector& c,
                       const Expr& value = 0.0) {
  return {std::move(name), p.dot(c) - value, {ExprVector::Zero(3), cross_product(c, p)}};
}

}  // namespace

ExprVector cross_product(const ExprVector& a, const ExprVector& b) {
  return ExprVector{
      {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

Wrench operator+(const Wrench& a, const Wrench& b) {
  return {a.force + b.force, a.torque + b.torque};
}
Wrench operator*(const Expr& factor, const Wrench& wrench) {
  return {factor * wrench.force, factor * wrench.torque};
}

Index degrees_of_freedom(JointType type) {
  switch (type) {
    case JointType::fixed:
      return 0;
    case JointType::revolute:
    case JointType::prismatic:
      return 1;
    case JointType::cylindrical:
    case JointType::universal:
      return 2;
    case JointType::planar:
    case JointType::spherical:
      return 3;
    case JointType::floating:
      break;
  }
  return 6;
}

bool has_angles(JointType type) {
  return type != JointType::spherical && type != JointType::floating;
}

ExprMatrix joint_axes(const ExprVector& axis, Index k) {
  const ExprVector a = axis / sqrt(axis.dot(axis));
  const Index next = (k + 1) % 3;
  ExprVector u = ExprVector::Unit(3, next) - a[next] * a;
  u /= sqrt(1.0 - square(a[next]));
  return columns(a, u, cross_product(a, u));
}

ExprMatrix joint_axes_in_plane(const ExprVector& axis) {
  const ExprVector a = axis / sqrt(axis.dot(axis)), z = ExprVector::Unit(3, 2);
  return columns(a, cross_product(z, a), z);
}

Pose joint_motion(JointType type, const ExprMatrix& axes, const ExprVector& x) {
  const ExprVector a = axes.col(0), u = axes.col(1), v = axes.col(2);
  Pose pose;
  switch (type) {
    case JointType::fixed:
      break;
    case JointType::revolute:
      pose.R = rotation_about(a, u, v, x[0]);
      break;
    case JointType::prismatic:
      pose.r = x[0] * a;
      break;
    case JointType::cylindrical:
      pose.R = rotation_about(a, u, v, x[0]);
      pose.r = x[1] * a;
      break;
    case JointType::universal:
      pose.R = rotation_about(a, u, v, x[0]) * rotation_about(u, v, a, x[1]);
      break;
    case JointType::planar:
      pose.R = rotation_about(a, u, v, x[2]);
      pose.r = x[0] * u + x[1] * v;
      break;
    case JointType::spherical:
      pose.R = from_rows(x);
      break;
    case JointType::floating:
      pose.r = x.head(3);
      pose.R = from_rows(x.tail(9));
      break;
  }
  return pose;
}

std::vector<Wrench> joint_directions(const JointPlace& place) {
  const WorldAxes axes(place);
  const ExprVector zero = ExprVector::Zero(3);
  const auto moves = [&](const ExprVector& f) { return Wrench{f, zero}; };
  const auto turns = [&](const ExprVector& m) { return Wrench{zero, m}; };
  std::vector<Wrench> directions;
  switch (place.type) {
    case JointType::fixed:
      break;
    case JointType::revolute:
      return {turns(axes.a())};
    case JointType::prismatic:
      return {moves(axes.a())};
    case JointType::cylindrical:
      return {turns(axes.a()), moves(axes.a())};
    case JointType::universal:
      return {turns(axes.a()), turns(axes.s())};
    case JointType::planar:
      return {moves(axes.u()), moves(axes.v()), turns(axes.a())};
    case JointType::floating:
      for (Index i = 0; i < 3; ++i) directions.push_back(moves(place.P.R.col(i)));
      [[fallthrough]];
    case JointType::spherical:
      for (Index i = 0; i < 3; ++i) directions.push_back(turns(place.C.R.col(i)));
      break;
  }
  return directions;
}

ExprVector joint_displacement(const JointPlace& place) {
  const WorldAxes axes(place);
  const auto along = [&](const ExprVector& direction) { return direction.dot(axes.d); };
  const auto angle = [&] { return atan2(axes.s().dot(axes.v()), axes.s().dot(axes.u())); };
  switch (place.type) {
    case JointType::fixed:
      break;
    case JointType::revolute:
      return ExprVector{{angle()}};
    case JointType::prismatic:
      return ExprVector{{along(axes.a())}};
    case JointType::cylindrical:
      return ExprVector{{angle(), along(axes.a())}};
    case JointType::universal:
      return ExprVector{{angle(), atan2(axes.a().dot(axes.of_C.col(2)), axes.a().dot(axes.b()))}};
    case JointType::planar:
      return ExprVector{{along(axes.u()), along(axes.v()), angle()}};
    case JointType::spherical:
      return rotation_logarithm(place.P.R.transpose() * place.C.R);
    case JointType::floating: {
      ExprVector all(6);
      all << place.P.R.transpose() * axes.d, rotation_logarithm(place.P.R.transpose() * place.C.R);
      return all;
    }
  }
  return ExprVector(0);
}

std::string equation_of(const std::string& joint, const JointCondition& condition) {
  return std::string(kJoint) + joint + ": " + condition.name;
}

std::optional<std::string> joint_of_equation(const std::string& equation) {
  const std::size_t end = equation.find(": ");
  if (!equation.starts_with(kJoint) || end == std::string::npos) return std::nullopt;
  return equation.substr(kJoint.size(), end - kJoint.size());
}

std::vector<JointCondition> joint_conditions(const JointPlace& place, bool plane) {
  const WorldAxes axes(place);
  const ExprVector a = axes.a(), u = axes.u(), v = axes.v(), b = axes.b(), s = axes.s();
  std::vector<JointCondition> conditions;
  const auto together = [&] {
    for (Index k = 0; k < (plane ? 2 : 3); ++k) {
      conditions.push_back(at_one_place(k));
      conditions.back().value = axes.d[k];
    }
  };
  const auto on_line = [&](const char* name, const ExprVector& across) {
    conditions.push_back({name, across.dot(axes.d), {across, ExprVector::Zero(3)}});
  };
  const auto parallel = [&] {
    if (plane) return;
    conditions.push_back(between("axis along u", u, b));
    conditions.push_back(between("axis along v", v, b));
  };
  // No turn about the axis, which is the normal of a plane.
  const auto unturned = [&] { conditions.push_back(between("turn", v, s)); };
  switch (place.type) {
    case JointType::floating:
      break;
    case JointType::spherical:
      together();
      break;
    case JointType::revolute:
      together();
      parallel();
      break;
    case JointType::universal:
      together();
      conditions.push_back(between("axes", a, s));
      break;
    case JointType::cylindrical:
      on_line("position along u", u);
      on_line("position along v", v);
      parallel();
      break;
    case JointType::planar:
      if (plane) break;
      on_line("position along the normal", a);
      parallel();
      break;
    case JointType::prismatic:
      if (plane) {  // v is the normal: a, u lie in the plane
        on_line("position across", u);
        conditions.push_back(between("turn", u, b));
        break;
      }
      on_line("position along u", u);
      on_line("position along v", v);
      parallel();
      unturned();
      break;
    case JointType::fixed:
      together();
      if (plane) {
        conditions.push_back(between("turn", v, s));
        break;
      }
      parallel();
      unturned();
      break;
  }
  return conditions;
}

}  // namespace courant
