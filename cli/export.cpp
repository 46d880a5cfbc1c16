#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/cli/experiment_file.hpp"
#include "courant/cli/force.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/running/c_program.hpp"

namespace courant::cli {

void add_export(CLI::App& app, Session& session) {
  struct Arguments {
    std::string file, language, output;
    std::vector<std::string> settings;
    bool force = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "export", "Write the integrator of an experiment as a program of one file");
  command->add_option("FILE", arguments->file, "the experiment, or - for standard input")
      ->required();
  command->add_option("--language", arguments->language, "of the program: c is C99")
      ->required()
      ->check(CLI::IsMember({"c"}).description(""))
      ->type_name("c");
  command
      ->add_option("-o,--output", arguments->output,
                   "where to write; by default to standard output")
      ->type_name("FILE");
  add_force(*command, arguments->force);
  add_settings(*command, arguments->settings);
  command->callback([&session, arguments] {
    session.action = [arguments](const Console& console) {
      const OwnFiles files("export", arguments->force);
      if (!arguments->output.empty()) files.check(arguments->output);
      return with_experiment(
          console, arguments->file,
          [&](const Experiment& experiment) -> int {
            const std::string program = c_program(experiment);
            if (arguments->output.empty())
              console.out << program;
            else
              files.write(arguments->output, program);
            return done;
          },
          arguments->settings);
    };
  });
}

}  // namespace courant::cli
