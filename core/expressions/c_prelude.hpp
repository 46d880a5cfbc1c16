// What the C source of programs calls.
#pragma once

#include <string>

namespace courant {

// `#include <math.h>` and those of the functions courant_power, courant_stumpff and courant_arccos_factor
// that occur in this source of Program::c_source.
std::string c_prelude(const std::string& source);

}  // namespace courant
