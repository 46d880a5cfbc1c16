#include "courant/cli/completion_script.hpp"
#include "courant/core/words/word_list.hpp"

namespace courant::cli {
namespace {

// The shell command that offers what the argument may be; ":" where there is nothing to offer.
std::string offer(const ArgumentSynopsis& argument) {
  if (!argument.words.empty()) return "_courant_offer -W '" + word_list(argument.words, " ") + "'";
  if (argument.takes_file()) return "_courant_offer -f";
  if (argument.takes_folder()) return "_courant_offer -d";
  return ":";
}

std::string names_of(const std::vector<ArgumentSynopsis>& options) {
  std::vector<std::string> names;
  for (const ArgumentSynopsis& option : options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return word_list(names, " ");
}

std::string case_of(const CommandSynopsis& command) {
  std::string text = "    " + command.name + ")\n      case $before in\n";
  for (const ArgumentSynopsis& option : command.options)
    if (!option.value.empty())
      text += "        " + word_list(option.names, " | ") + ") " + offer(option) + "; return ;;\n";
  text += "      esac\n      case $word in\n        -*) _courant_offer -W '" +
          names_of(command.options) + "' ;;\n";
  if (!command.positionals.empty())
    text += "        *) " + offer(command.positionals.front()) + " ;;\n";
  return text + "      esac ;;\n";
}

}  // namespace

std::string bash_completion(const Synopsis& synopsis) {
  std::vector<std::string> commands;
  for (const CommandSynopsis& command : synopsis.commands) commands.push_back(command.name);
  std::string text = R"(# Completion of courant for bash, made by `courant completion bash`.

# _courant_offer <option of compgen>...: what of that begins with $word; names of files are quoted by bash.
_courant_offer() {
  [[ $1 == -W ]] || compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <(compgen "$@" -- "$word")
}

_courant() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  COMPREPLY=()
  # Bash takes --backend=native for three words.
  if [[ $word == '=' ]]; then
    word=
  elif [[ $before == '=' ]]; then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  if ((COMP_CWORD == 1)); then
    case $word in
      -*) _courant_offer -W ')" +
                     names_of(synopsis.main.options) + "' ;;\n      *) _courant_offer -W '" +
                     word_list(commands, " ") + "' ;;\n    esac\n    return\n  fi\n" +
                     "  case ${COMP_WORDS[1]} in\n";
  for (const CommandSynopsis& command : synopsis.commands) text += case_of(command);
  return text + "  esac\n}\n\ncomplete -F _courant courant\n";
}

}  // namespace courant::cli
