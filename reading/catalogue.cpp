#include "courant/reading/catalogue.hpp"

#include <algorithm>

#include "courant/reading/method_kinds.hpp"
#include "courant/reading/network_element.hpp"
#include "courant/reading/space.hpp"
#include "courant/reading/structure_kinds.hpp"
#include "courant/reading/system_kinds.hpp"

namespace courant {

std::vector<Shelf> catalogue() {
  return {{"systems", "system", "A catalogue entry, or a description by formulas.",
           system_kinds().descriptions()},
          {"elements", "element", "An element of a network.", element_kinds().descriptions()},
          {"manifolds", "manifold", "A space.", manifold_kinds().descriptions()},
          {"structures", "structure", "A Dirac structure.", structure_kinds().descriptions()},
          {"methods", "method", "How the system is integrated.", method_kinds().descriptions()},
          {"discretizations", "discretization",
           "A discretization map; on a cotangent bundle the cotangent lift of that on the base.",
           discretization_kinds().descriptions()},
          {"projectors", "projector", "How points are brought to the final constraint set.",
           projector_kinds().descriptions()}};
}

std::vector<Key> common_keys(const Shelf& shelf) {
  constexpr std::size_t fewest = 3;
  if (shelf.kinds.size() < fewest) return {};
  std::vector<Key> common;
  for (const Key& key : shelf.kinds.front().keys) {
    const bool is_common = std::ranges::all_of(shelf.kinds, [&](const KindDescription& kind) {
      const Key* other = kind.find(key.name);
      return other != nullptr && other->takes.text == key.takes.text &&
             other->summary == key.summary && other->required == key.required &&
             other->otherwise == key.otherwise;
    });
    if (is_common) common.push_back(key);
  }
  return common;
}

Shelf without_common_keys(Shelf shelf) {
  const std::vector<Key> common = common_keys(shelf);
  for (KindDescription& kind : shelf.kinds)
    std::erase_if(kind.keys, [&](const Key& key) {
      return std::ranges::find(common, key.name, &Key::name) != common.end();
    });
  return shelf;
}

std::string marked_table(const Shelf& shelf) {
  std::string table = markdown_table(without_common_keys(shelf).kinds);
  if (const std::vector<Key> common = common_keys(shelf); !common.empty()) {
    const std::string any = "any";
    const std::string of_any = markdown_table({{.type = any, .summary = "", .keys = common}});
    const auto row = [&](const std::string& text, std::size_t lines) {
      std::size_t at = 0;
      while (lines-- > 0) at = text.find('\n', at) + 1;
      return at;
    };
    // Behind the head, without the row of a type.
    table.insert(row(table, 2), "| any of them | | |\n" + of_any.substr(row(of_any, 3)));
  }
  return "<!-- " + shelf.name + ", as courant list --markdown prints them -->\n" + table +
         "<!-- end of " + shelf.name + " -->\n";
}

Json experiment_schema(Json frame) {
  for (const Shelf& shelf : catalogue())
    frame["$defs"][shelf.noun] = schema_of(shelf.description, shelf.kinds);
  return frame;
}

}  // namespace courant
