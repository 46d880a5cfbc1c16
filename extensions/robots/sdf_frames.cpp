#include "courant/extensions/robots/sdf_frames.hpp"

#include <cmath>
#include <numbers>

#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"

namespace courant::robots {

namespace {

// Without those of the models around it.
std::string last_name(const std::string& name) {
  const std::size_t scope = name.rfind("::");
  return in_quotes(scope == std::string::npos ? name : name.substr(scope + 2));
}

}  // namespace

Pose sdf_pose(const Element& pose) {
  if (pose.text.empty()) return {};
  const std::string* format = pose.attribute("rotation_format");
  if (format && *format == "quat_xyzw") {
    const auto n = pose.text_numbers(7);
    const double length = std::hypot(std::hypot(n[3], n[4]), std::hypot(n[5], n[6]));
    if (!(length > 1e-10)) pose.fail("has a quaternion of length 0; expected another one");
    return {of_quaternion(n[6] / length, n[3] / length, n[4] / length, n[5] / length),
            Vector3d(n.data())};
  }
  if (format && *format != "euler_rpy")
    pose.fail("has the rotation_format " + in_quotes(*format) +
              "; expected euler_rpy or quat_xyzw");
  const auto n = pose.text_numbers(6);
  const std::string* degrees = pose.attribute("degrees");
  const bool is_in_degrees = degrees && (*degrees == "true" || *degrees == "1");
  return {of_rpy(Vector3d(n.data() + 3) * (is_in_degrees ? std::numbers::pi / 180.0 : 1.0)),
          Vector3d(n.data())};
}

SdfFrames::SdfFrames() {
  add({.name = "world", .scope = "", .place = {}, .link = 0});
  known_[0] = {};
}

std::size_t SdfFrames::add(Frame frame) {
  if (!by_name_.try_emplace(frame.name, frames_.size()).second)
    fail(frame.place,
         "there is something called " + last_name(frame.name) + " already; expected another name");
  frames_.push_back(std::move(frame));
  return frames_.size() - 1;
}

std::size_t SdfFrames::named(const std::string& name, const std::string& scope,
                             const Place& place) const {
  if (name == "world") return 0;
  const std::string whole = name == "__model__" ? scope
                            : scope.empty()     ? name
                                                : scope + "::" + name;
  const auto found = by_name_.find(whole);
  if (found != by_name_.end()) return found->second;
  std::vector<std::string> names;
  const std::string before = scope.empty() ? "" : scope + "::";
  for (const auto& [one, frame] : by_name_)
    if (one.starts_with(before)) names.push_back(one.substr(before.size()));
  fail(place, "unknown link or frame " + in_quotes(name) + did_you_mean(name, names));
}

Pose SdfFrames::in_world(std::size_t frame) {
  std::vector<std::size_t> path;  // to one that is known
  for (std::size_t at = frame; !known_.contains(at);) {
    if (path.size() > frames_.size())
      fail(frames_[frame].place, "the pose of " + last_name(frames_[frame].name) +
                                     " is given in a circle of frames; expected an end of it");
    path.push_back(at);
    const Frame& one = frames_[at];
    at = one.relative_to.empty() ? one.in : named(one.relative_to, one.scope, one.place);
  }
  for (auto at = path.rbegin(); at != path.rend(); ++at) {
    const Frame& one = frames_[*at];
    const std::size_t in =
        one.relative_to.empty() ? one.in : named(one.relative_to, one.scope, one.place);
    known_[*at] = known_.at(in) * one.pose;
  }
  return known_.at(frame);
}

std::size_t SdfFrames::link_of(std::size_t frame) const {
  std::size_t at = frame;
  for (std::size_t steps = 0; steps <= frames_.size(); ++steps) {
    const Frame& one = frames_[at];
    if (one.link) return *one.link;
    if (one.attached_to.empty() && !one.on)
      fail(one.place, last_name(one.name) + " has no link that it moves with; expected one");
    at = one.attached_to.empty() ? *one.on : named(one.attached_to, one.scope, one.place);
  }
  fail(frames_[frame].place, last_name(frames_[frame].name) +
                                 " is attached to a circle of frames; expected an end of it");
}

}  // namespace courant::robots
