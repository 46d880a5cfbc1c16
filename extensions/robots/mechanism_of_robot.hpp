// Robots as systems of the kind `mechanism`.
#pragma once

#include "courant/extensions/robots/robot.hpp"

namespace courant::robots {

// The system that a robot is, in joint coordinates. Links that fixed joints connect are one body; the frame of a body
// is that of the joint by which it hangs on its parent, at rest. Throws LineError, where a link moves that has no mass,
// and nothing hangs on it. Adds notes to those of the robot.
struct MechanismOfRobot {
  Json system;
  std::map<std::string, Place> bodies,
      joints;  // where they are in the file, by their names in the system
};
MechanismOfRobot mechanism_of(Robot& robot);

}  // namespace courant::robots
