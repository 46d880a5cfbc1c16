#include "courant/cli/schema.hpp"

#include <CLI/CLI.hpp>
#include <ostream>

#include "courant/cli/command.hpp"

namespace courant::cli {

void add_schema(CLI::App& app, Session& session) {
  app.add_subcommand("schema", "Print the JSON Schema of experiments")->callback([&session] {
    session.action = [](const Console& console) -> int {
      console.out << schema_text();
      return done;
    };
  });
}

}  // namespace courant::cli
