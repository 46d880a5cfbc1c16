#include "courant/cli/schema.hpp"

#include <CLI/CLI.hpp>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/reading/catalogue.hpp"

namespace courant::cli {

void add_schema(CLI::App& app, Session& session) {
  app.add_subcommand("schema", "Print the JSON Schema of experiments")->callback([&session] {
    session.action = [](const Console& console) -> int {
      const Json frame = Json::parse(schema_text());
      console.out << experiment_schema(frame).dump(2) << '\n';
      return done;
    };
  });
}

}  // namespace courant::cli
