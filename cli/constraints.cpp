#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/cli/experiment_file.hpp"
#include "courant/cli/text.hpp"
#include "courant/systems/consistent_start.hpp"
#include "courant/systems/ladder_diagram.hpp"
#include "courant/systems/ladder_json.hpp"

namespace courant::cli {
namespace {

void print_ladder(const Console& console, const Experiment& experiment, const Json& ladder) {
  std::ostream& out = console.out;
  if (!experiment.title.empty()) out << experiment.title << '\n';
  out << "  " << experiment.model.description << "\n\n  (dim S, dim M): " << ladder_line(ladder)
      << "\n\n";
  TextTable table({"k", "dim S", "dim M", "fibre", "gap", "residual"});
  for (const Json& level : ladder.at("levels"))
    table.add({shown(level.at("k")), shown(level.at("dim_S")), shown(level.at("dim_M")),
               shown(level.at("fibre")), shown(level.at("gap"), 2),
               shown(level.at("residual"), 2)});
  table.print(out);
  out << "\n  " << verdict_in_words(ladder) << '\n';
  if (const std::string reason = ladder.at("reason"); !reason.empty())
    out << "  " << reason << '\n';
  for (const Json& move : ladder.at("moves"))
    out << "  " << move.at("name").get<std::string>() << " had to move from "
        << shown(move.at("from")) << " to " << shown(move.at("to")) << " to be consistent.\n";
}

}  // namespace

void add_constraints(CLI::App& app, Session& session) {
  struct Arguments {
    std::string file;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* constraints = app.add_subcommand(
      "constraints", "Run the constraint algorithm at the initial point of an experiment");
  constraints->add_option("FILE", arguments->file, "the experiment, or - for standard input")
      ->required();
  constraints->add_flag("--json", arguments->json, "print JSON");
  constraints->callback([&session, arguments] {
    session.action = [arguments](const Console& console) {
      return with_experiment(console, arguments->file, [&](const Experiment& experiment) -> int {
        const Json ladder = ladder_json(consistent_start(experiment), *experiment.model.system);
        if (arguments->json)
          console.out << ladder.dump(2) << '\n';
        else
          print_ladder(console, experiment, ladder);
        return done;
      });
    };
  });
}

}  // namespace courant::cli
