// The argument FILE of several subcommands.
#pragma once

#include <functional>
#include <string>

#include "courant/cli/command.hpp"
#include "courant/reading/experiment.hpp"

namespace courant::cli {

// Reads the experiment from the file, or from standard input if that is "-", and does with it what
// the subcommand does; returns its exit status. What is wrong with the experiment, found on reading
// it or later, is said in a line `courant: FILE: /pointer: …` for each problem.
int with_experiment(const Console& console, const std::string& file,
                    const std::function<int(const Experiment&)>& action);

}  // namespace courant::cli
