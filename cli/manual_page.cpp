#include "courant/cli/manual_page.hpp"

#include <cctype>

#include "courant/core/words/version.hpp"
#include "courant/core/words/word_list.hpp"

namespace courant::cli {
namespace {

// Text that roff prints as it is: hyphens that can be copied, and nothing that it would obey.
std::string roff(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '\\':
        result += "\\e";
        break;
      case '-':
        result += "\\-";
        break;
      case '\'':
        result += "\\(aq";
        break;
      case '`':
        result += "\\(ga";
        break;
      case '^':
        result += "\\(ha";
        break;
      case '~':
        result += "\\(ti";
        break;
      default:
        result += c;
    }
  return result.starts_with('.') ? "\\&" + result : result;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string sentence(std::string text) {
  if (text.empty()) return text;
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text.ends_with('.') ? text : text + ".";
}

std::string head(const std::string& name, const std::string& summary) {
  const std::string what = summary.ends_with('.') ? summary.substr(0, summary.size() - 1) : summary;
  return ".TH " + upper(roff(name)) +
         " 1 \"\" \"Courant " COURANT_VERSION_STRING "\" \"User Commands\"\n.SH NAME\n" +
         roff(name) + " \\- " + roff(what) + "\n";
}

std::string listed(const std::vector<std::string>& names) { return word_list(names, bold); }

std::string entry(const ArgumentSynopsis& argument, bool is_option) {
  std::string text = ".TP\n" + (is_option ? listed(argument.names) : italic(argument.names[0]));
  if (is_option && argument.words.empty() && !argument.value.empty())
    text += " " + italic(argument.value);
  if (is_option && !argument.words.empty()) text += " " + bold(argument.value);
  text += "\n" + roff(sentence(argument.summary)) + "\n";
  if (!is_option && !argument.words.empty()) {
    text += "One of ";
    text += listed(argument.words) + ".\n";
  }
  if (is_option && argument.is_required) text += "Required.\n";
  if (!argument.needs.empty()) text += "Only with " + listed(argument.needs) + ".\n";
  if (!argument.excludes.empty()) text += "Not with " + listed(argument.excludes) + ".\n";
  return text;
}

std::string section(const std::string& title, const std::vector<ArgumentSynopsis>& arguments,
                    bool is_option) {
  if (arguments.empty()) return "";
  std::string text = ".SH " + title + "\n";
  for (const ArgumentSynopsis& argument : arguments) text += entry(argument, is_option);
  return text;
}

std::string section(const std::string& title, const std::vector<Term>& terms) {
  std::string text = ".SH \"" + title + "\"\n";
  for (const Term& term : terms)
    text += ".TP\n" + bold(term.name) + "\n" + roff(sentence(term.meaning)) + "\n";
  return text;
}

std::string page_name(const Synopsis& synopsis, const CommandSynopsis& command) {
  return synopsis.main.name + "-" + command.name;
}

}  // namespace

std::string manual_page(const Synopsis& synopsis) {
  const CommandSynopsis& main = synopsis.main;
  std::string text = head(main.name, main.summary) + ".SH SYNOPSIS\n" + bold(main.name) + " " +
                     italic("COMMAND") + " [" + italic("OPTION") + "...]\n.SH DESCRIPTION\n" +
                     roff(sentence(main.summary)) + "\n.SH COMMANDS\n";
  for (const CommandSynopsis& command : synopsis.commands)
    text += ".TP\n" + bold(page_name(synopsis, command)) + "(1)\n" +
            roff(sentence(command.summary)) + "\n";
  return text + section("OPTIONS", main.options, true) + section("EXIT STATUS", exit_statuses()) +
         section("ENVIRONMENT", environment());
}

std::string manual_page(const Synopsis& synopsis, const CommandSynopsis& command) {
  const std::string& program = synopsis.main.name;
  std::string usage = bold(program + " " + command.name);
  if (!command.options.empty()) usage += " [" + italic("OPTION") + "...]";
  for (const ArgumentSynopsis& argument : command.positionals) {
    const std::string name = italic(argument.names.front()) + (argument.is_repeated ? "..." : "");
    usage += argument.is_required ? " " + name : " [" + name + "]";
  }
  return head(page_name(synopsis, command), command.summary) + ".SH SYNOPSIS\n" + usage +
         "\n.SH DESCRIPTION\n" + roff(sentence(command.summary)) + "\n" +
         section("ARGUMENTS", command.positionals, false) +
         section("OPTIONS", command.options, true) + section("EXIT STATUS", exit_statuses()) +
         section("ENVIRONMENT", environment()) + ".SH \"SEE ALSO\"\n" + bold(program) + "(1)\n";
}

}  // namespace courant::cli
