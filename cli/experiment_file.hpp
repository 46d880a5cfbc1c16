// The argument FILE of several subcommands.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "courant/cli/command.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/reading/table.hpp"

namespace CLI {
class App;
}

namespace courant::cli {

// The option --set of a subcommand, which may be given several times.
void add_settings(CLI::App& command, std::vector<std::string>& settings);

// Reads the experiment from the file, or from standard input if that is "-", and does with it what
// the subcommand does; returns its exit status. What is wrong with the experiment, found on reading
// it or later, is said in a line `courant: FILE: /pointer: …` for each problem, and what may be a slip
// in a line `courant: warning: FILE: /pointer: …`.
//
// `settings` are changes of the experiment, each `/json/pointer=VALUE`: VALUE is JSON or, where it
// is not, a text. The place of a value may be new if what it is in is there. `tables`: which files it
// may name.
int with_experiment(const Console& console, const std::string& file,
                    const std::function<int(const Experiment&)>& action,
                    const std::vector<std::string>& settings = {},
                    TableFiles tables = TableFiles::anywhere);

// What the file says, or standard input if that is "-"; nothing, after a line of what is wrong, if it
// cannot be read or is larger than 16 MB. `expected` is what it should be, "an experiment".
std::optional<std::string> read_input(const Console& console, const std::string& file,
                                      const std::string& expected);

// Does it; what it throws is said in lines that begin with `file`, and gives the exit status.
int reporting_errors(const Console& console, const std::string& file,
                     const std::function<int()>& action);

// with_experiment with what the file says, before it is read as an experiment.
int with_document(const Console& console, const std::string& file,
                  const std::function<int(const Json&)>& action,
                  const std::vector<std::string>& settings = {},
                  TableFiles tables = TableFiles::anywhere);

}  // namespace courant::cli
