#include "courant/extensions/robots/mjcf.hpp"

#include <algorithm>
#include <set>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/extensions/robots/mjcf_document.hpp"
#include "courant/extensions/robots/mjcf_geom.hpp"

namespace courant::robots {
namespace {

Place at(const Element& element) { return {element.line, element.origin}; }

Pose moved(const Vector3d& position) { return {Matrix3d::Identity(), position}; }

bool is_set(const Element& element, const char* name, const char* value) {
  const std::string* given = element.attribute(name);
  return given && *given == value;
}

class MjcfReader {
 public:
  MjcfReader(const Element& root, const IncludedText& included) : document_(root, included) {}

  Robot read() {
    const Element& root = document_.root();
    robot_.step = 2e-3;
    if (const std::string* model = root.attribute("model")) robot_.title = *model;
    for (const Element& element : root.children)
      if (element.name == "option") read_option(element);
    for (const Element& element : root.children)
      if (element.name == "worldbody") read_contents(element, 0, "", {});
    require_different_names(robot_);
    if (robot_.links.size() == 1) root.fail("has no <body>; expected at least one in <worldbody>");
    for (const Element& element : root.children) read_rest(element);
    if (const auto total = document_.setting_number("settotalmass"); total && *total > 0.0)
      scale_to(*total);
    for (const char* bound : {"boundmass", "boundinertia", "balanceinertia"})
      if (const std::string given = document_.setting(bound, "0"); given != "0" && given != "false")
        robot_.notes.add({}, std::string(bound) + " of <compiler> is left out");
    return robot_;
  }

 private:
  struct Site {
    std::size_t link;
    Pose pose;  // in the frame of the link
  };

  void read_option(const Element& option) {
    if (const auto gravity = option.vector("gravity")) robot_.gravity = *gravity;
    if (const auto step = option.number("timestep")) {
      if (!(*step > 0.0))
        option.fail("has a timestep of " + number_text(*step) + "; expected above 0");
      robot_.step = *step;
    }
    for (const char* medium : {"wind", "density", "viscosity", "magnetic"})
      if (option.attribute(medium) &&
          numbers_in(option, *option.attribute(medium), medium) != std::vector(1, 0.0))
        robot_.notes.add(at(option), std::string(medium) + " of <option> is left out");
  }

  // What is in a body, or in <worldbody>. `frame` is that of a <frame> around it, in the frame of the link.
  void read_contents(const Element& element, std::size_t link, const std::string& childclass,
                     const Pose& frame) {
    for (const Element& child : element.children) {
      if (child.name == "body") {
        read_body(child, link, childclass, frame);
      } else if (child.name == "geom") {
        add_geom(document_.with_defaults(child, childclass), link, frame);
      } else if (child.name == "site") {
        add_site(document_.with_defaults(child, childclass), link, frame);
      } else if (child.name == "frame") {
        const std::string* inner = child.attribute("childclass");
        read_contents(child, link, inner ? *inner : childclass, frame * document_.pose(child));
      } else if (child.name == "replicate" || child.name == "attach" || child.name == "composite" ||
                 child.name == "flexcomp") {
        child.fail("is not supported; expected bodies that are written out");
      } else if (child.name == "plugin") {
        robot_.notes.add(at(child), "<plugin> is left out, with all that is in it");
      }
    }
  }

  void read_body(const Element& element, std::size_t parent, const std::string& outer,
                 const Pose& frame) {
    const std::string* name = element.attribute("name");
    const std::string* own_class = element.attribute("childclass");
    const std::string childclass = own_class ? *own_class : outer;
    const Pose pose = frame * document_.pose(element);
    const std::size_t link = robot_.links.size();
    robot_.links.push_back(
        {.name = name ? *name : "body_" + std::to_string(link), .place = at(element)});
    at_rest_.resize(link + 1);
    at_rest_[link] = at_rest_[parent] * pose;
    weighed_by_geoms_.resize(link + 1, true);
    if (is_set(element, "mocap", "true"))
      robot_.notes.add(at(element), "a body that is moved from outside (mocap) stands still");
    if (element.number("gravcomp").value_or(0.0) != 0.0)
      robot_.notes.add(at(element), "gravcomp is left out: all bodies have their whole weight");
    const Element* inertial = element.child("inertial");
    const std::string from_geoms = document_.setting("inertiafromgeom", "auto");
    if (inertial && from_geoms != "true") {
      robot_.links[link].inertia = inertia_of(*inertial);
      check_inertia(robot_.links[link].inertia, at(*inertial),
                    "the body " + in_quotes(robot_.links[link].name));
      weighed_by_geoms_[link] = false;
    } else if (from_geoms == "false") {
      weighed_by_geoms_[link] = false;
    }
    add_joints(element, parent, link, childclass, pose);
    read_contents(element, link, childclass, {});
  }

  Inertia inertia_of(const Element& inertial) const {
    inertial.required("mass");
    Inertia inertia{*inertial.number("mass"), Vector3d::Zero(), Matrix3d::Zero()};
    if (const auto full = inertial.numbers("fullinertia", 6)) {
      const auto& m = *full;
      inertia.about_center = symmetric(m[0], m[1], m[2], m[3], m[4], m[5]);
    } else {
      inertial.required("diaginertia");
      inertia.about_center = inertial.vector("diaginertia")->asDiagonal();
    }
    return document_.pose(inertial) * inertia;
  }

  void add_joints(const Element& body, std::size_t parent, std::size_t link,
                  const std::string& childclass, const Pose& pose) {
    std::vector<Element> joints;
    for (const Element& child : body.children) {
      if (child.name == "joint") joints.push_back(document_.with_defaults(child, childclass));
      if (child.name == "freejoint") {
        joints.push_back(child);
        joints.back().attributes.emplace_back("type", "free");
      }
    }
    if (joints.empty())
      robot_.joints.push_back({.name = "",
                               .place = at(body),
                               .type = JointType::fixed,
                               .parent = parent,
                               .child = link,
                               .origin = pose});
    std::size_t from = parent;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      std::size_t to = link;
      if (i + 1 < joints.size()) {  // all but the last one move a frame that weighs nothing
        to = robot_.links.size();
        robot_.links.push_back({.name = robot_.links[link].name + "_" + std::to_string(i + 1),
                                .place = at(joints[i])});
        at_rest_.push_back(at_rest_[link]);
        weighed_by_geoms_.push_back(false);
      }
      Joint joint = joint_of(joints[i]);
      const Vector3d position = joints[i].vector("pos").value_or(Vector3d::Zero());
      if (joint.type == JointType::floating && (parent != 0 || joints.size() > 1))
        joints[i].fail("is free, but not the only joint of a body of the world; expected it there");
      joint.parent = from;
      joint.child = to;
      joint.child_origin = joint.type == JointType::floating ? Pose{} : moved(position);
      joint.origin = i == 0 ? pose * joint.child_origin : joint.child_origin;
      robot_.joints.push_back(joint);
      from = to;
    }
  }

  // The value that a joint has at rest.
  double reference_of(const Element& element, const Joint& joint) const {
    const double written = element.number("ref").value_or(0.0);
    return joint.type == JointType::revolute ? document_.angle(written) : written;
  }

  Joint joint_of(const Element& element) {
    const std::string* name = element.attribute("name");
    Joint joint{.name = name ? *name : "", .place = at(element)};
    const std::string* type = element.attribute("type");
    if (!type || *type == "hinge")
      joint.type = JointType::revolute;
    else if (*type == "slide")
      joint.type = JointType::prismatic;
    else if (*type == "ball")
      joint.type = JointType::ball;
    else if (*type == "free")
      joint.type = JointType::floating;
    else
      element.fail("has the type " + in_quotes(*type) + "; expected hinge, slide, ball or free" +
                   did_you_mean(*type, {"hinge", "slide", "ball", "free"}));
    const bool has_axis = joint.type == JointType::revolute || joint.type == JointType::prismatic;
    if (has_axis) {
      const Vector3d axis = element.vector("axis").value_or(Vector3d::UnitZ());
      if (!(axis.norm() > 1e-10)) element.fail("has an axis of length 0; expected a direction");
      joint.axes = {axis};
    }
    joint.damping = element.number("damping").value_or(0.0);
    joint.stiffness = element.number("stiffness").value_or(0.0);
    if (joint.damping < 0.0 || joint.stiffness < 0.0)
      element.fail("has a damping or stiffness below 0; expected at least 0");
    if (joint.stiffness != 0.0 && !has_axis) {
      robot_.notes.add(at(element), "stiffness of ball and free joints is left out");
      joint.stiffness = 0.0;
    }
    const double spring = element.number("springref").value_or(0.0);
    joint.reference = (joint.type == JointType::revolute ? document_.angle(spring) : spring) -
                      reference_of(element, joint);
    joint.armature = element.number("armature").value_or(0.0);
    if (joint.armature < 0.0) element.fail("has an armature below 0; expected at least 0");
    if (element.number("frictionloss").value_or(0.0) != 0.0)
      robot_.notes.add(at(element), "dry friction of joints (frictionloss) is left out");
    if ((element.attribute("range") && !is_set(element, "limited", "false")) ||
        is_set(element, "limited", "true"))
      robot_.notes.add(at(element), "limits of joints are left out: they move beyond them");
    return joint;
  }

  void add_geom(const Element& geom, std::size_t link, const Pose& frame) {
    if (link == 0 || !weighed_by_geoms_[link]) return;
    const auto group = geom.number("group").value_or(0.0);
    const std::string range = document_.setting("inertiagrouprange", "0 5");
    const auto bounds = numbers_in(geom, range, "inertiagrouprange of <compiler>");
    if (bounds.size() != 2 || group < bounds[0] || group > bounds[1]) return;
    const GeomInertia found = geom_inertia(geom, document_);
    Link& of = robot_.links[link];
    if (!found.unknown.empty() && !of.unknown) of.unknown = {at(geom), found.unknown};
    of.inertia = of.inertia + frame * found.inertia;
  }

  void add_site(const Element& site, std::size_t link, const Pose& frame) {
    const std::string* name = site.attribute("name");
    if (!name) return;
    const Pose pose = frame * document_.pose(site);
    if (!sites_.try_emplace(*name, Site{link, pose}).second)
      site.fail("is there already; expected another name");
    robot_.links[link].points.emplace_back(*name, pose.position);
  }

  void read_rest(const Element& element) {
    static const std::set<std::string> read = {"option", "worldbody", "compiler", "default",
                                               "size",   "visual",    "asset",    "statistic"};
    if (element.name == "equality") {
      for (const Element& one : element.children) read_equality(document_.with_defaults(one, ""));
    } else if (!read.contains(element.name)) {
      robot_.notes.add(at(element), "<" + element.name + "> is left out, with all that is in it");
    }
  }

  void read_equality(const Element& element) {
    if (is_set(element, "active", "false")) return;
    if (element.name == "connect" || element.name == "weld")
      close_loop(element);
    else if (element.name == "joint")
      couple(element);
    else
      robot_.notes.add(at(element), "an equality of " + element.name + " is left out");
  }

  std::size_t body_named(const Element& element, const char* which) const {
    const std::string& name = element.required(which);
    return name == "world" ? 0 : link_named(robot_, name, at(element));
  }

  // A ball joint, or a fixed one, between two bodies as they are at rest.
  void close_loop(const Element& element) {
    const bool is_weld = element.name == "weld";
    const std::string* name = element.attribute("name");
    Joint joint{.name = name ? *name : "", .place = at(element)};
    joint.type = is_weld ? JointType::fixed : JointType::ball;
    if (element.attribute("site1")) {
      const Site first = site_named(element, "site1"), second = site_named(element, "site2");
      joint.parent = first.link;
      joint.child = second.link;
      joint.origin = first.pose;
      joint.child_origin = second.pose;
      const Pose one = at_rest_[first.link] * first.pose,
                 other = at_rest_[second.link] * second.pose;
      if (is_weld ? !are_near(one, other) : !are_near(moved(one.position), moved(other.position)))
        element.fail(
            "joins two sites that are not at one place at rest; expected a model whose rest meets "
            "it");
    } else {
      joint.parent = body_named(element, "body1");
      joint.child = element.attribute("body2") ? body_named(element, "body2") : 0;
      if (!is_weld) {
        element.required("anchor");
        joint.origin = moved(*element.vector("anchor"));
      }
      joint.child_origin = inverse(at_rest_[joint.child]) * (at_rest_[joint.parent] * joint.origin);
      if (is_weld) require_rest_pose(element, inverse(joint.child_origin));
    }
    if (joint.parent == joint.child) element.fail("joins a body with itself; expected two bodies");
    robot_.joints.push_back(joint);
    robot_.notes.add(at(element), "equalities hold exactly here, and softly in MuJoCo");
  }

  // `pose`: of the second body in the frame of the first one, at rest.
  static void require_rest_pose(const Element& element, const Pose& pose) {
    const auto given = element.numbers("relpose", 7);
    if (!given) return;
    const auto& r = *given;
    if (r[3] == 0.0 && r[4] == 0.0 && r[5] == 0.0 && r[6] == 0.0) return;
    const Pose meant{of_quaternion(r[3], r[4], r[5], r[6]), Vector3d(r.data())};
    if (!are_near(meant, pose))
      element.fail(
          "has a relpose that is not that of the bodies at rest; expected a model whose rest meets "
          "it");
  }

  Site site_named(const Element& element, const char* which) const {
    const std::string& name = element.required(which);
    const auto found = sites_.find(name);
    if (found != sites_.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [one, site] : sites_) names.push_back(one);
    element.fail("has an unknown site " + in_quotes(name) + did_you_mean(name, names));
  }

  // joint1 - ref1 = a0 + a1 (joint2 - ref2) + …
  void couple(const Element& element) {
    const std::size_t joint = joint_named(element, "joint1");
    if (!element.attribute("joint2"))
      element.fail("has no joint2: a joint that is held is not supported");
    const std::size_t of = joint_named(element, "joint2");
    std::vector<double> a = {0.0, 1.0, 0.0, 0.0, 0.0};
    if (element.attribute("polycoef")) a = *element.numbers("polycoef", 5);
    if (a[2] != 0.0 || a[3] != 0.0 || a[4] != 0.0)
      element.fail("has a polycoef beyond the linear one; expected 0 for the last three");
    robot_.couplings.push_back({at(element), joint, of, a[1], a[0]});
    robot_.notes.add(at(element), "equalities hold exactly here, and softly in MuJoCo");
  }

  std::size_t joint_named(const Element& element, const char* which) const {
    const std::string& name = element.required(which);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
      if (robot_.joints[i].name == name) return i;
      names.push_back(robot_.joints[i].name);
    }
    element.fail("has an unknown joint " + in_quotes(name) + did_you_mean(name, names));
  }

  void scale_to(double total) {
    double sum = 0.0;
    for (std::size_t i = 1; i < robot_.links.size(); ++i) sum += robot_.links[i].inertia.mass;
    if (!(sum > 0.0)) return;
    for (Link& link : robot_.links) {
      link.inertia.mass *= total / sum;
      link.inertia.about_center *= total / sum;
    }
  }

  MjcfDocument document_;
  Robot robot_;
  std::vector<Pose> at_rest_ = {Pose{}};  // links in the world
  std::vector<bool> weighed_by_geoms_ = {false};
  std::map<std::string, Site> sites_;
};

}  // namespace

Robot read_mjcf(const Element& root, const IncludedText& included) {
  return MjcfReader(root, included).read();
}

}  // namespace courant::robots
