#include "courant/cli/synopsis.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <set>
#include <sstream>

namespace courant::cli {
namespace {

std::vector<std::string> sorted_names(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::sort(names.begin(), names.end());
  return names;
}

ArgumentSynopsis argument(const CLI::Option& option) {
  ArgumentSynopsis result;
  for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  const std::string type = option.get_type_size() == 0 ? "" : option.get_type_name();
  if (type.find('|') != std::string::npos) {
    std::istringstream words(type);
    for (std::string word; std::getline(words, word, '|');) result.words.push_back(word);
  }
  result.value = type;
  if (option.get_positional()) {
    result.names = {option.get_name(true)};
    if (result.words.empty()) result.value = result.names.front();
  }
  result.summary = option.get_description();
  result.is_required = option.get_required();
  result.is_repeated = option.get_type_size() != 0 &&
                       (option.get_expected_max() >= CLI::detail::expected_max_vector_size ||
                        option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll);
  result.needs = sorted_names(option.get_needs());
  result.excludes = sorted_names(option.get_excludes());
  return result;
}

CommandSynopsis command_synopsis(const CLI::App& app) {
  CommandSynopsis result;
  result.name = app.get_name();
  result.summary = app.get_description();
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    (option->get_positional() ? result.positionals : result.options).push_back(argument(*option));
  }
  return result;
}

}  // namespace

const std::vector<Term>& exit_statuses() {
  static const std::vector<Term> statuses{
      {"0", "done"},
      {"2", "the command line or the experiment is wrong"},
      {"3", "the numerics or an expectation failed"},
      {"130", "interrupted"},
  };
  return statuses;
}

const std::vector<Term>& environment() {
  static const std::vector<Term> variables{
      {"COURANT_CC", "the C compiler that makes native code of formulas (default: cc)"},
      {"COURANT_CACHE", "the folder in which that is kept (default: ~/.cache/courant)"},
      {"COLUMNS", "where text is wrapped (default: at the width of the terminal)"},
      {"NO_COLOR", "no colours on the terminal"},
  };
  return variables;
}

bool ArgumentSynopsis::takes_file() const { return value == "FILE"; }
bool ArgumentSynopsis::takes_folder() const { return value == "DIR"; }

Synopsis synopsis(const CLI::App& app) {
  Synopsis result{.main = command_synopsis(app), .commands = {}};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* subcommand) {
         return !subcommand->get_group().empty() && !subcommand->get_name().empty();
       }))
    result.commands.push_back(command_synopsis(*command));
  // COMMAND is one of these.
  for (CommandSynopsis& command : result.commands)
    for (ArgumentSynopsis& argument : command.positionals)
      if (argument.value == "COMMAND")
        for (const CommandSynopsis& other : result.commands) argument.words.push_back(other.name);
  return result;
}

}  // namespace courant::cli
