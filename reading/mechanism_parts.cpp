#include "courant/reading/mechanism_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "courant/core/language/declaration.hpp"
#include "courant/core/linear/symmetric_eigenvalues.hpp"
#include "courant/core/numbers/as_size.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/reading/mechanism_keys.hpp"
#include "courant/reading/mechanism_values.hpp"

namespace courant {
namespace {

// The parts of one mechanism, with what is known while they are read.
class MechanismReader : private MechanismValues {
 public:
  using MechanismValues::MechanismValues;

  std::optional<WrittenMechanism> read(ObjectReader& system) {
    mechanism_.is_plane = flag(system, "plane");
    set_plane(mechanism_.is_plane);
    mechanism_.is_absolute = system.word("coordinates") == "absolute";
    const auto gravity = system.optional("gravity");
    mechanism_.gravity = gravity ? vector(*gravity) : zeros();
    const auto bodies = system.required("bodies"), joints = system.optional("joints"),
               springs = system.optional("springs"), forces = system.optional("forces");
    if (bodies) read_bodies(*bodies);
    if (joints) read_joints(*joints);
    if (springs) read_springs(*springs);
    if (forces) read_forces(*forces);
    if (!is_right()) return std::nullopt;
    check_child_origins();
    check_mimics();
    return is_right() ? std::optional(mechanism_) : std::nullopt;
  }

 private:
  bool is_new_part(const std::string& name, const JsonReader& value) {
    try {
      if (!parse_declaration(name).shape.empty()) throw FormulaError(1, "has a size");
      if (name == "ground")
        throw FormulaError(1, "\"ground\" is what does not move; expected another name");
      return true;
    } catch (const FormulaError& error) {
      problem(value, std::string("key, ") + error.what());
      return false;
    }
  }

  void read_bodies(const JsonReader& key) {
    const auto entries = key.entries();
    if (!entries) {
      fail();
      return;
    }
    if (entries->empty()) {
      key.expected("at least one body");
      fail();
    }
    for (const auto& [name, value] : *entries) {
      is_new_part(name, value);
      ObjectReader object(value, body_keys());
      if (!value.value().is_object()) {
        fail();
        continue;
      }
      WrittenMechanism::Body body{name, value.pointer(), number_at_least_0(object, "mass"), zeros(),
                                  Formulas(6, literal("0"))};
      if (!value.value().contains("mass")) fail();
      if (const auto center = object.optional("center")) body.center = vector(*center);
      if (const auto inertia = object.optional("inertia")) read_inertia(*inertia, body);
      if (const auto points = object.optional("points")) read_points(*points, body);
      mechanism_.bodies.push_back(std::move(body));
    }
  }

  void read_points(const JsonReader& key, WrittenMechanism::Body& body) {
    const auto entries = key.entries();
    if (!entries) {
      fail();
      return;
    }
    for (const auto& [name, value] : *entries) {
      if (!is_new_part(name, value)) continue;
      if (name == "x" || name == "y" || name == "z" || name == "w" || name == "angle") {
        problem(value, "key, " + in_quotes(body.name + "." + name) +
                           " is of the body itself; expected another name");
        continue;
      }
      body.points.emplace_back(name, vector(value));
    }
  }

  void read_inertia(const JsonReader& value, WrittenMechanism::Body& body) {
    const auto formulas = read_formulas(value);
    if (!formulas) {
      fail();
      return;
    }
    const Formulas& f = formulas->formulas;
    const Shape& shape = formulas->shape;
    if (is_plane() && shape.empty()) {
      if (!constant(f)) return;
      body.inertia[2] = f[0];
      if (!(evaluate(f[0], constants()).value() >= 0.0))
        problem(value,
                "is " + exact_text(evaluate(f[0], constants()).value()) + "; expected at least 0");
      return;
    }
    if (shape == Shape{6}) {
      body.inertia = f;
    } else if (shape == Shape{3, 3}) {
      body.inertia = {f[0], f[4], f[8], f[1], f[2], f[5]};
    } else {
      value.expected(is_plane() ? "a number, about the axis of z"
                                : "[xx, yy, zz, xy, xz, yz], or a 3 x 3 matrix");
      fail();
      return;
    }
    if (!constant(f)) return;
    if (shape.size() == 2) {
      const VectorXd all = value_of(f);
      if (all[1] != all[3] || all[2] != all[6] || all[5] != all[7])
        return problem(value, "is not symmetric; expected a matrix of inertia");
    }
    check_inertia(value, value_of(body.inertia));
  }

  // Principal moments are at least 0, and none is larger than the sum of the others, as for any distribution of mass.
  void check_inertia(const JsonReader& value, const VectorXd& entries) {
    // Inertias are typed with a few digits: a flat plate, whose moments meet the bound, is off it by their rounding.
    constexpr double rounding = 1e-3;
    MatrixXd J(3, 3);
    J << entries[0], entries[3], entries[4], entries[3], entries[1], entries[5], entries[4],
        entries[5], entries[2];
    const VectorXd moments = symmetric_eigenvalues(J);
    const double allowed = rounding * std::max(std::fabs(moments[0]), std::fabs(moments[2]));
    if (moments[0] < -allowed)
      return problem(
          value, "has the principal moment " + number_text(moments[0]) + "; expected at least 0");
    if (moments[2] > moments[0] + moments[1] + allowed)
      problem(value, "has the principal moments " + number_text(moments[0]) + ", " +
                         number_text(moments[1]) + " and " + number_text(moments[2]) +
                         "; expected none that is larger than the sum of the others");
  }

  Index body_named(const std::string& name) const {
    const auto found = std::ranges::find(mechanism_.bodies, name, &WrittenMechanism::Body::name);
    return found == mechanism_.bodies.end() ? -2 : found - mechanism_.bodies.begin();
  }
  std::vector<std::string> body_names() const {
    std::vector<std::string> names{"ground"};
    for (const auto& body : mechanism_.bodies) names.push_back(body.name);
    return names;
  }

  Index read_body(const std::optional<JsonReader>& value) {
    const auto name = value ? value->text() : std::nullopt;
    if (!name) {
      fail();
      return Mechanism::ground;
    }
    if (*name == "ground") return Mechanism::ground;
    const Index body = body_named(*name);
    if (body == -2) unknown_body(*value, *name);
    return std::max(body, Mechanism::ground);
  }
  void unknown_body(const JsonReader& value, const std::string& name) {
    const std::string meant = did_you_mean(name, body_names());
    problem(value, "unknown body " + in_quotes(name) +
                       (meant.empty() ? "; expected ground or one of \"bodies\"" : meant));
  }

  void read_joints(const JsonReader& key) {
    const auto entries = key.entries();
    if (!entries) {
      fail();
      return;
    }
    for (const auto& [name, value] : *entries) {
      is_new_part(name, value);
      ObjectReader object(value, joint_keys());
      if (!value.value().is_object()) {
        fail();
        continue;
      }
      read_joint(name, value, object);
    }
    for (const auto& [joint, value] : mimics_) read_mimic(value, mechanism_.joints[joint]);
  }

  void read_mimic(const JsonReader& value, WrittenMechanism::Joint& joint) {
    ObjectReader object(value, mimic_keys());
    if (!value.value().is_object()) {
      fail();
      return;
    }
    WrittenMechanism::Mimic mimic{0, literal("1"), literal("0")};
    for (const auto& [key, formula] :
         {std::pair("multiplier", &mimic.multiplier), {"offset", &mimic.offset}}) {
      const auto given = object.optional(key);
      const auto read = given ? read_formula(*given) : std::nullopt;
      if (given && !read) fail();
      if (read && constant({*read})) *formula = *read;
    }
    const auto named = object.required("joint");
    const auto name = named ? named->text() : std::nullopt;
    if (!name) {
      fail();
      return;
    }
    const auto of = std::ranges::find(mechanism_.joints, *name, &WrittenMechanism::Joint::name);
    if (of == mechanism_.joints.end() || *name == joint.name) {
      std::vector<std::string> others;
      for (const auto& other : mechanism_.joints)
        if (other.name != joint.name) others.push_back(other.name);
      const std::string meant = did_you_mean(*name, others);
      return problem(*named, (of == mechanism_.joints.end() ? "unknown joint " + in_quotes(*name)
                                                            : "is the joint itself") +
                                 (meant.empty() ? "; expected another one of \"joints\"" : meant));
    }
    mimic.of = of - mechanism_.joints.begin();
    joint.mimic = mimic;
  }

  void read_joint(const std::string& name, const JsonReader& value, ObjectReader& object) {
    WrittenMechanism::Joint joint;
    joint.name = name;
    joint.pointer = value.pointer();
    const auto type = object.required("type");
    const auto word = type ? type->word(joint_words()) : std::nullopt;
    joint.parent = read_body(object.required("parent"));
    joint.child = read_body(object.required("child"));
    joint.origin = pose(object, "origin");
    joint.has_child_origin = value.value().contains("child_origin");
    joint.child_origin = pose(object, "child_origin");
    const auto axis = object.optional("axis"), axis2 = object.optional("axis2");
    const auto damping = object.optional("damping"), stiffness = object.optional("stiffness"),
               rest = object.optional("rest");
    const std::array efforts{object.optional("torque"), object.optional("force"),
                             object.optional("effort")};
    const auto mimic = object.optional("mimic");
    if (!word) {
      fail();
      return;
    }
    if (is_right() && joint.parent == joint.child)
      problem(value, "connects a body with itself; expected two bodies");
    const JointWord& kind = *std::ranges::find_if(
        joint_types(), [&](const JointWord& one) { return *word == one.word; });
    joint.type = kind.type;
    const Index n = is_plane() ? plane_type(joint, *type, *word) : degrees_of_freedom(joint.type);
    read_axes(axis, axis2, *word, joint);
    if (damping) joint.damping = coefficients(*damping, n);
    if (stiffness) joint.stiffness = coefficients(*stiffness, n);
    if (rest) joint.rest = coefficients(*rest, n);
    if (stiffness && !has_angles(joint.type))
      problem(*stiffness, "is of a joint of type " + in_quotes(*word) +
                              "; expected springs between points there");
    if (rest && !stiffness) problem(*rest, "is there without a stiffness; expected both");
    constexpr std::array names{"torque", "force", "effort"};
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (!efforts[i]) continue;
      if (std::string(kind.effort) != names[i]) {
        problem(*efforts[i], "drives a joint of type " + in_quotes(*word) + "; expected " +
                                 (n == 0 ? "nothing there" : "the key " + in_quotes(kind.effort)));
        continue;
      }
      joint.effort = formulas(*efforts[i], n, false);
    }
    if (mimic) mimics_.emplace_back(mechanism_.joints.size(), *mimic);
    mechanism_.joints.push_back(std::move(joint));
  }

  // The type in a plane, and its degrees of freedom.
  Index plane_type(WrittenMechanism::Joint& joint, const JsonReader& type,
                   const std::string& word) {
    if (joint.type == JointType::floating) joint.type = JointType::planar;
    if (joint.type == JointType::spherical || joint.type == JointType::universal ||
        joint.type == JointType::cylindrical)
      problem(type, "is " + in_quotes(word) +
                        "; expected revolute, continuous, prismatic, planar, floating or fixed, in "
                        "a plane");
    return degrees_of_freedom(joint.type);
  }

  void read_axes(const std::optional<JsonReader>& axis, const std::optional<JsonReader>& axis2,
                 const std::string& word, WrittenMechanism::Joint& joint) {
    const bool in_plane = is_plane() && joint.type == JointType::prismatic;
    if (is_plane() && !in_plane) {
      joint.axis = axis ? along_z(*axis) : Formulas{literal("0"), literal("0"), literal("1")};
    } else if (axis) {
      joint.axis = vector(*axis);
    } else {
      joint.axis = {literal("1"), literal("0"), literal("0")};
    }
    if (!is_right()) return;
    const VectorXd a = value_of(joint.axis);
    if (a.isZero(0.0)) return problem(*axis, "is zero; expected a direction");
    a.cwiseAbs().maxCoeff(&joint.largest);
    if (joint.type != JointType::universal) {
      if (axis2)
        problem(*axis2, "is of a joint of type " + in_quotes(word) +
                            "; expected a second axis of universal joints only");
      return;
    }
    if (!axis2) return;
    joint.axis2 = vector(*axis2);
    if (!is_right()) return;
    const VectorXd u = value_of(joint.axis2);
    if (u.isZero(0.0)) return problem(*axis2, "is zero; expected a direction");
    // Directions are typed with some digits.
    constexpr double rounding = 1e-6;
    if (std::fabs(u.dot(a)) > rounding * u.norm() * a.norm())
      problem(*axis2, "is not perpendicular to the axis; expected a right angle");
  }

  WrittenMechanism::Place read_place(const std::optional<JsonReader>& value) {
    WrittenMechanism::Place place{Mechanism::ground, zeros()};
    if (!value) {
      fail();
      return place;
    }
    if (value->value().is_array()) {
      place.at = vector(*value);
      return place;
    }
    const auto text = value->text();
    if (!text) {
      fail();
      return place;
    }
    if (*text == "ground") return place;
    const std::size_t point = text->find('.');
    const std::string name = text->substr(0, point);
    place.body = body_named(name);
    if (place.body == -2) {
      unknown_body(*value, name);
      return place;
    }
    place.at.clear();
    if (point == std::string::npos) return place;
    const auto& points = mechanism_.bodies[as_size(place.body)].points;
    const std::string of_body = text->substr(point + 1);
    const auto found = std::ranges::find(points, of_body, &WrittenMechanism::Point::first);
    if (found != points.end()) {
      place.at = found->second;
      return place;
    }
    std::vector<std::string> names;
    for (const auto& [known, at] : points) names.push_back(known);
    const std::string meant = did_you_mean(of_body, names);
    problem(*value, "unknown point " + in_quotes(of_body) + " of " + in_quotes(name) +
                        (meant.empty() ? "; expected one of its \"points\"" : meant));
    return place;
  }

  void read_springs(const JsonReader& key) {
    const auto entries = key.entries();
    if (!entries) {
      fail();
      return;
    }
    for (const auto& [name, value] : *entries) {
      ObjectReader object(value, spring_keys());
      if (!value.value().is_object()) {
        fail();
        continue;
      }
      WrittenMechanism::Spring spring{name,
                                      read_place(object.required("from")),
                                      read_place(object.required("to")),
                                      number_at_least_0(object, "stiffness"),
                                      number_at_least_0(object, "rest"),
                                      number_at_least_0(object, "damping")};
      if (is_right() && spring.from.body == spring.to.body)
        problem(value, "is between two points of one body; expected two bodies, or one and ground");
      mechanism_.springs.push_back(std::move(spring));
    }
  }

  void read_forces(const JsonReader& key) {
    const auto list = key.elements();
    if (!list) {
      fail();
      return;
    }
    for (const JsonReader& value : *list) {
      ObjectReader object(value, force_keys());
      if (!value.value().is_object()) {
        fail();
        continue;
      }
      const auto at = object.required("at");
      WrittenMechanism::Force force{read_place(at), object.word("frame") == "body", zeros(),
                                    zeros()};
      const auto components_of = object.optional("force"), torque = object.optional("torque");
      if (components_of) force.force = components(*components_of).value_or(zeros());
      if (torque && is_plane()) {
        if (const auto formula = read_formula(*torque))
          force.torque[2] = *formula;
        else
          fail();
      } else if (torque) {
        force.torque = components(*torque).value_or(zeros());
      }
      if (!components_of && !torque)
        problem(
            value,
            "is neither a force nor a torque; expected one of the keys \"force\" and \"torque\"");
      if (is_right() && force.at.body == Mechanism::ground)
        problem(*at, "is on the ground, which no force moves; expected a body");
      mechanism_.forces.push_back(std::move(force));
    }
  }

  // The child of a joint in a tree has its frame where the joint is.
  void check_child_origins() {
    const Mechanism built = mechanism_.at(constants());
    for (const Mechanism::Branch& branch : built.branches()) {
      if (branch.joint < 0) continue;
      const WrittenMechanism::Joint& joint = mechanism_.joints[as_size(branch.joint)];
      if (!joint.has_child_origin || is_identity(joint.child_origin)) continue;
      findings().problem(joint.pointer + "/child_origin",
                         "is of a joint that closes no loop, whose frame is that of the child; "
                         "expected none");
      fail();
    }
  }
  // What mimics and what it mimics are numbers among the coordinates.
  void check_mimics() {
    const Mechanism built = mechanism_.at(constants());
    const auto is_number = [&](Index joint) {
      return degrees_of_freedom(mechanism_.joints[as_size(joint)].type) == 1 &&
             std::ranges::find(built.branches(), joint, &Mechanism::Branch::joint) !=
                 built.branches().end();
    };
    for (Index j = 0; j < std::ssize(mechanism_.joints); ++j) {
      const WrittenMechanism::Joint& joint = mechanism_.joints[as_size(j)];
      if (!joint.mimic) continue;
      for (const Index one : {j, joint.mimic->of}) {
        if (is_number(one)) continue;
        findings().problem(
            joint.pointer + "/mimic",
            "is about " + in_quotes(mechanism_.joints[as_size(one)].name) +
                (mechanism_.is_absolute ? ", and coordinates are those of bodies; expected joint "
                                          "coordinates"
                                        : ", whose coordinate is not one of the system; expected "
                                          "revolute or prismatic joints that close no loop"));
        fail();
        break;
      }
    }
  }
  bool is_identity(const WrittenMechanism::Pose& pose) const {
    const VectorXd R = value_of(pose.rotation), one{{1, 0, 0, 0, 1, 0, 0, 0, 1}};
    return value_of(pose.xyz).isZero(0.0) && R == one;
  }

  WrittenMechanism mechanism_;
  std::vector<std::pair<std::size_t, JsonReader>> mimics_;  // by the number of the joint
};

}  // namespace

std::optional<WrittenMechanism> read_mechanism_parts(ObjectReader& system,
                                                     const SymbolTable& constants) {
  return MechanismReader(constants, system.place().findings()).read(system);
}

}  // namespace courant
