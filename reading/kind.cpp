#include "courant/reading/kind.hpp"

#include <algorithm>

#include "courant/core/words/message.hpp"

namespace courant {
namespace {

Json reference(const std::string& definition) { return {{"$ref", "#/$defs/" + definition}}; }

Json described(Json schema, const std::string& description) {
  Json result = {{"description", description}};
  result.update(schema);
  return result;
}

}  // namespace

namespace takes {

Takes number() { return {"a number", {{"type", "number"}}}; }

Takes number(double least, double greatest) {
  return {"a number from " + exact_text(least) + " to " + exact_text(greatest),
          {{"type", "number"}, {"minimum", least}, {"maximum", greatest}}};
}

Takes integer(Index least) {
  return {"an integer, at least " + std::to_string(least),
          {{"type", "integer"}, {"minimum", least}}};
}

Takes integer(const std::vector<int>& values) {
  std::string list;
  for (std::size_t i = 0; i < values.size(); ++i)
    list += (i == 0 ? "" : i + 1 == values.size() ? " or " : ", ") + std::to_string(values[i]);
  return {std::move(list), {{"enum", values}}};
}

Takes text() { return {"a string", {{"type", "string"}}}; }

Takes word(std::vector<std::string> words) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i)
    list += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + ("\"" + words[i] + "\"");
  Json schema = {{"enum", words}};
  return {std::move(list), std::move(schema), std::move(words)};
}

Takes formula() { return {"a formula", reference("formula")}; }
Takes formulas() { return {"a formula, an array or a matrix of them", reference("formulas")}; }
Takes formula_vector() { return {"an array of formulas", reference("formulaVector")}; }
Takes formula_matrix() { return {"a matrix of formulas, by rows", reference("formulaMatrix")}; }
Takes components() {
  return {"formulas, or an object of them by coordinate",
          {{"anyOf", Json::array({reference("formulas"), reference("definitions")})}}};
}
Takes form_matrix() {
  return {"a matrix of formulas, by rows, or \"canonical\"",
          {{"anyOf", Json::array({reference("formulaMatrix"), Json{{"const", "canonical"}}})}}};
}
Takes metric(std::vector<std::string> words) {
  const Takes one = word(std::move(words)), matrix = formula_matrix();
  return {one.text + " or " + matrix.text, {{"oneOf", Json::array({one.schema, matrix.schema})}}};
}
Takes weights() {
  return {"an object of positive numbers",
          {{"type", "object"},
           {"patternProperties", {{"^//", true}}},
           {"additionalProperties", {{"type", "number"}, {"exclusiveMinimum", 0}}}}};
}
Takes brackets() {
  return {"an object of formulas by pairs",
          {{"type", "object"},
           {"patternProperties", {{"^//", true}}},
           {"additionalProperties", reference("formula")}}};
}
Takes field_rows() { return {"rows of formulas", reference("fieldRows")}; }
Takes number_matrices() { return {"an array of matrices of numbers", reference("numberMatrices")}; }
Takes representation(std::vector<std::string> words) {
  const Takes one = word(std::move(words)), matrices = number_matrices();
  return {one.text + " or " + matrices.text,
          {{"oneOf", Json::array({one.schema, matrices.schema})}}};
}
Takes coordinates() { return {"names", reference("coordinates")}; }
Takes names() { return {"names", reference("names")}; }
Takes parameters() { return {"an object of constants", reference("parameters")}; }
Takes tables() { return {"an object of tables", reference("tables")}; }
Takes definitions() { return {"an object of formulas", reference("definitions")}; }
Takes systems() {
  return {"an object of systems",
          {{"type", "object"},
           {"patternProperties", {{"^//", true}}},
           {"additionalProperties", reference("system")}}};
}
Takes joint() {
  return {"a joint",
          {{"type", "object"},
           {"patternProperties", {{"^//", true}}},
           {"properties",
            {{"ports", {{"type", "array"}, {"minItems", 1}, {"items", {{"type", "string"}}}}},
             {"shared", {{"enum", {"input", "output"}}}},
             {"matrix", reference("formulaMatrix")},
             {"F", reference("formulaMatrix")},
             {"E", reference("formulaMatrix")},
             {"input", reference("formula")}}},
           {"required", {"ports"}},
           {"additionalProperties", false}}};
}
Takes boundary_conditions() {
  return {"an object of conditions by region",
          {{"type", "object"},
           {"patternProperties", {{"^//", true}}},
           {"additionalProperties",
            {{"type", "object"},
             {"patternProperties", {{"^//", true}}},
             {"additionalProperties", reference("formulas")}}}}};
}
Takes repetition() { return {"an object of [first, last]", reference("repetition")}; }
Takes nodes() {
  return {"names, and {\"repeat\": …, \"name\": \"n{i}\"}",
          {{"type", "array"},
           {"minItems", 1},
           {"items",
            {{"anyOf",
              Json::array({{{"type", "string"}},
                           {{"type", "object"},
                            {"patternProperties", {{"^//", true}}},
                            {"properties",
                             {{"repeat", reference("repetition")}, {"name", {{"type", "string"}}}}},
                            {"required", {"repeat", "name"}},
                            {"additionalProperties", false}}})}}}}};
}
Takes kind(const std::string& noun) {
  const bool has_vowel =
      !noun.empty() && std::string_view("aeiou").find(noun[0]) != std::string_view::npos;
  return {(has_vowel ? "an " : "a ") + noun, reference(noun)};
}

Takes array_of(const Takes& entry, std::size_t least, std::optional<std::size_t> most) {
  Json schema = {{"type", "array"}};
  if (least > 0) schema["minItems"] = least;
  if (most) schema["maxItems"] = *most;
  schema["items"] = entry.schema;
  return {"an array, each entry " + entry.text, schema};
}

Takes one(const KindDescription& part) { return {"an object", part.schema()}; }

Takes named(const KindDescription& part) {
  return {"an object of objects",
          {{"type", "object"},
           {"patternProperties", {{"^//", true}}},
           {"additionalProperties", part.schema()}}};
}

Takes list_of(const KindDescription& part) {
  return {"an array of objects", {{"type", "array"}, {"items", part.schema()}}};
}

Takes flag() { return {"true or false", {{"type", "boolean"}}}; }

Takes pose() {
  return {
      "{\"xyz\": [x, y, z], \"rpy\": [r, p, y]}, in a plane [x, y, angle]",
      {{"anyOf",
        Json::array({reference("formulaVector"),
                     {{"type", "object"},
                      {"patternProperties", {{"^//", true}}},
                      {"properties",
                       {{"xyz", reference("formulaVector")}, {"rpy", reference("formulaVector")}}},
                      {"additionalProperties", false}}})}}};
}

Takes places() {
  return {"an object of positions",
          {{"type", "object"},
           {"patternProperties", {{"^//", true}}},
           {"additionalProperties", reference("formulaVector")}}};
}

Takes place_on_body() {
  return {"\"body.point\", \"body\", \"ground\" or a position on the ground",
          {{"anyOf", Json::array({{{"type", "string"}}, reference("formulaVector")})}}};
}

Takes structure_part() {
  return {"a structure on coordinates of its own", reference("structurePart")};
}

}  // namespace takes

Key required_key(std::string name, Takes takes, std::string summary) {
  return {std::move(name), std::move(takes), std::move(summary), true, nullptr};
}

Key optional_key(std::string name, Takes takes, std::string summary) {
  return {std::move(name), std::move(takes), std::move(summary), false, nullptr};
}

Key default_key(std::string name, Takes takes, Json otherwise, std::string summary) {
  return {std::move(name), std::move(takes), std::move(summary), false, std::move(otherwise)};
}

const Key* KindDescription::find(const std::string& key) const {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const Key& one) { return one.name == key; });
  return found == keys.end() ? nullptr : &*found;
}

std::string KindDescription::sentence() const {
  return reference.empty() ? summary : summary + " (" + reference + ")";
}

Json KindDescription::schema() const {
  Json required = Json::array(), properties = Json::object();
  if (!type.empty()) {
    required.push_back("type");
    properties["type"] = {{"const", type}};
  }
  for (const Key& key : keys) {
    if (key.required) required.push_back(key.name);
    Json& property = properties[key.name] = described(key.takes.schema, key.summary);
    if (!key.otherwise.is_null()) property["default"] = key.otherwise;
  }
  Json result = {{"description", sentence()},
                 {"type", "object"},
                 {"required", required},
                 {"additionalProperties", false},
                 {"patternProperties", {{"^//", true}}},
                 {"properties", properties}};
  for (const auto& names : one_of) {
    Json choices = Json::array();
    for (const std::string& name : names) choices.push_back({{"required", Json::array({name})}});
    result["allOf"].push_back({{"oneOf", choices}});
  }
  return result;
}

Json schema_of(const std::string& description, const std::vector<KindDescription>& kinds) {
  Json alternatives = Json::array();
  Json words = Json::array();
  for (const KindDescription& kind : kinds) {
    const bool needs_a_key =
        !kind.one_of.empty() || std::any_of(kind.keys.begin(), kind.keys.end(),
                                            [](const Key& key) { return key.required; });
    if (!needs_a_key) words.push_back(kind.type);
  }
  if (!words.empty()) alternatives.push_back({{"enum", words}});
  for (const KindDescription& kind : kinds) alternatives.push_back(kind.schema());
  return {{"description", description}, {"oneOf", alternatives}};
}

std::string markdown_table(const std::vector<KindDescription>& kinds) {
  const auto escaped = [](std::string text) {
    for (std::size_t at = 0; (at = text.find_first_of("|*", at)) != std::string::npos; at += 2)
      text.insert(at, "\\");
    return text;
  };
  std::string table = "| `type` | key: what it takes | |\n|---|---|---|\n";
  for (const KindDescription& kind : kinds) {
    table += "| `" + kind.type + "` | | " + escaped(kind.sentence()) + " |\n";
    for (const Key& key : kind.keys) {
      std::string takes = key.takes.text;
      if (key.required) takes += "; required";
      if (!key.otherwise.is_null()) takes += "; default `" + key.otherwise.dump() + "`";
      table += "| | `" + key.name + "`: " + escaped(takes) + " | " + escaped(key.summary) + " |\n";
    }
  }
  return table;
}

}  // namespace courant
