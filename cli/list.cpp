#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/cli/text.hpp"
#include "courant/reading/method_kinds.hpp"
#include "courant/reading/space.hpp"
#include "courant/reading/structure_kinds.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant::cli {
namespace {

struct Shelf {
  const char* name;
  std::vector<KindDescription> kinds;
};

std::vector<Shelf> catalogue() {
  return {{"systems", system_kinds().descriptions()},
          {"manifolds", manifold_kinds().descriptions()},
          {"structures", structure_kinds().descriptions()},
          {"methods", method_kinds().descriptions()},
          {"discretizations", discretization_kinds().descriptions()},
          {"projectors", projector_kinds().descriptions()}};
}

void print_json(const Console& console) {
  Json json;
  for (const Shelf& shelf : catalogue()) {
    json[shelf.name] = Json::array();
    for (const KindDescription& kind : shelf.kinds)
      json[shelf.name].push_back({{"type", kind.type}, {"summary", kind.summary}});
  }
  console.out << json.dump(2) << '\n';
}

void print_text(const Console& console) {
  const std::vector<Shelf> shelves = catalogue();
  std::size_t width = 0;
  for (const Shelf& shelf : shelves)
    for (const KindDescription& kind : shelf.kinds) width = std::max(width, kind.type.size());
  for (const Shelf& shelf : shelves) {
    console.out << shelf.name << '\n';
    for (const KindDescription& kind : shelf.kinds)
      console.out << "  " << kind.type << std::string(width + 2 - kind.type.size(), ' ')
                  << kind.summary << '\n';
  }
}

}  // namespace

void add_list(CLI::App& app, Session& session) {
  auto json = std::make_shared<bool>(false);
  CLI::App* list = app.add_subcommand("list", "List what an experiment can be made of");
  list->add_flag("--json", *json, "print JSON");
  list->callback([&session, json] {
    session.action = [json](const Console& console) -> int {
      *json ? print_json(console) : print_text(console);
      return done;
    };
  });
}

}  // namespace courant::cli
