#include "courant/structures/mechanism.hpp"

#include <algorithm>
#include <stdexcept>

#include "courant/core/numbers/as_size.hpp"
#include "courant/manifolds/euclidean.hpp"
#include "courant/manifolds/product.hpp"
#include "courant/manifolds/special_orthogonal3.hpp"

namespace courant {
namespace {

Index angle_count(JointType type) { return has_angles(type) ? degrees_of_freedom(type) : 0; }

// Entries of q that a joint has.
Index point_size(JointType type) {
  return type == JointType::spherical ? 9 : type == JointType::floating ? 12 : angle_count(type);
}

}  // namespace

Mechanism::Mechanism(Parts parts) : parts_(std::move(parts)) {
  const auto refuse = [](const std::string& reason) {
    throw std::invalid_argument("Mechanism: " + reason);
  };
  const Index count = std::ssize(parts_.bodies);
  const auto is_body = [&](Index body) { return body >= ground && body < count; };
  for (const Joint& joint : parts_.joints) {
    if (!is_body(joint.parent) || !is_body(joint.child))
      refuse("joint " + joint.name + " connects a body that is not there; expected -1 … " +
             std::to_string(count - 1) + ".");
    if (joint.parent == joint.child)
      refuse("joint " + joint.name + " connects a body with itself; expected two bodies.");
    const Index n = degrees_of_freedom(joint.type);
    for (const ExprVector* numbers : {&joint.damping, &joint.stiffness, &joint.rest})
      if (numbers->size() != 0 && numbers->size() != n)
        refuse("joint " + joint.name + " has " + std::to_string(numbers->size()) +
               " coefficients; expected " + std::to_string(n) +
               ", one for each degree of freedom.");
  }
  grow_trees();
  lay_out();
}

// Passes over the joints in their order until nothing is reached any more; then the next body that is nobody's child,
// or, where joints go round, the next one at all, is free.
void Mechanism::grow_trees() {
  const std::size_t count = parts_.bodies.size();
  std::vector<bool> reached(count, false), done(parts_.joints.size(), false);
  const auto is_reached = [&](Index body) { return body == ground || reached[as_size(body)]; };
  const auto grow = [&] {
    for (bool any = true; any;) {
      any = false;
      for (std::size_t j = 0; j < done.size(); ++j) {
        const Joint& joint = parts_.joints[j];
        if (done[j] || !is_reached(joint.parent) || is_reached(joint.child)) continue;
        branches_.push_back({.joint = static_cast<Index>(j), .body = joint.child});
        reached[as_size(joint.child)] = done[j] = any = true;
      }
    }
  };
  const auto free = [&](std::size_t body) {
    branches_.push_back({.joint = -1, .body = static_cast<Index>(body)});
    reached[body] = true;
  };
  if (!parts_.is_absolute) grow();
  for (const bool any : {parts_.is_absolute, true})
    for (std::size_t body = 0; body < count; ++body) {
      const bool is_child = std::ranges::any_of(parts_.joints, [&](const Joint& joint) {
        return joint.child == static_cast<Index>(body);
      });
      if (reached[body] || (is_child && !any)) continue;
      free(body);
      if (!parts_.is_absolute) grow();
    }
  for (std::size_t j = 0; j < done.size(); ++j)
    if (!done[j]) loops_.push_back(static_cast<Index>(j));
}

void Mechanism::lay_out() {
  std::vector<std::shared_ptr<const Manifold>> factors;
  Index position = 0, velocity = 0, flat = 0;
  const auto end_of_flat = [&] {
    if (flat > 0) factors.push_back(std::make_shared<Euclidean>(flat));
    flat = 0;
  };
  for (Branch& branch : branches_) {
    const JointType type = type_of(branch);
    branch.position = position;
    branch.velocity = velocity;
    flat += type == JointType::floating ? 3 : angle_count(type);
    if (!has_angles(type)) {
      end_of_flat();
      factors.push_back(std::make_shared<SpecialOrthogonal3>());
    }
    position += point_size(type);
    velocity += degrees_of_freedom(type);
  }
  if (factors.empty() || flat > 0) factors.push_back(std::make_shared<Euclidean>(flat));
  manifold_ = factors.size() == 1 ? factors.front() : std::make_shared<Product>(factors);
}

JointType Mechanism::type_of(const Branch& branch) const {
  if (branch.joint >= 0) return parts_.joints[as_size(branch.joint)].type;
  return parts_.is_plane ? JointType::planar : JointType::floating;
}

VectorXd Mechanism::rest() const {
  VectorXd q = VectorXd::Zero(manifold_->ambient_dimension());
  for (const Branch& branch : branches_)
    if (!has_angles(type_of(branch)))
      for (const Index i : {0, 4, 8})
        q[branch.position + (type_of(branch) == JointType::floating ? 3 : 0) + i] = 1.0;
  return q;
}

Mechanism::Motion Mechanism::motion(const ExprVector& q) const {
  const std::size_t count = parts_.bodies.size();
  const Index size = manifold_->tangent_dimension();
  Motion motion{std::vector<Pose>(count), std::vector<ExprMatrix>(count, ExprMatrix::Zero(3, size)),
                std::vector<ExprMatrix>(count, ExprMatrix::Zero(3, size))};
  for (const Branch& branch : branches_) {
    const auto body = as_size(branch.body);
    const JointType type = type_of(branch);
    // A free body is as on a joint with the ground, whose frames are those of the world and of the body; the plane has
    // the axis of z.
    Joint free{.name = {}, .type = type, .child = branch.body};
    free.axes = joint_axes(ExprVector::Unit(3, 2), 2);
    const Joint& joint = branch.joint >= 0 ? parts_.joints[as_size(branch.joint)] : free;
    const Pose parent = joint.parent == ground ? Pose() : motion.body[as_size(joint.parent)];
    const Pose P = parent * joint.origin;
    Pose C = P * joint_motion(type, joint.axes, q.segment(branch.position, point_size(type)));
    JointPlace place{type, joint.axes, P, C};
    ExprMatrix& angular = motion.angular[body];
    ExprMatrix& linear = motion.linear[body];
    if (joint.parent != ground) {
      angular = motion.angular[as_size(joint.parent)];
      linear = velocity_of(motion, joint.parent, C.r);
    }
    Index k = branch.velocity;
    for (const Wrench& direction : joint_directions(place)) {
      linear.col(k) += direction.force;
      angular.col(k++) += direction.torque;
    }
    if (branch.joint < 0 && parts_.is_absolute) {
      // The position is that of the centre.
      const ExprVector arm = -(C.R * parts_.bodies[body].center);
      for (Index i = 0; i < size; ++i) linear.col(i) += cross_product(angular.col(i), arm);
      C.r += arm;
    }
    motion.body[body] = C;
  }
  return motion;
}

ExprMatrix Mechanism::velocity_of(const Motion& motion, Index body, const ExprVector& at) const {
  const Index size = manifold_->tangent_dimension();
  if (body == ground) return ExprMatrix::Zero(3, size);
  ExprMatrix velocity = motion.linear[as_size(body)];
  const ExprMatrix& angular = motion.angular[as_size(body)];
  const ExprVector arm = at - motion.body[as_size(body)].r;
  for (Index i = 0; i < size; ++i) velocity.col(i) += cross_product(angular.col(i), arm);
  return velocity;
}

ExprVector Mechanism::place_of(const Motion& motion, const Point& point) const {
  return point.body == ground ? point.at : motion.body[as_size(point.body)] * point.at;
}

ExprVector Mechanism::center_of(const Motion& motion, Index body) const {
  return motion.body[as_size(body)] * parts_.bodies[as_size(body)].center;
}

JointPlace Mechanism::place_of(const Motion& motion, Index joint) const {
  const Joint& one = parts_.joints[as_size(joint)];
  const auto frame = [&](Index body, const Pose& pose) {
    return body == ground ? pose : motion.body[as_size(body)] * pose;
  };
  return {one.type, one.axes, frame(one.parent, one.origin), frame(one.child, one.child_origin)};
}

ExprMatrix Mechanism::relative_velocity(const Motion& motion, Index joint) const {
  const Joint& one = parts_.joints[as_size(joint)];
  const ExprVector at = place_of(motion, joint).C.r;
  const Index size = manifold_->tangent_dimension();
  ExprMatrix relative = ExprMatrix::Zero(6, size);
  const auto add = [&](Index body, const Expr& factor) {
    if (body == ground) return;
    relative.topRows(3) += factor * velocity_of(motion, body, at);
    relative.bottomRows(3) += factor * motion.angular[as_size(body)];
  };
  add(one.child, 1.0);
  add(one.parent, -1.0);
  return relative;
}

Expr Mechanism::kinetic_energy(const Motion& motion, const ExprVector& w) const {
  Expr sum = 0.0;
  for (std::size_t b = 0; b < parts_.bodies.size(); ++b) {
    const Body& body = parts_.bodies[b];
    const auto index = static_cast<Index>(b);
    const ExprVector v = velocity_of(motion, index, center_of(motion, index)) * w;
    // The angular velocity in the body.
    const ExprVector omega = motion.body[b].R.transpose() * (motion.angular[b] * w);
    sum += 0.5 * (body.mass * v.dot(v) + omega.dot(body.inertia * omega));
  }
  return sum;
}

Expr Mechanism::potential(const Motion& motion, const ExprVector& q) const {
  Expr sum = 0.0;
  for (std::size_t b = 0; b < parts_.bodies.size(); ++b)
    sum -= parts_.bodies[b].mass * parts_.gravity.dot(center_of(motion, static_cast<Index>(b)));
  for (const Spring& spring : parts_.springs) {
    const ExprVector d = place_of(motion, spring.to) - place_of(motion, spring.from);
    // Without a length at rest there is no root, which has no derivative where the points meet.
    const Expr square_of_strain =
        spring.rest.is_constant(0.0) ? d.dot(d) : square(sqrt(d.dot(d)) - spring.rest);
    sum += 0.5 * spring.stiffness * square_of_strain;
  }
  for (std::size_t j = 0; j < parts_.joints.size(); ++j) {
    const Joint& joint = parts_.joints[j];
    if (joint.stiffness.size() == 0) continue;
    const ExprVector x = displacement(motion, q, static_cast<Index>(j));
    for (Index k = 0; k < x.size(); ++k)
      sum += 0.5 * joint.stiffness[k] *
             square(x[k] - (joint.rest.size() > 0 ? joint.rest[k] : Expr(0.0)));
  }
  return sum;
}

std::vector<JointCondition> Mechanism::conditions(const Motion& motion, Index loop) const {
  return joint_conditions(place_of(motion, loop), parts_.is_plane);
}

ExprVector Mechanism::generalised(const Motion& motion, const std::vector<Load>& loads) const {
  ExprVector sum = ExprVector::Zero(manifold_->tangent_dimension());
  for (const Load& load : loads) {
    if (load.body == ground) continue;
    sum += velocity_of(motion, load.body, load.at).transpose() * load.force;
    sum += motion.angular[as_size(load.body)].transpose() * load.torque;
  }
  return sum;
}

std::vector<Mechanism::Load> Mechanism::joint_loads(const Motion& motion, Index joint,
                                                    const Wrench& wrench) const {
  const Joint& one = parts_.joints[as_size(joint)];
  const ExprVector at = place_of(motion, joint).C.r;
  return {{one.child, at, wrench.force, wrench.torque},
          {one.parent, at, -wrench.force, -wrench.torque}};
}

std::vector<Mechanism::Load> Mechanism::joint_loads(const Motion& motion, Index joint,
                                                    const ExprVector& effort) const {
  Wrench sum;
  Index k = 0;
  for (const Wrench& direction : joint_directions(place_of(motion, joint)))
    sum = sum + effort[k++] * direction;
  return joint_loads(motion, joint, sum);
}

namespace {

// Equal and opposite forces along the line from one point to the other, which draw these together for a positive tension.
void pull(const Mechanism::Spring& spring, const ExprVector& from, const ExprVector& to,
          const ExprVector& force, std::vector<Mechanism::Load>& loads) {
  loads.push_back({spring.from.body, from, force, ExprVector::Zero(3)});
  loads.push_back({spring.to.body, to, -force, ExprVector::Zero(3)});
}

// What a spring's damper pulls by, times the direction from one end to the other.
ExprVector damper_force(const Mechanism& mechanism, const Mechanism::Motion& motion,
                        const ExprVector& w, const Mechanism::Spring& spring,
                        const ExprVector& from, const ExprVector& to) {
  const ExprVector d = to - from;
  const ExprVector apart = (mechanism.velocity_of(motion, spring.to.body, to) -
                            mechanism.velocity_of(motion, spring.from.body, from)) *
                           w;
  return spring.damping * d.dot(apart) / d.dot(d) * d;
}

}  // namespace

std::vector<Mechanism::Load> Mechanism::dampers(const Motion& motion, const ExprVector& w) const {
  std::vector<Load> loads;
  for (std::size_t j = 0; j < parts_.joints.size(); ++j) {
    const Joint& joint = parts_.joints[j];
    if (joint.damping.size() == 0) continue;
    const auto index = static_cast<Index>(j);
    const ExprVector effort = -joint.damping.cwiseProduct(rate(motion, w, index));
    for (Load& load : joint_loads(motion, index, effort)) loads.push_back(std::move(load));
  }
  for (const Spring& spring : parts_.springs) {
    if (spring.damping.is_constant(0.0)) continue;
    const ExprVector from = place_of(motion, spring.from), to = place_of(motion, spring.to);
    pull(spring, from, to, damper_force(*this, motion, w, spring, from, to), loads);
  }
  return loads;
}

std::vector<Mechanism::Load> Mechanism::spring_loads(const Motion& motion,
                                                     const ExprVector& w) const {
  std::vector<Load> loads;
  for (const Spring& spring : parts_.springs) {
    const ExprVector from = place_of(motion, spring.from), to = place_of(motion, spring.to);
    const ExprVector d = to - from;
    const Expr strain =
        spring.rest.is_constant(0.0) ? Expr(1.0) : 1.0 - spring.rest / sqrt(d.dot(d));
    ExprVector force = spring.stiffness * strain * d;
    if (!spring.damping.is_constant(0.0)) force += damper_force(*this, motion, w, spring, from, to);
    pull(spring, from, to, force, loads);
  }
  return loads;
}

ExprVector Mechanism::passive_effort(const Motion& motion, const ExprVector& q, const ExprVector& w,
                                     Index joint) const {
  const Joint& one = parts_.joints[as_size(joint)];
  ExprVector effort;
  if (one.damping.size() > 0) effort = -one.damping.cwiseProduct(rate(motion, w, joint));
  if (one.stiffness.size() > 0) {
    ExprVector strain = displacement(motion, q, joint);
    if (one.rest.size() > 0) strain -= one.rest;
    if (effort.size() == 0) effort = ExprVector::Zero(strain.size());
    effort -= one.stiffness.cwiseProduct(strain);
  }
  return effort;
}

const Mechanism::Branch* Mechanism::branch_of(Index joint) const {
  const auto found = std::ranges::find(branches_, joint, &Branch::joint);
  return found == branches_.end() ? nullptr : &*found;
}

ExprVector Mechanism::displacement(const Motion& motion, const ExprVector& q, Index joint) const {
  const JointType type = parts_.joints[as_size(joint)].type;
  const Branch* branch = branch_of(joint);
  if (branch != nullptr && has_angles(type))
    return q.segment(branch->position, degrees_of_freedom(type));
  return joint_displacement(place_of(motion, joint));
}

ExprVector Mechanism::rate(const Motion& motion, const ExprVector& w, Index joint) const {
  const JointType type = parts_.joints[as_size(joint)].type;
  if (const Branch* branch = branch_of(joint))
    return w.segment(branch->velocity, degrees_of_freedom(type));
  const ExprVector relative = relative_velocity(motion, joint) * w;
  ExprVector rates(degrees_of_freedom(type));
  Index k = 0;
  for (const Wrench& direction : joint_directions(place_of(motion, joint)))
    rates[k++] = direction.force.dot(relative.head(3)) + direction.torque.dot(relative.tail(3));
  return rates;
}

}  // namespace courant
