#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/cli/manual_page.hpp"
#include "courant/core/files/output_file.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/core/words/spelling.hpp"

namespace courant::cli {
namespace {

// All pages, as files courant.1, courant-run.1, …
int write_pages(const Synopsis& all, const std::filesystem::path& folder) {
  make_folder(folder);
  const OwnFiles files("man");
  files.write(folder / (all.main.name + ".1"), manual_page(all));
  for (const CommandSynopsis& command : all.commands)
    files.write(folder / (all.main.name + "-" + command.name + ".1"), manual_page(all, command));
  return done;
}

int print_page(const Console& console, const Synopsis& all, const std::string& name) {
  if (name.empty()) {
    console.out << manual_page(all);
    return done;
  }
  std::vector<std::string> names;
  for (const CommandSynopsis& command : all.commands) {
    if (command.name == name) {
      console.out << manual_page(all, command);
      return done;
    }
    names.push_back(command.name);
  }
  print_error(console, "man: there is no command \"" + name + "\"" + did_you_mean(name, names));
  return wrong;
}

}  // namespace

void add_man(CLI::App& app, Session& session) {
  struct Arguments {
    std::string command;
    std::filesystem::path folder;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* man = app.add_subcommand("man", "Print a manual page, to be read by man -l -");
  CLI::Option* command =
      man->add_option("COMMAND", arguments->command, "of this command; without, of courant itself");
  man->add_option("-o", arguments->folder, "write the pages of all commands to this folder")
      ->type_name("DIR")
      ->excludes(command);
  man->callback([&app, &session, arguments] {
    session.action = [&app, arguments](const Console& console) {
      const Synopsis all = synopsis(app);
      return arguments->folder.empty() ? print_page(console, all, arguments->command)
                                       : write_pages(all, arguments->folder);
    };
  });
}

}  // namespace courant::cli
