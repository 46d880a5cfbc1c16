#include <CLI/CLI.hpp>
#include <fstream>
#include <iterator>
#include <memory>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/reading/netlist.hpp"

namespace courant::cli {
namespace {

int refuse(const Console& console, const std::string& file, const std::string& what) {
  console.err << "courant: " << file << ": " << what << '\n';
  return wrong;
}

int import(const Console& console, const std::string& file, const std::string& output) {
  std::string text;
  if (file == "-") {
    text.assign(std::istreambuf_iterator<char>(console.in), {});
  } else {
    std::ifstream in(file, std::ios::binary);
    if (!in) return refuse(console, file, "cannot be read");
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  Json experiment;
  try {
    experiment = import_netlist(text);
    read_experiment(experiment.dump());  // what is wrong with the network itself
  } catch (const ExperimentError& error) {
    for (const Problem& problem : error.problems())
      refuse(console, file, (problem.where.empty() ? "" : problem.where + ": ") + problem.what);
    return wrong;
  }
  if (output.empty()) {
    console.out << experiment.dump(2) << '\n';
    return done;
  }
  std::ofstream out(output, std::ios::binary);
  out << experiment.dump(2) << '\n';
  out.close();
  return out ? static_cast<int>(done) : refuse(console, output, "cannot be written");
}

}  // namespace

void add_import(CLI::App& app, Session& session) {
  auto file = std::make_shared<std::string>(), output = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("import", "Make an experiment of a SPICE netlist");
  command->add_option("FILE", *file, "the netlist, - for standard input")->required();
  command->add_option("-o,--output", *output, "where to write; by default to standard output")
      ->type_name("FILE");
  command->callback([&session, file, output] {
    session.action = [file, output](const Console& console) -> int {
      return import(console, *file, *output);
    };
  });
}

}  // namespace courant::cli
