#include "courant/extensions/robots/sdf.hpp"

#include <cmath>
#include <set>

#include "courant/core/words/message.hpp"
#include "courant/extensions/robots/sdf_frames.hpp"

namespace courant::robots {
namespace {

Place where(const Element& element) { return {element.line, element.origin}; }

double number_of(const Element* parent, const char* name, double otherwise) {
  const Element* child = parent ? parent->child(name) : nullptr;
  return child ? child->text_number() : otherwise;
}

bool flag_of(const Element& parent, const char* name, bool otherwise) {
  const Element* child = parent.child(name);
  return child ? child->text_flag() : otherwise;
}

class SdfReader {
 public:
  explicit SdfReader(const Element& root) : root_(root) {
    if (const auto version = root.number("version")) version_ = *version;
  }

  Robot read() {
    robot_.gravity = {0.0, 0.0, -9.8};
    for (const Element& element : root_.children)
      if (element.name == "world") {
        if (world_) element.fail("is a second world; expected one");
        world_ = &element;
      }
    const Element& top = world_ ? *world_ : root_;
    if (world_) read_world(*world_);
    std::vector<const Element*> models;
    for (const Element& element : top.children)
      if (element.name == "model") models.push_back(&element);
    if (models.empty()) top.fail("has no <model>; expected at least one");
    const std::string* name = (models.size() == 1 ? *models.front() : top).attribute("name");
    if (name) robot_.title = *name;
    for (const Element* model : models) read_model(*model, "", 0, false);
    read_parts(top, "", 0);
    if (robot_.links.size() == 1) top.fail("has no <link> in its models; expected at least one");
    require_different_names(robot_);
    for (const Pending& one : joints_) add_joint(one);
    require_different_names(robot_);
    for (const auto& [element, joint, scope] : mimics_) add_mimic(*element, joint, scope);
    for (const auto& [link, place] : static_links_)
      robot_.joints.push_back({.name = "",
                               .place = place,
                               .type = JointType::fixed,
                               .parent = 0,
                               .child = link,
                               .origin = frames_.in_world(frame_of_link_.at(link))});
    set_gravity();
    free_the_rest();
    return robot_;
  }

 private:
  struct Pending {
    const Element* element;
    std::size_t frame;
    std::string scope;
  };
  struct Mimic {
    const Element* element;
    std::size_t joint;
    std::string scope;
  };

  void read_world(const Element& world) {
    const Element* physics = world.child("physics");
    const Element* gravity = world.child("gravity");
    if (!gravity && physics) gravity = physics->child("gravity");
    if (gravity) robot_.gravity = gravity->text_vector();
    if (physics && physics->child("max_step_size")) {
      const Element& step = *physics->child("max_step_size");
      if (!(step.text_number() > 0.0)) step.fail("is not above 0; expected a time in s");
      robot_.step = step.text_number();
    }
    for (const Element& element : world.children) {
      if (element.name == "include")
        robot_.notes.add(where(element),
                         "<include> is left out: the models of a world are those written in it");
      if (element.name == "wind" || element.name == "plugin" || element.name == "actor")
        robot_.notes.add(where(element),
                         "<" + element.name + "> is left out, with all that is in it");
    }
  }

  // `pose` with the frame that it is given in, of a frame that is written in a scope.
  static void set_pose(const Element& element, SdfFrames::Frame& frame) {
    const Element* pose = element.child("pose");
    if (!pose) return;
    frame.pose = sdf_pose(*pose);
    const std::string* in = pose->attribute("relative_to");
    if (!in) in = pose->attribute("frame");
    if (in) frame.relative_to = *in;
  }

  void read_model(const Element& model, const std::string& outer, std::size_t in, bool is_static) {
    const std::string& called = model.required("name");
    const std::string scope = outer.empty() ? called : outer + "::" + called;
    if (model.attribute("placement_frame"))
      model.fail(
          "has a placement_frame, which is not supported; expected the pose of the model itself");
    SdfFrames::Frame frame{.name = scope, .scope = outer, .place = where(model), .in = in};
    set_pose(model, frame);
    const std::size_t own = frames_.add(frame);
    is_static = flag_of(model, "static", is_static);
    const std::string* canonical = model.attribute("canonical_link");
    std::optional<std::size_t> first;
    for (const Element& element : model.children) {
      if (element.name == "link") {
        const std::size_t link = add_link(element, scope, own, is_static);
        if (!first) first = link;
      } else if (element.name == "model") {
        const std::size_t before = robot_.links.size();
        read_model(element, scope, own, is_static);
        if (!first && robot_.links.size() > before) first = frame_of_link_.at(before);
      } else if (element.name == "include") {
        element.fail("is not supported in a model; expected what it includes to be written out");
      } else if (element.name == "plugin") {
        robot_.notes.add(where(element), "<plugin> is left out, with all that is in it");
      }
    }
    frames_[own].on = first;
    if (canonical) {
      frames_[own].on = frames_.named(*canonical, scope, where(model));
    }
    read_parts(model, scope, own);
  }

  // Frames and joints, in a model or in the world.
  void read_parts(const Element& element, const std::string& scope, std::size_t in) {
    const auto full = [&](const Element& one) {
      const std::string& name = one.required("name");
      return scope.empty() ? name : scope + "::" + name;
    };
    for (const Element& one : element.children) {
      if (one.name == "frame") {
        SdfFrames::Frame frame{
            .name = full(one), .scope = scope, .place = where(one), .in = in, .on = in};
        if (const std::string* to = one.attribute("attached_to"); to && !to->empty()) {
          frame.attached_to = *to;
          frame.relative_to = *to;
        }
        set_pose(one, frame);
        frames_.add(frame);
      } else if (one.name == "joint") {
        SdfFrames::Frame frame{.name = full(one), .scope = scope, .place = where(one)};
        const Element* child = one.child("child");
        if (!child || child->text.empty()) one.fail("has no <child>; expected the name of a link");
        frame.relative_to = child->text;
        frame.attached_to = child->text;
        set_pose(one, frame);
        joints_.push_back({&one, frames_.add(frame), scope});
      }
    }
  }

  std::size_t add_link(const Element& element, const std::string& scope, std::size_t model,
                       bool is_static) {
    const std::string name = scope + "::" + element.required("name");
    SdfFrames::Frame frame{.name = name,
                           .scope = scope,
                           .place = where(element),
                           .in = model,
                           .link = robot_.links.size()};
    set_pose(element, frame);
    const std::size_t added = frames_.add(frame);
    frame_of_link_[robot_.links.size()] = added;
    const bool is_alone = root_models() == 1 && scope.find("::") == std::string::npos;
    Link link{.name = is_alone ? *element.attribute("name") : name, .place = where(element)};
    link.inertia = inertia_of(element.child("inertial"), element.required("name"), link);
    if (is_static) static_links_.emplace_back(robot_.links.size(), where(element));
    if (!is_static)
      (flag_of(element, "gravity", true) ? heavy_ : weightless_).push_back(where(element));
    if (flag_of(element, "kinematic", false))
      robot_.notes.add(where(element), "a kinematic link moves here as any other one");
    robot_.links.push_back(link);
    return added;
  }

  std::size_t root_models() const {
    std::size_t count = 0;
    for (const Element& element : (world_ ? *world_ : root_).children)
      count += element.name == "model" ? 1U : 0U;
    return count;
  }

  // Of a link that says nothing: 1 kg, and 1 kg m² about each axis.
  Inertia inertia_of(const Element* inertial, const std::string& called, Link& link) {
    const auto unit = [](const char* entry) { return entry[1] == entry[2] ? 1.0 : 0.0; };
    if (!inertial) {
      robot_.notes.add(link.place,
                       "a link without <inertial> has 1 kg and the inertia 1 kg m² about each "
                       "axis, as SDF says");
      return {1.0, Vector3d::Zero(), Matrix3d::Identity()};
    }
    if (inertial->attribute("auto") && *inertial->attribute("auto") == "true")
      link.unknown = {where(*inertial),
                      "the inertia of meshes and collisions is not computed (auto); expected "
                      "<mass> and <inertia>"};
    if (inertial->child("fluid_added_mass"))
      robot_.notes.add(where(*inertial->child("fluid_added_mass")),
                       "<fluid_added_mass> is left out");
    const Element* inertia = inertial->child("inertia");
    const auto entry = [&](const char* name) { return number_of(inertia, name, unit(name)); };
    const Inertia given{number_of(inertial, "mass", 1.0), Vector3d::Zero(),
                        symmetric(entry("ixx"), entry("iyy"), entry("izz"), entry("ixy"),
                                  entry("ixz"), entry("iyz"))};
    check_inertia(given, where(*inertial), "the link " + in_quotes(called));
    const Element* pose = inertial->child("pose");
    return (pose ? sdf_pose(*pose) : Pose{}) * given;
  }

  std::size_t end_of(const Element& joint, const char* name, const std::string& scope) const {
    const Element* end = joint.child(name);
    if (!end || end->text.empty())
      joint.fail("has no <" + std::string(name) + ">; expected the name of a link");
    return frames_.link_of(frames_.named(end->text, scope, where(*end)));
  }

  void add_joint(const Pending& pending) {
    const Element& element = *pending.element;
    Joint joint{.name = element.required("name"), .place = where(element)};
    if (root_models() > 1 || pending.scope.find("::") != std::string::npos)
      joint.name = frames_[pending.frame].name;
    joint.parent = end_of(element, "parent", pending.scope);
    joint.child = end_of(element, "child", pending.scope);
    if (joint.parent == joint.child) element.fail("joins a link with itself; expected two links");
    const Pose own = frames_.in_world(pending.frame);
    joint.origin = inverse(in_world(joint.parent)) * own;
    joint.child_origin = inverse(in_world(joint.child)) * own;
    const std::string& type = element.required("type");
    if (type == "revolute" || type == "continuous")
      joint.type = JointType::revolute;
    else if (type == "prismatic")
      joint.type = JointType::prismatic;
    else if (type == "fixed")
      joint.type = JointType::fixed;
    else if (type == "ball")
      joint.type = JointType::ball;
    else if (type == "universal" || type == "revolute2")
      joint.type = JointType::universal;
    else
      element.fail("has the type " + in_quotes(type) +
                   ", which is not supported; expected revolute, continuous, prismatic, fixed, "
                   "ball, universal or "
                   "revolute2");
    if (joint.type == JointType::revolute || joint.type == JointType::prismatic) {
      read_axis(element, "axis", pending, own, joint);
    } else if (joint.type == JointType::universal) {
      read_axis(element, "axis", pending, own, joint);
      const double damping = joint.damping, stiffness = joint.stiffness;
      read_axis(element, "axis2", pending, own, joint);
      if (joint.damping != damping) element.fail("has two different dampings; expected equal ones");
      if (joint.stiffness != 0.0 || stiffness != 0.0)
        robot_.notes.add(where(element), "springs of joints with two axes are left out");
      joint.stiffness = 0.0;
      if (std::abs(joint.axes[0].normalized().dot(joint.axes[1].normalized())) > 1e-9)
        element.fail("has two axes that are not perpendicular; expected perpendicular ones");
    }
    robot_.joints.push_back(joint);
  }

  void read_axis(const Element& element, const char* name, const Pending& pending, const Pose& own,
                 Joint& joint) {
    const Element* axis = element.child(name);
    if (!axis) element.fail("has no <" + std::string(name) + ">; expected one");
    const Element* xyz = axis->child("xyz");
    Vector3d direction = xyz ? xyz->text_vector() : Vector3d(Vector3d::UnitZ());
    if (!(direction.norm() > 1e-6)) axis->fail("has a direction of length 0; expected another one");
    // Before 1.5 an axis is in the frame of the model.
    const bool is_in_model = version_ < 1.45 || flag_of(*axis, "use_parent_model_frame", false);
    const std::string* in = xyz ? xyz->attribute("expressed_in") : nullptr;
    if (in && !in->empty())
      direction =
          own.rotation.transpose() *
          (frames_.in_world(frames_.named(*in, pending.scope, where(*xyz))).rotation * direction);
    else if (is_in_model)
      direction =
          own.rotation.transpose() *
          (frames_.in_world(frames_.named("__model__", pending.scope, where(*axis))).rotation *
           direction);
    joint.axes.push_back(direction);
    const Element* dynamics = axis->child("dynamics");
    joint.damping = number_of(dynamics, "damping", 0.0);
    joint.stiffness = number_of(dynamics, "spring_stiffness", 0.0);
    joint.reference = number_of(dynamics, "spring_reference", 0.0);
    if (joint.damping < 0.0 || joint.stiffness < 0.0)
      dynamics->fail("has a damping or spring_stiffness below 0; expected at least 0");
    if (number_of(dynamics, "friction", 0.0) != 0.0)
      robot_.notes.add(where(*dynamics), "dry friction of joints is left out");
    if (const Element* limit = axis->child("limit");
        limit && (limit->child("lower") || limit->child("upper")))
      robot_.notes.add(
          where(*limit),
          "limits of joints are left out: they move beyond them, with any effort and velocity");
    if (const Element* mimic = axis->child("mimic"))
      mimics_.push_back({mimic, robot_.joints.size(), pending.scope});
  }

  void add_mimic(const Element& element, std::size_t joint, const std::string& scope) {
    const std::string& name = element.required("joint");
    const double factor = number_of(&element, "multiplier", 1.0);
    for (std::size_t i = 0; i < robot_.joints.size(); ++i)
      if (robot_.joints[i].name == name || robot_.joints[i].name == scope + "::" + name) {
        robot_.couplings.push_back(
            {where(element), joint, i, factor,
             number_of(&element, "offset", 0.0) - factor * number_of(&element, "reference", 0.0)});
        return;
      }
    element.fail("has an unknown joint " + in_quotes(name) + "; expected one of the model");
  }

  Pose in_world(std::size_t link) {
    return link == 0 ? Pose{} : frames_.in_world(frame_of_link_.at(link));
  }

  // All links have their weight, or none has.
  void set_gravity() {
    if (weightless_.empty()) return;
    if (!heavy_.empty())
      fail(weightless_.front(),
           "a link without gravity beside others with it is not supported; expected all links "
           "alike");
    robot_.gravity.setZero();
  }

  // The first link of what hangs on nothing is free.
  void free_the_rest() {
    std::vector<std::vector<std::size_t>> beside(robot_.links.size());
    for (const Joint& joint : robot_.joints) {
      beside[joint.parent].push_back(joint.child);
      beside[joint.child].push_back(joint.parent);
    }
    std::vector<bool> is_held(robot_.links.size(), false);
    for (std::size_t first = 0; first < robot_.links.size(); ++first) {
      if (is_held[first]) continue;
      if (first > 0)
        robot_.joints.push_back({.name = "",
                                 .place = robot_.links[first].place,
                                 .type = JointType::floating,
                                 .parent = 0,
                                 .child = first,
                                 .origin = in_world(first)});
      std::vector<std::size_t> open = {first};
      is_held[first] = true;
      while (!open.empty()) {
        const std::size_t at = open.back();
        open.pop_back();
        for (const std::size_t other : beside[at])
          if (!is_held[other]) {
            is_held[other] = true;
            open.push_back(other);
          }
      }
    }
  }

  const Element& root_;
  const Element* world_ = nullptr;
  double version_ = 1.7;
  Robot robot_;
  SdfFrames frames_;
  std::map<std::size_t, std::size_t> frame_of_link_;
  std::vector<Pending> joints_;
  std::vector<Mimic> mimics_;
  std::vector<std::pair<std::size_t, Place>> static_links_;
  std::vector<Place> heavy_, weightless_;
};

}  // namespace

Robot read_sdf(const Element& root) { return SdfReader(root).read(); }

}  // namespace courant::robots
