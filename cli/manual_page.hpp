// Manual pages of the command, as man(1) reads them.
#pragma once

#include <string>

#include "courant/cli/synopsis.hpp"

namespace courant::cli {

// courant(1).
std::string manual_page(const Synopsis& synopsis);

// courant-run(1) and its like.
std::string manual_page(const Synopsis& synopsis, const CommandSynopsis& command);

}  // namespace courant::cli
