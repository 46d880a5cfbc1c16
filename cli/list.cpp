#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/reading/catalogue.hpp"

namespace courant::cli {
namespace {

void print_json(const Console& console) {
  Json json;
  for (const Shelf& shelf : catalogue()) {
    Json& list = json[shelf.name] = Json::array();
    for (const KindDescription& kind : shelf.kinds) {
      Json keys = Json::array();
      for (const Key& key : kind.keys) {
        Json entry = {{"key", key.name},
                      {"takes", key.takes.text},
                      {"summary", key.summary},
                      {"required", key.required}};
        if (!key.otherwise.is_null()) entry["default"] = key.otherwise;
        keys.push_back(std::move(entry));
      }
      Json entry = {{"type", kind.type}, {"summary", kind.summary}, {"keys", keys}};
      if (!kind.reference.empty()) entry["reference"] = kind.reference;
      if (!kind.formulas.is_null()) entry["formulas"] = kind.formulas;
      list.push_back(std::move(entry));
    }
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
    for (const KindDescription& kind : shelf.kinds) {
      console.out << "  " << kind.type << std::string(width + 2 - kind.type.size(), ' ')
                  << kind.sentence() << '\n';
      for (const Key& key : kind.keys) {
        console.out << std::string(width + 6, ' ') << '"' << key.name << "\": " << key.summary;
        if (key.required) console.out << " (required)";
        if (!key.otherwise.is_null()) console.out << " (default " << key.otherwise.dump() << ')';
        console.out << '\n';
      }
    }
  }
}

void print_markdown(const Console& console) {
  for (const Shelf& shelf : catalogue()) console.out << marked_table(shelf) << '\n';
}

}  // namespace

void add_list(CLI::App& app, Session& session) {
  auto json = std::make_shared<bool>(false), markdown = std::make_shared<bool>(false);
  CLI::App* list = app.add_subcommand("list", "List what an experiment can be made of");
  CLI::Option* as_json = list->add_flag("--json", *json, "print JSON");
  list->add_flag("--markdown", *markdown, "print the tables of docs/experiment-format.md")
      ->excludes(as_json);
  list->callback([&session, json, markdown] {
    session.action = [json, markdown](const Console& console) -> int {
      *json ? print_json(console) : *markdown ? print_markdown(console) : print_text(console);
      return done;
    };
  });
}

}  // namespace courant::cli
