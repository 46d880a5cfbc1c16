#include <CLI/CLI.hpp>
#include <memory>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/cli/experiment_file.hpp"
#include "courant/cli/force.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/extensions/importing/included_text.hpp"
#include "courant/extensions/robots/import_robot.hpp"
#include "courant/extensions/spice/netlist.hpp"

namespace courant::cli {
namespace {

int import(const Console& console, const std::string& file, const std::string& output, bool force) {
  const OwnFiles files("import", force);
  if (!output.empty()) files.check(output);
  const auto text = read_input(console, file, "a netlist or a robot");
  if (!text) return wrong;
  if (const Json document = Json::parse(*text, nullptr, false); document.is_object()) {
    print_error(console, file +
                             ": is JSON; expected a netlist or a robot. An experiment needs no "
                             "import: `courant run " +
                             file + "`");
    return wrong;
  }
  return reporting_errors(console, file, [&]() -> int {
    std::vector<Problem> notes;
    const IncludedText beside = files_below(std::filesystem::path(file).parent_path());
    const Json experiment = is_robot_file(file, *text) ? import_robot(*text, &notes, beside)
                                                       : import_netlist(*text, &notes, beside);
    for (const auto& [where, what] : notes)
      print_error(console, "note: " + file + ": " + where + ": " + what);
    // A title may have letters that are not UTF-8.
    const std::string document = experiment.dump(2, ' ', false, Json::error_handler_t::replace);
    if (output.empty())
      console.out << document << '\n';
    else
      files.write(output, document + "\n");
    return done;
  });
}

}  // namespace

void add_import(CLI::App& app, Session& session) {
  auto file = std::make_shared<std::string>(), output = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "import",
      "Make an experiment of a SPICE netlist (.cir) or of a robot (.urdf, .sdf, MJCF .xml)");
  command->add_option("FILE", *file, "the netlist or the robot, - for standard input")->required();
  command->add_option("-o,--output", *output, "where to write; by default to standard output")
      ->type_name("FILE");
  auto force = std::make_shared<bool>(false);
  add_force(*command, *force);
  command->callback([&session, file, output, force] {
    session.action = [file, output, force](const Console& console) -> int {
      return import(console, *file, *output, *force);
    };
  });
}

}  // namespace courant::cli
