// The option --force of commands that write a file.
#pragma once

#include <CLI/CLI.hpp>

namespace courant::cli {

inline void add_force(CLI::App& command, bool& force) {
  command.add_flag("--force", force,
                   "replace the file that -o names, though it is not as this command wrote it");
}

}  // namespace courant::cli
