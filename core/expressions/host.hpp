// What the host of this process has: variables of its environment.
#pragma once

#include <string>

namespace courant {

// The variable of this name; empty if there is none.
std::string environment_variable(const char* name);

}  // namespace courant
