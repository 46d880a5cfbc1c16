// The Simulation Description Format of Gazebo.
#pragma once

#include "courant/extensions/robots/robot.hpp"
#include "courant/extensions/robots/xml.hpp"

namespace courant::robots {

// `root` is the element <sdf>, with models or with a world. Throws LineError.
Robot read_sdf(const Element& root);

}  // namespace courant::robots
