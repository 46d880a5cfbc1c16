#include "courant/cli/command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <ostream>

#include "courant/cli/help_formatter.hpp"
#include "courant/cli/synopsis.hpp"
#include "courant/core/files/output_file.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/core/words/text_layout.hpp"
#include "courant/core/words/version.hpp"
#include "courant/running/run_files.hpp"

namespace courant::cli {
namespace {

int refuse(const Console& console, const std::string& what, Status status) {
  print_error(console, what);
  return status;
}

// The status, if what was printed has reached standard output.
int unless_lost(const Console& console, int status) {
  if (console.out.flush()) return status;
  return refuse(console, "what was printed is lost: standard output cannot be written", failed);
}

// What is wrong with a first argument that is neither an option of all commands nor a command; nothing if it is one.
std::string unknown_command(const std::string& word, const CLI::App& app) {
  std::vector<std::string> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(command->get_name());
  const bool is_option = word.starts_with('-');
  if (is_option ? app.get_option_no_throw(word) != nullptr
                : std::find(commands.begin(), commands.end(), word) != commands.end())
    return "";
  if (is_option)
    return "unknown option \"" + word +
           "\"; expected a command first, whose options stand behind it: `courant --help` "
           "lists the commands";
  return "unknown command \"" + word + "\"" + did_you_mean(word, commands) +
         "; `courant --help` lists the commands";
}

// An empty word names no file, folder or kind, also where an option without it has a default: it is
// what a shell passes for "$name" without a value. Nothing if there is none.
std::string empty_word(const std::vector<std::string>& arguments) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    if (word.starts_with("--") && word.find('=') == word.size() - 1)
      return word.substr(0, word.size() - 1) + ": is empty; expected a value";
    if (!word.empty()) continue;
    const std::string before = i > 0 ? arguments[i - 1] : "";
    return (before.starts_with("-") ? before : "argument " + std::to_string(i + 1)) +
           ": is empty; expected a value";
  }
  return "";
}

std::string table(const std::string& title, const std::vector<Term>& terms) {
  std::size_t width = 0;
  for (const Term& term : terms) width = std::max(width, term.name.size());
  std::string text = title + ":\n";
  for (const Term& term : terms)
    text += "  " + term.name + std::string(width + 2 - term.name.size(), ' ') + term.meaning + "\n";
  return text;
}

}  // namespace

void print_error(const Console& console, const std::string& what) {
  // It may quote what somebody has written, which may have megabytes. Its place is in the beginning, what was expected in the end.
  constexpr std::size_t most = 4000, ending = 500;
  console.err << "courant: " << printable(shortened_between(what, most, ending)) << '\n';
}

void end_overdue(const Console& console, const std::function<Status()>& tell) {
  Status status = failed;
  try {
    status = tell();
  } catch (const std::exception& error) {
    print_error(console, error.what());
  }
  console.out.flush();
  console.err.flush();
  std::_Exit(status);
}

int command(const std::vector<std::string>& arguments, const Console& console) {
  Session session{console};
  CLI::App app("Geometric integrators from Dirac structures and the constraint algorithm.",
               "courant");
  app.formatter(std::make_shared<HelpFormatter>(
      console.columns < Console::kUsualColumns ? console.columns : HelpFormatter::kMostColumns));
  app.require_subcommand(1);
  app.set_version_flag("--version", "courant " COURANT_VERSION_STRING);
  add_run(app, session);
  add_constraints(app, session);
  add_check(app, session);
  add_study(app, session);
  add_list(app, session);
  add_schema(app, session);
  add_import(app, session);
  add_export(app, session);
  add_sweep_command(app, session);
  add_report(app, session);
  add_plot(app, session);
  add_new(app, session);
  add_tour(app, session);
  add_cache(app, session);
  add_completion(app, session);
  add_man(app, session);
  app.footer(table("Environment", environment()) + "\n" + table("Exit status", exit_statuses()) +
             "\n`courant COMMAND --help` lists the options of a command.");
  try {
    if (!arguments.empty())
      if (const std::string what = unknown_command(arguments[0], app); !what.empty())
        return refuse(console, what, wrong);
    if (const std::string what = empty_word(arguments); !what.empty())
      return refuse(console, what + "; see `courant --help`", wrong);
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    return unless_lost(console, session.action(console));
  } catch (const CLI::Success& help) {
    app.exit(help, console.out, console.err);
    return unless_lost(console, done);
  } catch (const CLI::ParseError& error) {
    return refuse(console, std::string(error.what()) + "; see `courant --help`", wrong);
  } catch (const RefusedOutput& error) {
    return refuse(console, error.what(), wrong);
  } catch (const RunFileError& error) {
    return refuse(console, error.what(), wrong);
  } catch (const OutputError& error) {  // says which file
    return refuse(console, error.what(), failed);
  } catch (const std::bad_alloc&) {
    return refuse(console, "this takes more memory than there is", failed);
  } catch (const std::exception& error) {
    return refuse(console, without_place(error.what()), failed);
  }
}

}  // namespace courant::cli
