#include "courant/reporting/report_head.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "courant/core/language/formula_tree.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/text_layout.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/reporting/prose_typesetting.hpp"
#include "courant/reporting/typesetting.hpp"

namespace courant {
namespace {

using plot::element;
using plot::Markup;
using Json = nlohmann::ordered_json;

constexpr std::size_t kMostLines = 40, kUnfolded = 12, kMostLetters = 1000, kLettersOfMatrix = 160;

// The object with that name, or one without members.
Json members(const Json& object, const std::string& key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_object() ? *found : Json::object();
}

std::string dumped(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// A formula or a number as it is written, an array of them as JSON has it; "" for anything else and for what is too
// long.
std::string written(const Json& value) {
  if (!value.is_string() && !value.is_number() && !value.is_array()) return "";
  std::string text = value.is_string() ? value.get<std::string>() : dumped(value);
  return text.size() > kMostLetters ? "" : text;
}

// name = value, or both as words where that is no formula, as the name of a file; nothing where it is too long.
std::optional<Prose> named(const std::string& name, const Json& value) {
  const std::string text = written(value);
  if (text.empty()) return std::nullopt;
  if (value.is_array() || formula_tree(text)) return Prose::formula(name + " = " + text);
  return Prose(name + " " + text);
}

// "left: v = 0": what is said of a part, a boundary or an interval.
std::optional<Prose> of_part(const std::string& name, const Json& said) {
  Prose line = name + ": ";
  bool is_first = true;
  for (const auto& [key, value] : said.items()) {
    const auto one = named(key, value);
    if (!one) return std::nullopt;
    line += (std::exchange(is_first, false) ? Prose() : Prose(", ")) + *one;
  }
  return line;
}

// heat_conductivity is a key, heat conductivity what it means.
std::string in_words(std::string key) {
  std::ranges::replace(key, '_', ' ');
  return key;
}

// A name, set as a formula where it can be read as one.
Prose set_name(const std::string& name) {
  return formula_tree(name) ? Prose::formula(name) : Prose(name);
}

// R[3][3] declares a matrix and is none of its entries: R (3 × 3).
Prose declared(const std::string& name) {
  const std::size_t at = name.find('[');
  if (at == std::string::npos || !name.ends_with(']')) return set_name(name);
  std::string sizes = name.substr(at + 1, name.size() - at - 2);
  for (std::size_t next; (next = sizes.find("][")) != std::string::npos;)
    sizes.replace(next, 2, " × ");
  return set_name(name.substr(0, at)) + " (" + set_name(sizes) + ")";
}

// "resistor R1 from a to b: value = R", an element of a network; nothing for anything else.
std::optional<Prose> element_in_words(const Json& element) {
  constexpr std::string_view places[] = {"name", "from", "to", "at"};
  if (!element.is_object() || !element.contains("type")) return std::nullopt;
  Prose text = written(element.at("type"));
  for (const std::string_view place : places)
    if (const auto found = element.find(place); found != element.end() && found->is_string())
      text += Prose(place == "name" ? " " : " " + std::string(place) + " ") +
              set_name(found->get<std::string>());
  bool is_first = true;
  for (const auto& [key, value] : element.items()) {
    if (key == "type" || std::ranges::count(places, key) > 0) continue;
    const std::string told = value.is_array() ? "" : written(value);
    if (told.empty()) return std::nullopt;
    text += Prose((std::exchange(is_first, false) ? ": " : ", ") + in_words(key) + " ") +
            set_name(told);
  }
  return text;
}

// A line of an entry: words, or a formula, with = 0 where it is an equation, or L = in front.
Prose model_line(const std::string& key, const std::string& text) {
  static constexpr std::string_view words[] = {
      "structure", "nodes",      "ports",    "elements",  "form",          "algebra",
      "attitude",  "port_names", "advected", "extremals", "representation"};
  static constexpr std::string_view equations[] = {"holonomic", "nonholonomic", "equations"};
  static const std::map<std::string_view, std::string_view> names = {
      {"lagrangian", "L"}, {"hamiltonian", "H"}, {"potential", "V"}};
  if (std::ranges::count(words, key) > 0) return {text};
  if (std::ranges::count(equations, key) > 0 && text.find('=') == std::string::npos)
    return Prose::formula(text + " = 0");
  if (const auto found = names.find(key); found != names.end())
    return Prose::formula(std::string(found->second) + " = " + text);
  return Prose::formula(text);
}

// A matrix that is wider than a page: its entries that are not 0, each with its place. None where that cannot be said.
std::vector<Prose> entries_of(const std::string& name, const Json& matrix) {
  std::vector<Prose> lines;
  for (std::size_t i = 0; i < matrix.size(); ++i)
    for (std::size_t j = 0; matrix[i].is_array() && j < matrix[i].size(); ++j) {
      const Json& entry = matrix[i][j];
      if (entry == 0) continue;
      const auto line =
          named(name + "[" + std::to_string(i) + "][" + std::to_string(j) + "]", entry);
      if (!line || entry.is_array()) return {};
      lines.push_back(*line);
    }
  return lines;
}

// The lines that say what stands under a key; none where something of it cannot be said in lines.
std::vector<Prose> lines_of(const std::string& key, const Json& value) {
  constexpr std::string_view lists[] = {"nodes", "states", "efforts", "controls"};
  std::vector<Prose> lines;
  bool is_whole = true;
  const auto add = [&](std::optional<Prose> line) {
    is_whole = is_whole && line.has_value();
    if (line) lines.push_back(*std::move(line));
  };
  if (std::ranges::count(lists, key) > 0 && value.is_array()) {
    Prose names;
    for (const Json& name : value) {
      is_whole = is_whole && name.is_string();
      if (!is_whole) break;
      names += (names.parts().empty() ? Prose() : Prose(", ")) + declared(name.get<std::string>());
    }
    if (value.size() <= kMostLines && !value.empty()) lines.push_back(std::move(names));
  } else if (value.is_object()) {
    for (const auto& [name, said] : value.items()) {
      if (name == "type" && said.is_string())
        lines.emplace_back(written(said));
      else if (const std::string density = key == "energy" ? written(said) : ""; !density.empty())
        // Not an equation for the state that it is the energy of.
        lines.push_back("of " + Prose::formula(name) + ": " + Prose::formula(density));
      else
        add(said.is_object() ? of_part(name, said) : named(name, said));
    }
  } else if (value.is_array() && !value.empty() && value.front().is_object()) {
    for (const Json& element : value) add(element_in_words(element));
  } else if (value.is_array() && !value.empty() && value.front().is_array()) {
    if (dumped(value).size() <= kLettersOfMatrix)
      add(named(key, value));
    else
      lines = entries_of(key, value);
    is_whole = !lines.empty();
  } else {
    for (const Json& line : value.is_array() ? value : Json::array({value}))
      if (const std::string text = line.is_array() ? "" : written(line); !text.empty())
        lines.push_back(model_line(key, text));
      else
        is_whole = false;
  }
  if (!is_whole || lines.size() > kMostLines) lines.clear();
  return lines;
}

Markup entry(const std::string& name, const Markup& content) {
  return element("dt", {}, name) + element("dd", {}, content);
}

// "completed, 4000 steps", or how many runs have which status.
Markup status(std::span<const Run> runs) {
  std::map<RunStatus, std::size_t> counts;
  for (const Run& run : runs) ++counts[run.summary.status];
  Markup all;
  for (const auto& [status, count] : counts) {
    std::string text = to_string(status);
    if (counts.size() > 1 || count > 1) text = std::to_string(count) + " " + text;
    if (!all.str().empty()) all += ", ";
    all += element("span", {{"class", status == RunStatus::completed ? "good" : "bad"}}, text);
  }
  if (runs.size() == 1) all += ", " + std::to_string(runs[0].summary.steps) + " steps";
  return entry("status", all);
}

}  // namespace

std::vector<ModelEntry> model_entries(const nlohmann::ordered_json& experiment) {
  constexpr std::string_view no_formulas[] = {"type", "manifold", "coordinates", "unknowns",
                                              "parameters"};
  std::vector<ModelEntry> entries;
  ModelEntry parameters = {"parameters", {}};
  bool is_whole = true;
  const auto add_parameter = [&](const std::string& name, const Json& value) {
    if (const auto line = named(name, value))
      parameters.lines.push_back(*line);
    else
      is_whole = false;
  };
  const Json system = members(experiment, "system");
  for (const auto& [key, value] : system.items()) {
    if (std::ranges::count(no_formulas, key) > 0) continue;
    const Json* first = &value;
    while (first->is_array() && !first->empty()) first = &first->front();
    if (!first->is_string() && !first->is_object())
      add_parameter(key, value);
    else if (auto lines = lines_of(key, value); !lines.empty())
      entries.push_back({in_words(key), std::move(lines)});
    else
      is_whole = false;
  }
  for (const Json& given : {members(experiment, "parameters"), members(system, "parameters")})
    for (const auto& [name, value] : given.items()) add_parameter(name, value);
  if (parameters.lines.size() > kMostLines) parameters.lines.clear(), is_whole = false;
  if (!parameters.lines.empty()) entries.push_back(std::move(parameters));
  if (!is_whole) entries.push_back({"and more", {"in the experiment"}});
  return entries;
}

Markup model_markup(const std::vector<ModelEntry>& entries) {
  Markup all;
  std::size_t count = 0;
  for (const auto& [name, lines] : entries) {
    Markup content;
    for (const Prose& line : lines) content += displayed_prose(line);
    all += entry(name, content);
    count += lines.size();
  }
  const Markup list = element("dl", {{"class", "model"}}, all);
  if (count <= kUnfolded) return list;
  return element("details", {},
                 element("summary", {}, counted(static_cast<Index>(count), "formula")) + list);
}

Markup report_head(std::span<const Run> runs) {
  std::vector<std::string> systems;
  for (const Run& run : runs)
    if (std::ranges::count(systems, run.summary.system) == 0) systems.push_back(run.summary.system);
  std::string text = word_list(systems);
  text += runs.size() == 1 ? " — one run" : " — " + std::to_string(runs.size()) + " runs";

  const Markup entries = status(runs);
  const Json& first = runs.front().experiment;
  const auto is_the_same = [&](const Run& run) {
    for (const char* key : {"system", "parameters"})
      if (members(run.experiment, key) != members(first, key)) return false;
    return true;
  };
  return element("p", {{"class", "lead"}}, typeset_manifolds(text)) +
         element("dl", {{"class", "model"}}, entries) +
         (std::ranges::all_of(runs, is_the_same) ? model_markup(model_entries(first)) : Markup());
}

}  // namespace courant
