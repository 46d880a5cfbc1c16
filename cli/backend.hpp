// The option --backend of several subcommands.
#pragma once

#include "courant/core/expressions/function.hpp"

namespace CLI {
class App;
}

namespace courant::cli {

void add_backend(CLI::App& command, Backend::Kind& backend);

}  // namespace courant::cli
