#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "courant/cli/command.hpp"
#include "courant/cli/text.hpp"
#include "courant/core/words/spelling.hpp"
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

void print_keys(const Console& console, const std::vector<Key>& keys) {
  for (const Key& key : keys) {
    std::string takes = key.takes.text;
    if (key.required) takes += "; required";
    if (!key.otherwise.is_null()) takes += "; default " + key.otherwise.dump();
    print_wrapped(console, "    \"" + key.name + "\" (" + takes + "): " + key.summary, "  ");
  }
}

// The whole catalogue, or of each shelf the kinds that have been asked for.
void print_text(const Console& console, const std::vector<std::string>& types) {
  for (const Shelf& whole : catalogue()) {
    const bool is_asked = std::ranges::find(types, whole.name) != types.end();
    Shelf shelf = types.empty() || is_asked ? without_common_keys(whole) : whole;
    if (!types.empty() && !is_asked)
      std::erase_if(shelf.kinds, [&](const KindDescription& kind) {
        return std::ranges::find(types, kind.type) == types.end();
      });
    if (shelf.kinds.empty()) continue;
    console.out << shelf.name << '\n';
    for (const KindDescription& kind : shelf.kinds) {
      print_wrapped(console, kind.type + ": " + kind.sentence(), "  ");
      print_keys(console, kind.keys);
    }
    if (const std::vector<Key> common = common_keys(whole);
        shelf.kinds.size() == whole.kinds.size() && !common.empty()) {
      console.out << "  Any of these " << whole.name << " takes\n";
      print_keys(console, common);
    }
  }
}

// Nothing, or a name that is no kind and no shelf.
std::string unknown_type(const std::vector<std::string>& types) {
  std::vector<std::string> known;
  for (const Shelf& shelf : catalogue()) {
    known.push_back(shelf.name);
    for (const KindDescription& kind : shelf.kinds) known.push_back(kind.type);
  }
  for (const std::string& type : types)
    if (std::ranges::find(known, type) == known.end())
      return type + ": there is no such kind" + did_you_mean(type, known) +
             "; `courant list` has all of them";
  return "";
}

void print_markdown(const Console& console) {
  for (const Shelf& shelf : catalogue()) console.out << marked_table(shelf) << '\n';
}

}  // namespace

void add_list(CLI::App& app, Session& session) {
  auto json = std::make_shared<bool>(false), markdown = std::make_shared<bool>(false);
  auto types = std::make_shared<std::vector<std::string>>();
  CLI::App* list = app.add_subcommand("list", "List what an experiment can be made of");
  CLI::Option* some = list->add_option(
      "KIND", *types,
      "only these: types, such as lagrangian, or all systems, elements, manifolds, …");
  CLI::Option* as_json = list->add_flag("--json", *json, "print JSON");
  list->add_flag("--markdown", *markdown, "print the tables of docs/experiment-format.md")
      ->excludes(as_json)
      ->excludes(some);
  as_json->excludes(some);
  list->callback([&session, json, markdown, types] {
    session.action = [json, markdown, types](const Console& console) -> int {
      if (const std::string what = unknown_type(*types); !what.empty()) {
        print_error(console, what);
        return wrong;
      }
      *json       ? print_json(console)
      : *markdown ? print_markdown(console)
                  : print_text(console, *types);
      return done;
    };
  });
}

}  // namespace courant::cli
