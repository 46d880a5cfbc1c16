#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/core/files/output_file.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/reading/new_experiment.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant::cli {
namespace {

std::string kinds_with_an_example() {
  std::string list;
  for (const KindDescription& kind : system_kinds().descriptions())
    if (!kind.example.is_null()) list += (list.empty() ? "" : "|") + kind.type;
  return list;
}

}  // namespace

void add_new(CLI::App& app, Session& session) {
  struct Arguments {
    std::string kind, file;
    bool in_formulas = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("new", "Print a commented experiment to start from");
  command->add_option("KIND", arguments->kind, "the kind of its system")
      ->type_name_fn(kinds_with_an_example)
      ->required();
  command
      ->add_option("-o", arguments->file,
                   "write it to a file that is not there yet (default: standard output)")
      ->type_name("FILE");
  command->add_flag("--formulas", arguments->in_formulas,
                    "write a system of the catalogue as the formulas that it stands for");
  command->callback([&session, arguments] {
    session.action = [arguments](const Console& console) -> int {
      try {
        const std::string text = new_experiment(arguments->kind, arguments->in_formulas);
        if (arguments->file.empty()) {
          console.out << text;
        } else if (file_exists(arguments->file)) {
          print_error(console, arguments->file + ": is there already; expected another file (-o)");
          return wrong;
        } else {
          write_file(arguments->file, text);
        }
        return done;
      } catch (const ExperimentError& error) {
        print_error(console, error.what());
        return wrong;
      }
    };
  });
}

}  // namespace courant::cli
