#include "courant/structures/mechanism.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <random>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/structures/joint_reactions.hpp"

// Mistakes that these cases have to notice:
//  * an origin is turned the other way, or not at all (structures/mechanism.cpp)
//  * inertias are along the axes of the world (structures/mechanism.cpp)
//  * the second axis of a universal joint does not move with the first (structures/joint.cpp)
//  * u and v of a planar joint are exchanged (structures/joint.cpp)
//  * a reaction is that of the child on the parent, or about another point (structures/joint_reactions.cpp)
//  * accelerations without what changes the mass matrix (structures/joint_reactions.cpp)
//  * accelerations of what has no mass are divided by it (structures/joint_reactions.cpp)
//  * a gradient of a condition pulls the other way (structures/joint.cpp)
//  * a spring pushes, a damper drives (structures/mechanism.cpp)
BOOST_AUTO_TEST_SUITE(mechanisms)

using namespace courant;

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

ExprVector as_expressions(const Vector3d& v) { return constants(VectorXd(v)); }
ExprMatrix as_expressions(const Matrix3d& R) { return R.cast<Expr>(); }

// Links of one degree of freedom each in doubles, for the recursive Newton-Euler algorithm (J. J. Craig, Introduction to
// Robotics, section 6.5), in the world. Joints of several degrees are chains of links without mass.
struct Link {
  int parent = -1;
  bool turns = true;
  Vector3d axis = Vector3d::UnitX(), origin = Vector3d::Zero();
  Matrix3d turned = Matrix3d::Identity();
  double mass = 0.0;
  Vector3d center = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();
};
struct Chain {
  std::vector<Link> links;
  Vector3d gravity = Vector3d::Zero();

  struct Efforts {
    VectorXd effort;
    std::vector<Vector3d> force, torque;  // on each link, about its origin
  };
  Efforts inverse(const VectorXd& q, const VectorXd& w, const VectorXd& a) const {
    const std::size_t n = links.size();
    std::vector<Matrix3d> R(n);
    std::vector<Vector3d> r(n), omega(n), alpha(n), acceleration(n), axis(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Link& link = links[i];
      const auto k = static_cast<Index>(i);
      const bool free = link.parent < 0;
      const auto p = static_cast<std::size_t>(free ? 0 : link.parent);
      const Matrix3d Rp = free ? Matrix3d::Identity() : R[p];
      const Vector3d rp = free ? Vector3d::Zero() : r[p], op = free ? Vector3d::Zero() : omega[p],
                     ap = free ? Vector3d::Zero() : alpha[p],
                     up = free ? Vector3d(-gravity) : acceleration[p];
      const Matrix3d F = Rp * link.turned;
      axis[i] = F * link.axis;
      R[i] = link.turns ? Matrix3d(F * Eigen::AngleAxisd(q[k], link.axis)) : F;
      r[i] = rp + Rp * link.origin + (link.turns ? Vector3d::Zero() : Vector3d(q[k] * axis[i]));
      const Vector3d d = r[i] - rp;
      omega[i] = op;
      alpha[i] = ap;
      acceleration[i] = up + ap.cross(d) + op.cross(op.cross(d));
      if (link.turns) {
        omega[i] += axis[i] * w[k];
        alpha[i] += axis[i] * a[k] + op.cross(axis[i] * w[k]);
      } else {
        acceleration[i] += axis[i] * a[k] + 2.0 * op.cross(axis[i] * w[k]);
      }
    }
    Efforts found{VectorXd(static_cast<Index>(n)), std::vector<Vector3d>(n, Vector3d::Zero()),
                  std::vector<Vector3d>(n, Vector3d::Zero())};
    for (std::size_t i = n; i-- > 0;) {
      const Link& link = links[i];
      const Vector3d c = R[i] * link.center;
      const Matrix3d J = R[i] * link.inertia * R[i].transpose();
      const Vector3d f =
          link.mass * (acceleration[i] + alpha[i].cross(c) + omega[i].cross(omega[i].cross(c)));
      found.force[i] += f;
      found.torque[i] += J * alpha[i] + omega[i].cross(J * omega[i]) + c.cross(f);
      found.effort[static_cast<Index>(i)] =
          axis[i].dot(link.turns ? found.torque[i] : found.force[i]);
      if (link.parent < 0) continue;
      const auto p = static_cast<std::size_t>(link.parent);
      found.force[p] += found.force[i];
      found.torque[p] += found.torque[i] + (r[i] - r[p]).cross(found.force[i]);
    }
    return found;
  }
};

// A tree of bodies with random joints that have angles, and the same as links.
struct Random {
  Mechanism::Parts parts;
  Chain chain;
  std::vector<std::size_t> last;  // link of each joint
};

Random random_tree(std::mt19937& generator, int bodies) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> positive(0.5, 2.0);
  const auto vector = [&] {
    return Vector3d(normal(generator), normal(generator), normal(generator));
  };
  const std::vector<JointType> types = {JointType::revolute,    JointType::prismatic,
                                        JointType::cylindrical, JointType::universal,
                                        JointType::planar,      JointType::fixed};
  Random tree;
  tree.chain.gravity = vector();
  tree.parts.gravity = as_expressions(tree.chain.gravity);
  for (int b = 0; b < bodies; ++b) {
    const int parent = std::uniform_int_distribution<int>(-1, b - 1)(generator);
    const JointType type =
        types[static_cast<std::size_t>(std::uniform_int_distribution<int>(0, 5)(generator))];
    const Matrix3d A = Matrix3d::NullaryExpr([&] { return normal(generator); });
    const Matrix3d inertia = A * A.transpose();
    const Vector3d center = vector(), origin = vector(), a = vector().normalized();
    const Vector3d u = a.cross(vector()).normalized();
    const Matrix3d turned =
        Eigen::AngleAxisd(normal(generator), vector().normalized()).toRotationMatrix();
    const double mass = positive(generator);
    tree.parts.bodies.push_back(
        {"b" + std::to_string(b), mass, as_expressions(center), as_expressions(inertia)});
    Matrix3d axes;
    axes << a, u, a.cross(u);
    tree.parts.joints.push_back({.name = "j" + std::to_string(b),
                                 .type = type,
                                 .parent = parent,
                                 .child = b,
                                 .origin = {as_expressions(turned), as_expressions(origin)},
                                 .axes = as_expressions(axes)});
    std::vector<std::pair<bool, Vector3d>> motions;
    if (type == JointType::revolute) motions = {{true, a}};
    if (type == JointType::prismatic) motions = {{false, a}};
    if (type == JointType::cylindrical) motions = {{true, a}, {false, a}};
    if (type == JointType::universal) motions = {{true, a}, {true, u}};
    if (type == JointType::planar) motions = {{false, u}, {false, a.cross(u)}, {true, a}};
    if (type == JointType::fixed) {
      // A link that does not move: it turns by 0.
      motions = {{true, a}};
    }
    int before = parent < 0 ? -1 : static_cast<int>(tree.last[static_cast<std::size_t>(parent)]);
    for (std::size_t k = 0; k < motions.size(); ++k) {
      Link link{.parent = before, .turns = motions[k].first, .axis = motions[k].second};
      if (k == 0) {
        link.origin = origin;
        link.turned = turned;
      }
      before = static_cast<int>(tree.chain.links.size());
      tree.chain.links.push_back(link);
    }
    Link& own = tree.chain.links.back();
    own.mass = mass;
    own.center = center;
    own.inertia = inertia;
    tree.last.push_back(tree.chain.links.size() - 1);
  }
  return tree;
}

// A vector of the mechanism as one of the links, with 0 where a joint is fixed.
VectorXd of_links(const Random& tree, const Mechanism& mechanism, const VectorXd& of_mechanism) {
  VectorXd of = VectorXd::Zero(std::ssize(tree.chain.links));
  for (const Mechanism::Branch& branch : mechanism.branches()) {
    const Index n = degrees_of_freedom(mechanism.type_of(branch));
    const auto last = static_cast<Index>(tree.last[static_cast<std::size_t>(branch.joint)]);
    for (Index k = 0; k < n; ++k) of[last - n + 1 + k] = of_mechanism[branch.velocity + k];
  }
  return of;
}
VectorXd of_mechanism(const Random& tree, const Mechanism& mechanism, const VectorXd& of) {
  VectorXd result(mechanism.manifold()->tangent_dimension());
  for (const Mechanism::Branch& branch : mechanism.branches()) {
    const Index n = degrees_of_freedom(mechanism.type_of(branch));
    const auto last = static_cast<Index>(tree.last[static_cast<std::size_t>(branch.joint)]);
    for (Index k = 0; k < n; ++k) result[branch.velocity + k] = of[last - n + 1 + k];
  }
  return result;
}

VectorXd random_vector(Index size, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  return VectorXd::NullaryExpr(size, [&] { return normal(generator); });
}

// dp/dt and dp/dt - ∂L/∂q along (w, a).
struct EulerLagrange {
  VectorXd p_rate, effort;
  double energy;
};
EulerLagrange euler_lagrange(const Mechanism& mechanism, const VectorXd& q, const VectorXd& w,
                             const VectorXd& a) {
  const Index n = q.size();
  Graph graph;
  const ExprVector x = graph.variables("x", n), v = graph.variables("v", n);
  const Mechanism::Motion motion = mechanism.motion(x);
  const Expr T = mechanism.kinetic_energy(motion, v);
  const Expr L = T - mechanism.potential(motion, x);
  const ExprVector p_rate = tangent(gradient(T, v), joined(x, v), joined(v, constants(a)));
  const ExprVector all =
      joined(p_rate, ExprVector(p_rate - gradient(L, x)), ExprVector::Constant(1, T));
  const VectorXd found = values(substitute(all, joined(x, v), joined(constants(q), constants(w))));
  return {found.head(n), found.segment(n, n), found[2 * n]};
}

}  // namespace

BOOST_AUTO_TEST_CASE(random_trees_move_as_by_newton_and_euler) {
  std::mt19937 generator(7);
  for (int trial = 0; trial < 40; ++trial) {
    const bool has_weightless_tip = trial >= 30;
    Random tree = random_tree(generator, 1 + trial % 5);
    if (has_weightless_tip) {
      tree.parts.bodies.back() = {"tip"};
      tree.chain.links.back().mass = 0.0;
      tree.chain.links.back().inertia.setZero();
    }
    const Mechanism mechanism(tree.parts);
    BOOST_TEST(mechanism.loops().empty());
    const Index n = mechanism.manifold()->dimension();
    if (n == 0) continue;
    const VectorXd q = random_vector(n, generator), w = random_vector(n, generator),
                   a = random_vector(n, generator);
    const auto links = [&](const VectorXd& x) { return of_links(tree, mechanism, x); };
    const Chain::Efforts expected = tree.chain.inverse(links(q), links(w), links(a));
    const EulerLagrange found = euler_lagrange(mechanism, q, w, a);
    const double size = 1.0 + expected.effort.norm();
    BOOST_TEST((found.effort - of_mechanism(tree, mechanism, expected.effort)).norm() <
               1e-11 * size);
    // Columns of M: efforts of unit accelerations at rest without gravity.
    Chain weightless = tree.chain;
    weightless.gravity.setZero();
    const VectorXd rest = VectorXd::Zero(std::ssize(tree.chain.links));
    const VectorXd Mw =
        of_mechanism(tree, mechanism, weightless.inverse(links(q), rest, links(w)).effort);
    BOOST_TEST(std::abs(found.energy - 0.5 * w.dot(Mw)) < 1e-11 * (1.0 + found.energy));

    const std::vector<Wrench> reactions =
        joint_reactions(mechanism, constants(q), constants(w), constants(found.p_rate),
                        ExprVector(0), {}, std::vector<ExprVector>(tree.parts.joints.size()));
    double largest = 0.0;
    for (std::size_t j = 0; j < reactions.size(); ++j) {
      const std::size_t link = tree.last[j];
      largest = std::max({largest, (values(reactions[j].force) - expected.force[link]).norm(),
                          (values(reactions[j].torque) - expected.torque[link]).norm()});
    }
    // The efforts that make these accelerations are not those of the mechanism, which has none: the accelerations it
    // finds from dp/dt are the same all the same.
    BOOST_TEST(largest < 1e-9 * size);
  }
}

// Craig, equation (6.58): two rods with points at their ends, θ from the horizontal, torques for given accelerations.
BOOST_AUTO_TEST_CASE(a_planar_arm_has_the_torques_of_the_textbook) {
  const double m1 = 1.3, m2 = 0.7, l1 = 0.9, l2 = 0.6, g = 9.81;
  const double t1 = 0.4, t2 = 1.1, w1 = -0.8, w2 = 1.7, a1 = 2.0, a2 = -0.5;
  Mechanism::Parts parts;
  parts.is_plane = true;
  parts.gravity = ExprVector{{0.0, -g, 0.0}};
  parts.bodies = {{"upper", m1, ExprVector{{l1, 0.0, 0.0}}},
                  {"lower", m2, ExprVector{{l2, 0.0, 0.0}}}};
  const ExprMatrix z = joint_axes(ExprVector::Unit(3, 2), 2);
  parts.joints = {{.name = "A", .type = JointType::revolute, .child = 0, .axes = z},
                  {.name = "B",
                   .type = JointType::revolute,
                   .parent = 0,
                   .child = 1,
                   .origin = {ExprMatrix::Identity(3, 3), ExprVector{{l1, 0.0, 0.0}}},
                   .axes = z}};
  const Mechanism arm(parts);
  const VectorXd effort =
      euler_lagrange(arm, VectorXd{{t1, t2}}, VectorXd{{w1, w2}}, VectorXd{{a1, a2}}).effort;
  const double c1 = std::cos(t1), c2 = std::cos(t2), s2 = std::sin(t2), c12 = std::cos(t1 + t2);
  const double second = m2 * l1 * l2 * c2 * a1 + m2 * l1 * l2 * s2 * w1 * w1 + m2 * l2 * g * c12 +
                        m2 * l2 * l2 * (a1 + a2);
  const double first = m2 * l2 * l2 * (a1 + a2) + m2 * l1 * l2 * c2 * (2 * a1 + a2) +
                       (m1 + m2) * l1 * l1 * a1 - m2 * l1 * l2 * s2 * w2 * w2 -
                       2 * m2 * l1 * l2 * s2 * w1 * w2 + m2 * l2 * g * c12 +
                       (m1 + m2) * l1 * g * c1;
  BOOST_TEST(effort[0] == first, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(effort[1] == second, boost::test_tools::tolerance(1e-12));
}

// In the poses that a joint reaches its constraints hold, and its coordinates are those that it was moved by; elsewhere
// they change as their gradients say.
BOOST_AUTO_TEST_CASE(constraints_are_those_of_the_motion) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> small(-1.2, 1.2);
  for (const bool plane : {false, true})
    for (const JointType type :
         {JointType::fixed, JointType::revolute, JointType::prismatic, JointType::cylindrical,
          JointType::universal, JointType::planar, JointType::spherical, JointType::floating}) {
      if (plane &&
          (type == JointType::cylindrical || type == JointType::universal || !has_angles(type)))
        continue;
      Matrix3d axes;
      const Vector3d a =
          plane ? (type == JointType::prismatic ? Vector3d(0.6, 0.8, 0) : Vector3d::UnitZ())
                : Vector3d(VectorXd(random_vector(3, generator)).normalized());
      const ExprMatrix of_joint = plane && type == JointType::prismatic
                                      ? joint_axes_in_plane(as_expressions(a))
                                      : joint_axes(as_expressions(a), 2);
      axes = values(Eigen::Map<const ExprVector>(of_joint.data(), 9)).reshaped(3, 3);
      BOOST_TEST((axes.transpose() * axes - Matrix3d::Identity()).norm() < 1e-14);
      BOOST_TEST(std::abs(axes.determinant() - 1.0) < 1e-14);
      const Index n = degrees_of_freedom(type);
      Graph graph;
      // The child anywhere near: a floating frame moved by s along a random twist from where the joint has it.
      VectorXd x = VectorXd::NullaryExpr(has_angles(type)               ? n
                                         : type == JointType::spherical ? 9
                                                                        : 12,
                                         [&] { return small(generator); });
      if (!has_angles(type)) {
        const Matrix3d R =
            Eigen::AngleAxisd(0.9, Vector3d(VectorXd(random_vector(3, generator)).normalized()))
                .toRotationMatrix();
        for (Index i = 0; i < 3; ++i) x.tail(9).segment(3 * i, 3) = R.row(i).transpose();
      }
      const Pose P{as_expressions(
                       Matrix3d(Eigen::AngleAxisd(plane ? 0.4 : 0.7,
                                                  plane ? Vector3d::UnitZ() : Vector3d(0.6, 0, 0.8))
                                    .toRotationMatrix())),
                   as_expressions(Vector3d(0.3, -0.2, plane ? 0.0 : 0.5))};
      const Pose C = P * joint_motion(type, of_joint, constants(x));
      const JointPlace reached{type, of_joint, P, C};
      for (const JointCondition& condition : joint_conditions(reached, plane))
        BOOST_TEST(std::abs(condition.value.value()) < 1e-14, condition.name);
      BOOST_TEST(std::ssize(joint_conditions(reached, plane)) == (plane ? 3 : 6) - n);
      if (has_angles(type)) BOOST_TEST((values(joint_displacement(reached)) - x).norm() < 1e-13);
      const Vector3d f = plane ? Vector3d(0.3, 0.7, 0) : Vector3d(random_vector(3, generator));
      const Vector3d m = plane ? Vector3d(0, 0, 0.9) : Vector3d(random_vector(3, generator));
      const Expr s = graph.variable("s");
      // R(s) = (1 + s m^) R to first order.
      ExprMatrix turn = ExprMatrix::Identity(3, 3);
      turn(0, 1) -= s * m[2];
      turn(0, 2) += s * m[1];
      turn(1, 0) += s * m[2];
      turn(1, 2) -= s * m[0];
      turn(2, 0) -= s * m[1];
      turn(2, 1) += s * m[0];
      const JointPlace beside{type, of_joint, P, {turn * C.R, C.r + s * as_expressions(f)}};
      for (const JointCondition& condition : joint_conditions(beside, plane)) {
        const ExprVector at{{s}};
        const double rate =
            substitute(gradient(condition.value, at)[0], at, constants(VectorXd::Zero(1))).value();
        const auto now = [&](const ExprVector& v) {
          return values(substitute(v, at, constants(VectorXd::Zero(1))));
        };
        const double expected = now(condition.gradient.force).dot(VectorXd(f)) +
                                now(condition.gradient.torque).dot(VectorXd(m));
        BOOST_TEST(std::abs(rate - expected) < 1e-13, condition.name);
      }
    }
}

// Springs pull as their potential says, dampers take c times the square of a rate, and both stand in what a joint carries.
BOOST_AUTO_TEST_CASE(springs_have_a_potential_and_dampers_take_power) {
  std::mt19937 generator(11);
  for (int trial = 0; trial < 10; ++trial) {
    Random tree = random_tree(generator, 3);
    const VectorXd a = random_vector(3, generator), b = random_vector(3, generator);
    tree.parts.gravity = ExprVector::Zero(3);
    tree.parts.springs = {{{0, constants(a)}, {2, constants(b)}, 3.0, 0.4, 0.7},
                          {{1, constants(b)}, {Mechanism::ground, constants(a)}, 2.0, 0.0, 0.0}};
    for (Mechanism::Joint& joint : tree.parts.joints) {
      const Index n = degrees_of_freedom(joint.type);
      joint.damping = ExprVector::Constant(n, 0.3);
      joint.stiffness = ExprVector::Constant(n, 1.7);
      joint.rest = ExprVector::Constant(n, 0.2);
    }
    const Mechanism mechanism(tree.parts);
    const Index n = mechanism.manifold()->dimension();
    const VectorXd q = random_vector(n, generator), w = random_vector(n, generator);
    Graph graph;
    const ExprVector x = graph.variables("x", n);
    const VectorXd slope = values(
        substitute(gradient(mechanism.potential(mechanism.motion(x), x), x), x, constants(q)));
    const Mechanism::Motion motion = mechanism.motion(constants(q));
    std::vector<Mechanism::Load> loads = mechanism.spring_loads(motion, ExprVector::Zero(n));
    for (Index j = 0; j < 3; ++j)
      for (const auto& load : mechanism.joint_loads(
               motion, j, mechanism.passive_effort(motion, constants(q), ExprVector::Zero(n), j)))
        loads.push_back(load);
    BOOST_TEST((values(mechanism.generalised(motion, loads)) + slope).norm() <
               1e-11 * (1.0 + slope.norm()));
    // The rate of the spring's length by a difference.
    const auto length = [&](double s) {
      const Mechanism::Motion at = mechanism.motion(constants(VectorXd(q + s * w)));
      return (values(mechanism.place_of(at, tree.parts.springs[0].from)) -
              values(mechanism.place_of(at, tree.parts.springs[0].to)))
          .norm();
    };
    const double rate = (length(1e-6) - length(-1e-6)) / 2e-6;
    const double power = 0.3 * w.squaredNorm() + 0.7 * rate * rate;
    const VectorXd taken =
        values(mechanism.generalised(motion, mechanism.dampers(motion, constants(w))));
    BOOST_TEST(-taken.dot(w) == power, boost::test_tools::tolerance(1e-6));
  }
}

BOOST_AUTO_TEST_CASE(trees_grow_from_the_ground_and_loops_are_what_is_left) {
  const auto joint = [](const char* name, Index parent, Index child) {
    return Mechanism::Joint{
        .name = name, .type = JointType::revolute, .parent = parent, .child = child};
  };
  Mechanism::Parts parts;
  parts.bodies = {{"a"}, {"b"}, {"c"}, {"free"}};
  // b is reached by way of a, which stands after it, and c at once by E: C and D close loops.
  parts.joints = {joint("B", 0, 1), joint("A", -1, 0), joint("C", 1, 2), joint("D", 2, -1),
                  joint("E", 0, 2)};
  const Mechanism mechanism(parts);
  BOOST_TEST(mechanism.loops() == (std::vector<Index>{2, 3}), boost::test_tools::per_element());
  BOOST_TEST(mechanism.manifold()->dimension() == 3 + 6);
  BOOST_TEST(mechanism.branches().back().joint == -1);
  parts.is_absolute = true;
  BOOST_TEST(Mechanism(parts).loops().size() == 5U);
  BOOST_TEST(Mechanism(parts).manifold()->dimension() == 24);
  // Bodies that hold each other in a ring: one of them is free.
  parts.is_absolute = false;
  parts.joints = {joint("B", 0, 1), joint("A", 1, 0)};
  const Mechanism ring(parts);
  BOOST_TEST(ring.loops().size() == 1U);
  parts.joints = {joint("B", 0, 0)};
  BOOST_CHECK_THROW(Mechanism{parts}, std::invalid_argument);
  parts.joints = {joint("B", 0, 9)};
  BOOST_CHECK_THROW(Mechanism{parts}, std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(equations_tell_their_joint) {
  BOOST_TEST((joint_of_equation(equation_of("D", {"axes", 0.0, {}})) == "D"));
  BOOST_TEST(!joint_of_equation("p_A' = dL/dA").has_value());
  BOOST_TEST(!joint_of_equation("x^2 + y^2").has_value());
}

BOOST_AUTO_TEST_SUITE_END()
