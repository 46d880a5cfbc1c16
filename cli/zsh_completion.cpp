#include <algorithm>

#include "courant/cli/completion_script.hpp"

namespace courant::cli {
namespace {

// In single quotes, as a word of the shell.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

// With a backslash before what _arguments and _describe read as their own.
std::string escaped(const std::string& text, const std::string& special) {
  std::string result;
  for (const char c : text) {
    if (special.find(c) != std::string::npos) result += '\\';
    result += c;
  }
  return result;
}

// ":DIR:_files -/": what a value is called, and how it is completed.
std::string value_of(const ArgumentSynopsis& argument) {
  std::string action = " ";
  if (argument.takes_file()) action = "_files";
  if (argument.takes_folder()) action = "_files -/";
  std::string name = argument.value;
  if (!argument.words.empty()) {
    action = "(";
    for (const std::string& word : argument.words) action += (action == "(" ? "" : " ") + word;
    action += ")";
    name = argument.names.front();
  }
  return ":" + escaped(name, ":\\") + ":" + action;
}

std::string option_lines(const ArgumentSynopsis& option) {
  std::string text;
  for (const std::string& name : option.names) {
    std::vector<std::string> excluded;
    for (const std::string& other : option.excludes)
      if (other.starts_with('-')) excluded.push_back(other);
    if (!option.is_repeated)
      excluded.insert(excluded.end(), option.names.begin(), option.names.end());
    std::string others;
    for (const std::string& other : excluded) others += (others.empty() ? "" : " ") + other;
    text += " \\\n        " +
            quoted((others.empty() ? "" : "(" + others + ")") + (option.is_repeated ? "*" : "") +
                   name + "[" + escaped(option.summary, "[]\\:") + "]" +
                   (option.value.empty() ? "" : value_of(option)));
  }
  return text;
}

std::string branch(const CommandSynopsis& command) {
  std::string text = "    " + command.name + ")\n      _arguments";
  for (const ArgumentSynopsis& option : command.options) text += option_lines(option);
  for (std::size_t i = 0; i < command.positionals.size(); ++i) {
    const ArgumentSynopsis& argument = command.positionals[i];
    text += " \\\n        " +
            quoted((argument.is_repeated ? "*" : std::to_string(i + 1)) + value_of(argument));
  }
  return text + " ;;\n";
}

}  // namespace

std::string zsh_completion(const Synopsis& synopsis) {
  std::string text = R"(#compdef courant
# Completion of courant for zsh, made by `courant completion zsh`.

_courant() {
  local curcontext=$curcontext state line
  local -a commands=()";
  for (const CommandSynopsis& command : synopsis.commands)
    text += "\n    " + quoted(command.name + ":" + escaped(command.summary, ":\\"));
  text += "\n  )\n  _arguments -C";
  for (const ArgumentSynopsis& option : synopsis.main.options) text += option_lines(option);
  text += R"( \
        '1:command:->command' '*::argument:->argument'
  if [[ $state == command ]]; then
    _describe command commands
    return
  fi
  [[ $state == argument ]] || return
  curcontext=${curcontext%:*:*}:courant-$words[1]:
  case $words[1] in
)";
  for (const CommandSynopsis& command : synopsis.commands) text += branch(command);
  return text + R"(  esac
}

if [[ $zsh_eval_context[-1] == loadautofunc ]]; then
  _courant "$@"
else
  compdef _courant courant
fi
)";
}

}  // namespace courant::cli
