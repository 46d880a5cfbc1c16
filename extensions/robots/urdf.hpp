// The Unified Robot Description Format of ROS.
#pragma once

#include "courant/extensions/robots/robot.hpp"
#include "courant/extensions/robots/xml.hpp"

namespace courant::robots {

// `root` is the element <robot>. Its root link is fixed to the ground. Throws LineError.
Robot read_urdf(const Element& root);

}  // namespace courant::robots
