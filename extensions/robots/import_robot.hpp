// Robots as experiments.
#pragma once

#include <string_view>
#include <vector>

#include "courant/extensions/importing/included_text.hpp"
#include "courant/reading/findings.hpp"

namespace courant {

// Whether a file is one of a robot: by its suffix (.urdf, .sdf, .world, .xml, .mjcf, .xacro) or, without one, by a
// first character `<`.
bool is_robot_file(std::string_view name, std::string_view text);

// The experiment with a `mechanism` that a robot is: URDF (<robot>), SDF (<sdf>, 1.4 to 1.11) or MuJoCo's MJCF
// (<mujoco>), told by the root element. It starts at rest.
//
// Throws ExperimentError with the first line that is wrong or not supported, as `line 12`. `notes` are of what is left
// out. `included` gives the text of a file that a model of MuJoCo includes.
Json import_robot(std::string_view text, std::vector<Problem>* notes = nullptr,
                  const IncludedText& included = {});

}  // namespace courant
