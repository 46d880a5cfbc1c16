// The frames of SDF: models, links, joints and frames, each given in another one.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "courant/extensions/robots/pose.hpp"
#include "courant/extensions/robots/robot.hpp"
#include "courant/extensions/robots/xml.hpp"

namespace courant::robots {

// The pose that the text of an element <pose> is: x y z and roll, pitch and yaw, or a quaternion. Throws LineError.
Pose sdf_pose(const Element& pose);

// The frames of models, links, joints and <frame> elements, which name each other in `relative_to` and `attached_to`.
class SdfFrames {
 public:
  struct Frame {
    std::string name;   // with those of the models around it: `arm::hand`
    std::string scope;  // what names are looked for in
    Place place;
    Pose pose = {};
    std::string relative_to = {};          // by name in the scope, if not empty; else `in`
    std::size_t in = 0;                    // a frame
    std::string attached_to = {};          // by name in the scope, if not empty; else `on`
    std::optional<std::size_t> on = {};    // the frame that it moves with
    std::optional<std::size_t> link = {};  // of a link
  };

  // The world.
  SdfFrames();

  // Throws LineError if there is one of that name.
  std::size_t add(Frame frame);
  Frame& operator[](std::size_t i) { return frames_[i]; }
  // By a name as it is written in a scope. Throws LineError at the place if there is none.
  std::size_t named(const std::string& name, const std::string& scope, const Place& place) const;
  // In the world at rest. Throws LineError if frames are given in each other.
  Pose in_world(std::size_t frame);
  // The link that it moves with. Throws LineError likewise, and where there is none.
  std::size_t link_of(std::size_t frame) const;

 private:
  std::vector<Frame> frames_;
  std::map<std::string, std::size_t> by_name_;
  std::map<std::size_t, Pose> known_;
};

}  // namespace courant::robots
