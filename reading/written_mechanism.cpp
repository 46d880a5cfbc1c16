#include "courant/reading/written_mechanism.hpp"

#include "courant/core/numbers/as_size.hpp"

namespace courant {
namespace {

using Formulas = std::vector<WrittenFormula>;

ExprVector expressions(const Formulas& formulas, const SymbolTable& constants) {
  return evaluate({{}, formulas}, constants);
}

Pose pose_of(const WrittenMechanism::Pose& written, const SymbolTable& constants) {
  Pose result;
  result.r = expressions(written.xyz, constants);
  const ExprVector entries = expressions(written.rotation, constants);
  for (Index i = 0; i < 3; ++i) result.R.row(i) = entries.segment(3 * i, 3).transpose();
  return result;
}

}  // namespace

Mechanism::Point WrittenMechanism::point(const Place& place, const SymbolTable& constants) const {
  const Formulas& at = place.at.empty() ? bodies[as_size(place.body)].center : place.at;
  return {place.body, expressions(at, constants)};
}

Mechanism WrittenMechanism::at(const SymbolTable& constants) const {
  Mechanism::Parts parts;
  parts.is_plane = is_plane;
  parts.is_absolute = is_absolute;
  parts.gravity = expressions(gravity, constants);
  for (const Body& body : bodies) {
    const ExprVector J = expressions(body.inertia, constants);
    ExprMatrix inertia(3, 3);
    inertia << J[0], J[3], J[4], J[3], J[1], J[5], J[4], J[5], J[2];
    parts.bodies.push_back(
        {body.name, evaluate(body.mass, constants), expressions(body.center, constants), inertia});
  }
  for (const Joint& joint : joints) {
    const ExprVector axis = expressions(joint.axis, constants);
    ExprMatrix axes = is_plane && joint.type == JointType::prismatic
                          ? joint_axes_in_plane(axis)
                          : joint_axes(axis, joint.largest);
    if (!joint.axis2.empty()) {
      const ExprVector u = expressions(joint.axis2, constants);
      axes.col(1) = u / sqrt(u.dot(u));
      axes.col(2) = cross_product(axes.col(0), axes.col(1));
    }
    parts.joints.push_back({.name = joint.name,
                            .type = joint.type,
                            .parent = joint.parent,
                            .child = joint.child,
                            .origin = pose_of(joint.origin, constants),
                            .child_origin = pose_of(joint.child_origin, constants),
                            .axes = axes,
                            .damping = expressions(joint.damping, constants),
                            .stiffness = expressions(joint.stiffness, constants),
                            .rest = expressions(joint.rest, constants)});
  }
  for (const Spring& spring : springs)
    parts.springs.push_back({point(spring.from, constants), point(spring.to, constants),
                             evaluate(spring.stiffness, constants),
                             evaluate(spring.rest, constants),
                             evaluate(spring.damping, constants)});
  return Mechanism(std::move(parts));
}

}  // namespace courant
