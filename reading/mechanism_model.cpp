#include "courant/reading/mechanism_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "courant/core/expressions/derivative.hpp"
#include "courant/core/expressions/expr_vectors.hpp"
#include "courant/core/expressions/function.hpp"
#include "courant/core/linear/complete_orthogonal_decomposition.hpp"
#include "courant/core/numbers/as_size.hpp"
#include "courant/manifolds/rotation.hpp"
#include "courant/structures/joint_reactions.hpp"

namespace courant {
namespace {

Declaration numbered(const std::string& name, Index n) {
  return n == 1 ? Declaration{name, {}} : Declaration{name, {n}};
}

// What a branch is called: the joint, or the free body.
std::string name_of(const Mechanism& mechanism, const Mechanism::Branch& branch) {
  return branch.joint >= 0 ? mechanism.parts().joints[as_size(branch.joint)].name
                           : mechanism.parts().bodies[as_size(branch.body)].name;
}

// Whether the coordinates of a joint are named numbers of q.
bool is_coordinate(const Mechanism& mechanism, Index joint) {
  if (!has_angles(mechanism.parts().joints[as_size(joint)].type)) return false;
  for (const Mechanism::Branch& branch : mechanism.branches())
    if (branch.joint == joint) return true;
  return false;
}

using Given = std::pair<std::string, double>;

// Where the conditions of a mechanism are met, by Gauss-Newton.
class Closing {
 public:
  explicit Closing(const MechanismModel& model) : Q_(*model.typed().manifold()) {
    const ExprVector q = graph_.variables("q", Q_.ambient_dimension());
    const ExprVector conditions = model.conditions(q);
    if (conditions.size() > 0)
      phi_ = Function("loops", {{"q", q}}, conditions, {.differentiate = {"q"}});
  }

  bool is_needed() const { return phi_.has_value(); }

  // From q by the least change along these of the velocities; nothing if that does not end. Redundant conditions follow from
  // the others where these hold, so that next to such a place their own gradients are neglected.
  std::optional<VectorXd> from(VectorXd q, const std::vector<Index>& open) const {
    constexpr int most_steps = 50;
    constexpr double near_enough = 1e-10, negligible = 1e-8;  // m, rad
    double before = std::numeric_limits<double>::infinity();
    VectorXd best = q;
    for (int step = 0; step < most_steps; ++step) {
      const VectorXd residual = (*phi_)({q});
      const double left = residual.norm();
      if (left < before) best = q;
      // Near a place steps go on while they help, to the last digits.
      if (left <= near_enough && !(0.0 < left && left < 0.5 * before)) return best;
      before = left;
      const MatrixXd J = (phi_->jacobian({q}) * Q_.frame(q))(Eigen::all, open);
      const VectorXd change = CompleteOrthogonalDecomposition(J, negligible).solve(-residual);
      // No coordinate turns by more than half a radian at once, so that the search stays near.
      const double largest = change.lpNorm<Eigen::Infinity>();
      if (!(largest < std::numeric_limits<double>::infinity())) return std::nullopt;
      q = moved(q, open, (largest > 0.5 ? 0.5 / largest : 1.0) * change);
    }
    return std::nullopt;
  }

  // From poses around q: in q itself gradients may depend on each other, as those of links in a line do.
  std::optional<VectorXd> from_around(const VectorXd& q, const std::vector<Index>& open) const {
    constexpr int directions = 3;
    for (const double distance : {0.1, 0.3, 1.0})
      for (int direction = 0; direction < directions; ++direction) {
        VectorXd change(std::ssize(open));
        for (Index i = 0; i < change.size(); ++i)
          change[i] = distance * std::cos((1.0 + 1.7 * static_cast<double>(i)) * (direction + 1.0) +
                                          direction);
        if (auto found = from(moved(q, open, change), open)) return found;
      }
    return std::nullopt;
  }

 private:
  VectorXd moved(const VectorXd& q, const std::vector<Index>& open, const VectorXd& change) const {
    VectorXd w = VectorXd::Zero(Q_.tangent_dimension());
    w(open) = change;
    return Q_.retract(q, w);
  }

  const Manifold& Q_;
  Graph graph_;
  std::optional<Function> phi_;
};

// The coordinates of all bodies as free ones, of these poses.
VectorXd poses(const Mechanism::Motion& motion, const Mechanism& absolute) {
  VectorXd q = absolute.rest();
  for (const Mechanism::Branch& branch : absolute.branches()) {
    const VectorXd r = values(absolute.center_of(motion, branch.body));
    const ExprMatrix& R = motion.body[as_size(branch.body)].R;
    if (absolute.parts().is_plane) {
      q.segment(branch.position, 2) = r.head(2);
      q[branch.position + 2] = std::atan2(R(1, 0).value(), R(0, 0).value());
      continue;
    }
    q.segment(branch.position, 3) = r;
    for (Index i = 0; i < 9; ++i) q[branch.position + 3 + i] = R(i / 3, i % 3).value();
  }
  return q;
}

// d/dt of functions of q along dq/dt, by fresh variables.
ExprVector rate_along(const std::function<ExprVector(const ExprVector& q)>& function,
                      const ExprVector& q, const ExprVector& flow) {
  const Graph graph = fresh_graph({q, flow});
  const ExprVector at = graph.variables("q", q.size()), along = graph.variables("v", q.size());
  return substitute(tangent(function(at), at, along), joined(at, along), joined(q, flow));
}

}  // namespace

MechanismModel::MechanismModel(WrittenMechanism written, Vocabulary constants)
    : written_(std::move(written)),
      constants_(std::move(constants)),
      typed_(written_.at(constants_.symbols({}))) {}

NameList MechanismModel::coordinates() const {
  NameList names;
  for (const Mechanism::Branch& branch : typed_.branches()) {
    const JointType type = typed_.type_of(branch);
    const std::string name = name_of(typed_, branch);
    if (has_angles(type)) {
      if (const Index n = degrees_of_freedom(type); n > 0) names.append(numbered(name, n));
      continue;
    }
    if (type == JointType::floating) names.append({"r_" + name, {3}});
    names.append({"R_" + name, {3, 3}});
  }
  return names;
}

NameList MechanismModel::momenta() const {
  const NameList positions = coordinates();
  NameList names;
  for (const Declaration& declaration : positions.declarations())
    names.append(
        {"p_" + declaration.name, declaration.shape.size() == 2 ? Shape{3} : declaration.shape});
  return names;
}

std::vector<std::string> MechanismModel::condition_names() const {
  std::vector<std::string> names;
  const Mechanism::Motion motion = typed_.motion(constants(typed_.rest()));
  for (const Index loop : typed_.loops())
    for (const JointCondition& condition : typed_.conditions(motion, loop))
      names.push_back(equation_of(typed_.parts().joints[as_size(loop)].name, condition));
  for (const WrittenMechanism::Joint& joint : written_.joints)
    if (joint.mimic)
      names.push_back(equation_of(
          joint.name, {"mimic of " + written_.joints[as_size(joint.mimic->of)].name, 0.0, {}}));
  return names;
}

ExprVector MechanismModel::conditions(const ExprVector& q) const {
  const SymbolTable constants = constants_.symbols({.x = q});
  const Mechanism mechanism = written_.at(constants);
  const Mechanism::Motion motion = mechanism.motion(q);
  std::vector<Expr> values;
  for (const Index loop : mechanism.loops())
    for (const JointCondition& condition : mechanism.conditions(motion, loop))
      values.push_back(condition.value);
  for (Index j = 0; j < std::ssize(written_.joints); ++j) {
    const auto& mimic = written_.joints[as_size(j)].mimic;
    if (!mimic) continue;
    values.push_back(mechanism.displacement(motion, q, j)[0] -
                     evaluate(mimic->multiplier, constants) *
                         mechanism.displacement(motion, q, mimic->of)[0] -
                     evaluate(mimic->offset, constants));
  }
  return Eigen::Map<const ExprVector>(values.data(), std::ssize(values));
}

VectorXd MechanismModel::reference(const std::vector<std::pair<std::string, double>>& given) const {
  WrittenMechanism tree = written_;
  tree.is_absolute = false;
  const MechanismModel joints(tree, constants_);
  const std::vector<std::string> names = joints.coordinates().element_names();
  VectorXd q = joints.typed_.rest();
  // Velocities of what is not given: numbers, and turns in space.
  std::vector<Index> numbers, all;
  const auto take = [&](Index i) {
    const auto value = std::ranges::find(given, names[as_size(i)], &Given::first);
    if (value == given.end()) return false;
    q[i] = value->second;
    return true;
  };
  for (const Mechanism::Branch& branch : joints.typed_.branches()) {
    const JointType type = joints.typed_.type_of(branch);
    const Index flat = has_angles(type)              ? degrees_of_freedom(type)
                       : type == JointType::floating ? 3
                                                     : 0;
    for (Index i = 0; i < flat; ++i)
      if (!take(branch.position + i)) numbers.push_back(branch.velocity + i);
    if (has_angles(type)) continue;
    bool is_given = false;
    for (Index i = 0; i < 9; ++i) is_given = take(branch.position + flat + i) || is_given;
    for (Index i = 0; i < 3 && !is_given; ++i) all.push_back(branch.velocity + flat + i);
  }
  all.insert(all.end(), numbers.begin(), numbers.end());
  if (const Closing closing(joints); closing.is_needed()) {
    std::optional<VectorXd> found;
    if (!numbers.empty()) found = closing.from(q, numbers);
    if (!found && !all.empty()) found = closing.from(q, all);
    if (!found && !all.empty()) found = closing.from_around(q, all);
    if (found) q = *found;
  }
  return written_.is_absolute ? poses(joints.typed_.motion(constants(q)), typed_) : q;
}

Mechanism MechanismModel::at(const ExprVector& q) const {
  return written_.at(constants_.symbols({.x = q}));
}

std::vector<ExprVector> MechanismModel::efforts(const SymbolTable& symbols) const {
  std::vector<ExprVector> all;
  for (const WrittenMechanism::Joint& joint : written_.joints) {
    ExprVector effort(std::ssize(joint.effort));
    for (Index k = 0; k < effort.size(); ++k)
      effort[k] = evaluate(joint.effort[as_size(k)], symbols);
    all.push_back(std::move(effort));
  }
  return all;
}

std::vector<Mechanism::Load> MechanismModel::forces(const Mechanism& mechanism,
                                                    const Mechanism::Motion& motion,
                                                    const SymbolTable& symbols) const {
  std::vector<Mechanism::Load> loads;
  for (const WrittenMechanism::Force& force : written_.forces) {
    Mechanism::Load load{
        force.at.body, mechanism.place_of(motion, written_.point(force.at, symbols)),
        evaluate({{3}, force.force}, symbols), evaluate({{3}, force.torque}, symbols)};
    if (force.in_body) {
      const ExprMatrix& R = motion.body[as_size(force.at.body)].R;
      load.force = R * load.force;
      load.torque = R * load.torque;
    }
    loads.push_back(std::move(load));
  }
  return loads;
}

ExprVector MechanismModel::configuration(const ExprVector& x) const {
  return x.head(typed_.manifold()->ambient_dimension());
}

std::optional<ExprVector> MechanismModel::velocity(const Vocabulary::Arguments& arguments) const {
  const Manifold& Q = *typed_.manifold();
  const Index N = Q.ambient_dimension(), n = Q.tangent_dimension();
  if (!arguments.x || !arguments.velocity) return std::nullopt;
  // Of formulas on Q, the velocity is the last of what is unknown; of the system, the first.
  if (arguments.z && arguments.z->size() >= n)
    return ExprVector(arguments.x->size() == N ? arguments.z->tail(n) : arguments.z->head(n));
  return ExprVector(Q.coframe(configuration(*arguments.x)) * arguments.velocity->head(N));
}

std::vector<Vocabulary::Derived> MechanismModel::quantities() const {
  const auto self = std::make_shared<const MechanismModel>(*this);
  const bool plane = written_.is_plane;
  const Index axes = plane ? 2 : 3;
  Vocabulary::Derived places, turns, kinetic, potential;

  // Coordinates of joints that are none of q, then centres and points.
  std::vector<Index> joints;
  for (Index j = 0; j < std::ssize(written_.joints); ++j) {
    const WrittenMechanism::Joint& joint = written_.joints[as_size(j)];
    const Index n = degrees_of_freedom(joint.type);
    if (n == 0 || is_coordinate(typed_, j)) continue;
    joints.push_back(j);
    places.names.append(numbered(joint.name, n));
  }
  std::vector<Mechanism::Point> points;
  const auto name_place = [&](const std::string& name) {
    for (Index k = 0; k < axes; ++k) places.names.append({name + "." + "xyz" [k], {}});
  };
  for (const WrittenMechanism::Body& body : written_.bodies) {
    name_place(body.name);
    for (const auto& [point, at] : body.points) name_place(body.name + "." + point);
  }
  const auto values_at = [self, joints, axes](const ExprVector& q) {
    const Mechanism mechanism = self->at(q);
    const Mechanism::Motion motion = mechanism.motion(q);
    const SymbolTable constants = self->constants_.symbols({.x = q});
    std::vector<ExprVector> values;
    for (const Index j : joints) values.push_back(mechanism.displacement(motion, q, j));
    for (Index b = 0; b < std::ssize(self->written_.bodies); ++b) {
      values.push_back(mechanism.center_of(motion, b).head(axes));
      for (const auto& [point, at] : self->written_.bodies[as_size(b)].points)
        values.push_back(
            mechanism.place_of(motion, self->written_.point({b, at}, constants)).head(axes));
    }
    return joined(values);
  };
  places.values = [self, values_at](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
    if (!at.x) return std::nullopt;
    return values_at(self->configuration(*at.x));
  };
  places.rates = [self, values_at](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
    if (!at.x || !at.velocity) return std::nullopt;
    const ExprVector q = self->configuration(*at.x);
    return rate_along(values_at, q, at.velocity->head(q.size()));
  };

  // In a plane the angle of a body is a number, and w its rate.
  Vocabulary::Derived angles;
  for (const WrittenMechanism::Body& body : written_.bodies) {
    turns.names.append(numbered(body.name + ".w", plane ? 1 : 3));
    if (plane) angles.names.append({body.name + ".angle", {}});
  }
  turns.values = [self, plane](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
    const auto w = self->velocity(at);
    if (!w) return std::nullopt;
    const ExprVector q = self->configuration(*at.x);
    const Mechanism::Motion motion = self->at(q).motion(q);
    std::vector<ExprVector> values;
    for (std::size_t b = 0; b < motion.body.size(); ++b) {
      const ExprVector omega = motion.body[b].R.transpose() * (motion.angular[b] * *w);
      values.push_back(plane ? ExprVector(omega.tail(1)) : omega);
    }
    return joined(values);
  };
  angles.values = [self](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
    if (!at.x) return std::nullopt;
    const ExprVector q = self->configuration(*at.x);
    const Mechanism::Motion motion = self->at(q).motion(q);
    ExprVector values(std::ssize(motion.body));
    for (Index b = 0; b < values.size(); ++b) {
      const ExprMatrix& R = motion.body[as_size(b)].R;
      values[b] = atan2(R(1, 0), R(0, 0));
    }
    return values;
  };
  kinetic.names.append({"T", {}});
  kinetic.values = [self](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
    const auto w = self->velocity(at);
    if (!w) return std::nullopt;
    const ExprVector q = self->configuration(*at.x);
    const Mechanism mechanism = self->at(q);
    return ExprVector{{mechanism.kinetic_energy(mechanism.motion(q), *w)}};
  };
  potential.names.append({"V", {}});
  potential.values = [self](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
    if (!at.x) return std::nullopt;
    const ExprVector q = self->configuration(*at.x);
    const Mechanism mechanism = self->at(q);
    return ExprVector{{mechanism.potential(mechanism.motion(q), q)}};
  };
  std::vector<Vocabulary::Derived> all{places, turns, kinetic, potential};
  if (plane) all.push_back(angles);
  return all;
}

NameList MechanismModel::reaction_names() const {
  NameList names;
  for (const WrittenMechanism::Joint& joint : written_.joints)
    for (const char* of : {"f_", "m_"}) names.append({of + joint.name, {3}});
  return names;
}

Vocabulary::Derived MechanismModel::reactions(std::shared_ptr<const PhaseWords> words) const {
  const auto self = std::make_shared<const MechanismModel>(*this);
  const auto values = [self, words](const Vocabulary::Arguments& at) -> std::optional<ExprVector> {
    const Index N = self->typed_.manifold()->ambient_dimension(),
                n = self->typed_.manifold()->tangent_dimension();
    if (!at.x || !at.velocity || !at.z || !at.t || at.x->size() != N + n) return std::nullopt;
    const ExprVector q = at.x->head(N), w = at.z->head(n), p_rate = at.velocity->tail(n);
    const Mechanism mechanism = self->at(q);
    const Mechanism::Motion motion = mechanism.motion(q);
    const SymbolTable symbols = words->at(*at.x, w, *at.t);
    std::vector<Mechanism::Load> loads = self->forces(mechanism, motion, symbols);
    for (Mechanism::Load& load : mechanism.spring_loads(motion, w))
      loads.push_back(std::move(load));
    std::vector<ExprVector> efforts = self->efforts(symbols);
    for (std::size_t j = 0; j < efforts.size(); ++j) {
      const ExprVector passive = mechanism.passive_effort(motion, q, w, static_cast<Index>(j));
      if (passive.size() == 0) continue;
      efforts[j] = efforts[j].size() == 0 ? passive : ExprVector(efforts[j] + passive);
    }
    const std::vector<Wrench> found = joint_reactions(
        mechanism, q, w, p_rate, ExprVector(at.z->tail(at.z->size() - n)), loads, efforts);
    std::vector<ExprVector> all;
    for (const Wrench& reaction : found) {
      all.push_back(reaction.force);
      all.push_back(reaction.torque);
    }
    return joined(all);
  };
  return {reaction_names(), values, {}};
}

}  // namespace courant
