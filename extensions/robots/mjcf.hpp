// The format of MuJoCo.
#pragma once

#include "courant/extensions/importing/included_text.hpp"
#include "courant/extensions/robots/robot.hpp"
#include "courant/extensions/robots/xml.hpp"

namespace courant::robots {

// `root` is the element <mujoco>. Of several joints of a body each but the last moves a link without mass. Throws
// LineError.
Robot read_mjcf(const Element& root, const IncludedText& included);

}  // namespace courant::robots
