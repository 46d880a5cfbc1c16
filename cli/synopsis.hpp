// What the command takes, as data: read from the application that prints --help, so that manual pages and completion
// have no text of their own.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace courant::cli {

// A name and what it means: an exit status, a variable of the environment.
struct Term {
  std::string name, meaning;
};

const std::vector<Term>& exit_statuses();
const std::vector<Term>& environment();

// An option or a positional argument of a subcommand.
struct ArgumentSynopsis {
  std::vector<std::string> names;  // "-o", "--output"; of a positional argument "FILE"
  std::string value;               // "DIR"; of a flag nothing
  std::vector<std::string> words;  // the values there are, where --help says "auto|native"
  std::string summary;
  bool is_required = false;
  bool is_repeated = false;
  std::vector<std::string> needs, excludes;  // other options, by their first names

  // What the value is, by its name in --help: FILE or DIR.
  bool takes_file() const;
  bool takes_folder() const;
};

// A command with what it takes, in the order of its help.
struct CommandSynopsis {
  std::string name, summary;
  std::vector<ArgumentSynopsis> positionals, options;
};

// `courant` itself and its subcommands, in the order of --help; what is hidden there is left out.
struct Synopsis {
  CommandSynopsis main;
  std::vector<CommandSynopsis> commands;
};
Synopsis synopsis(const CLI::App& app);

}  // namespace courant::cli
