#include "courant/reading/new_experiment.hpp"

#include <algorithm>
#include <vector>

#include "courant/core/words/spelling.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/reading/catalogue.hpp"

namespace courant {
namespace {

constexpr std::size_t kColumns = 100;

const Shelf* shelf_of(const std::vector<Shelf>& catalogue, const std::string& noun) {
  const auto found = std::ranges::find(catalogue, noun, &Shelf::noun);
  return found == catalogue.end() ? nullptr : &*found;
}

const KindDescription* kind_of(const Shelf* shelf, const std::string& type) {
  if (shelf == nullptr) return nullptr;
  const auto found = std::ranges::find(shelf->kinds, type, &KindDescription::type);
  return found == shelf->kinds.end() ? nullptr : &*found;
}

// "a discretization (midpoint, exponential, …); default "midpoint": R_d".
std::string comment_on(const Key& key, const std::vector<Shelf>& catalogue) {
  std::string text = key.takes.text;
  for (const Shelf& shelf : catalogue)
    if (key.takes.text == "a " + shelf.noun)
      text += " (" + word_list(shelf.kinds, &KindDescription::type) + ")";
  if (key.required) text += "; required";
  if (!key.otherwise.is_null()) text += "; default " + key.otherwise.dump();
  return text + ": " + key.summary;
}

// An object of a kind with comments before its keys.
Json commented(const Json& object, const std::string& noun, const std::vector<Shelf>& catalogue) {
  const KindDescription* kind = kind_of(shelf_of(catalogue, noun), object.value("type", ""));
  if (kind == nullptr) return object;
  Json result{{"type", kind->type}, {"// type", kind->sentence()}};
  for (const bool used : {true, false})
    for (const Key& key : kind->keys) {
      if (object.contains(key.name) != used) continue;
      result["// " + key.name] = comment_on(key, catalogue);
      if (used) result[key.name] = object.at(key.name);
    }
  return result;
}

// The keys of an experiment beside system and method, in the order in which they are read.
constexpr std::pair<const char*, const char*> kFrame[] = {
    {"initial",
     "values by name, in full or in part: what is missing is found by the constraint algorithm; x' "
     "is the velocity of x, an array takes an array"},
    {"hold", "names of initial values that must not be moved to be consistent: [\"x\"]"},
    {"start", "\"nearest\": begins at the nearest consistent start, however far from these values"},
    {"nominal", "sizes of coordinates and unknowns that steps are measured by: {\"q_C1\": 1e-6}"},
    {"time", "step and end, numbers or formulas of the parameters: a whole number of steps"},
    {"events", "named formulas of the state whose zeros are found: passages, turning points"},
    {"observe", "named formulas of coordinates, momenta, velocities, unknowns and t: columns"},
    {"expect", "what must come out, or the run fails; every experiment should have some"},
    {"output",
     "every: steps a row, or at: times of rows; format: csv or npy; units and labels by name"}};

std::string inline_text(const Json& value) {
  if (value.is_object()) {
    std::string text;
    for (const auto& [key, entry] : value.items())
      text += (text.empty() ? " " : ", ") + Json(key).dump() + ": " + inline_text(entry);
    return "{" + text + (text.empty() ? "}" : " }");
  }
  if (value.is_array()) return "[" + word_list(value, inline_text) + "]";
  return value.dump();
}

bool has_comments(const Json& value) {
  return value.is_object() && std::ranges::any_of(value.items(), [](const auto& entry) {
           return entry.key().starts_with("//");
         });
}

void write(const Json& value, std::size_t indent, std::size_t begun, std::string& text) {
  const std::string line = inline_text(value);
  const bool is_flat = !value.is_structured() || value.empty();
  if (is_flat || (!has_comments(value) && begun + line.size() < kColumns && indent > 0)) {
    text += line;
    return;
  }
  const std::string inner(indent + 2, ' ');
  const char* separator = "\n";
  text += value.is_object() ? '{' : '[';
  for (const auto& [key, entry] : value.items()) {
    const std::string head = value.is_object() ? Json(key).dump() + ": " : "";
    text += separator + inner + head;
    write(entry, indent + 2, inner.size() + head.size(), text);
    separator = ",\n";
  }
  text += "\n" + std::string(indent, ' ') + (value.is_object() ? '}' : ']');
}

}  // namespace

std::string readable_json(const Json& value) {
  std::string text;
  write(value, 0, 0, text);
  return text + "\n";
}

std::string new_experiment(const std::string& type, bool in_formulas) {
  const std::vector<Shelf> shelves = catalogue();
  const Shelf* systems = shelf_of(shelves, "system");
  const KindDescription* kind = kind_of(systems, type);
  if (kind == nullptr) {
    std::vector<std::string> types;
    for (const KindDescription& one : systems->kinds) types.push_back(one.type);
    throw ExperimentError(type, "there is no such kind of system" + did_you_mean(type, types) +
                                    "; expected one of: " + word_list(types));
  }
  const Json& example = kind->example;
  if (example.is_null())
    throw ExperimentError(type, "has no example; `courant list` says what its keys take");
  if (in_formulas && kind->formulas.is_null())
    throw ExperimentError(
        type, "is no system of formulas alone; expected one of the catalogue, such as pendulum");
  Json result{{"//",
               "Keys that begin with // are comments. What a key takes stands before it; keys that "
               "are not used here are there as comments. courant check FILE, courant run FILE."}};
  result["title"] = example.at("title");
  result["system"] =
      commented(in_formulas ? kind->formulas : example.at("system"), "system", shelves);
  for (const auto& [key, comment] : kFrame) {
    if (std::string(key) == "time")
      result["method"] = commented(example.at("method"), "method", shelves);
    result["// " + std::string(key)] = comment;
    if (example.contains(key)) result[key] = example.at(key);
  }
  return readable_json(result);
}

}  // namespace courant
