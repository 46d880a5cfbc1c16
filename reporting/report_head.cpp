#include "courant/reporting/report_head.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "courant/core/words/word_list.hpp"
#include "courant/reporting/prose_typesetting.hpp"
#include "courant/reporting/typesetting.hpp"

namespace courant {
namespace {

using plot::element;
using plot::Markup;
using Json = nlohmann::ordered_json;

constexpr std::size_t kMostEntries = 12, kMostLetters = 300;

// The object with that name, or one without members.
Json members(const Json& object, const std::string& key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_object() ? *found : Json::object();
}

// A formula or a number as it is written; "" for anything else and for what is too long.
std::string written(const Json& value) {
  if (!value.is_string() && !value.is_number()) return "";
  const std::string text = value.is_string()
                               ? value.get<std::string>()
                               : value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() > kMostLetters ? "" : text;
}

std::vector<std::string> formulas(const Json& value) {
  std::vector<std::string> result;
  if (!value.is_array()) {
    result.push_back(written(value));
  } else {
    for (const Json& entry : value) result.push_back(written(entry));
  }
  if (std::ranges::count(result, "") > 0 || result.size() > kMostEntries) result.clear();
  return result;
}

// "resistor R1 from a to b value R": an element of a network. "" for anything else.
std::string element_in_words(const Json& element) {
  if (!element.is_object() || !element.contains("type")) return "";
  std::string text = written(element.at("type"));
  if (element.contains("name")) text += " " + written(element.at("name"));
  for (const auto& [key, value] : element.items()) {
    if (key == "type" || key == "name") continue;
    const std::string told = written(value);
    if (told.empty()) return "";
    text += " " + key + " " + told;
  }
  return text;
}

// What is no formula, and short: names, elements of a network, a structure of one word.
std::vector<std::string> told_in_words(const Json& value) {
  if (value.is_object())
    return value.size() == 1 && value.contains("type") ? formulas(value.at("type"))
                                                       : std::vector<std::string>();
  std::vector<std::string> lines;
  for (const Json& element : value) lines.push_back(element_in_words(element));
  if (std::ranges::count(lines, "") > 0 || lines.size() > kMostEntries) lines.clear();
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
  constexpr std::string_view no_formulas[] = {"type", "manifold", "coordinates", "unknowns"};
  std::vector<ModelEntry> entries;
  ModelEntry parameters = {"parameters", {}};
  bool is_whole = true;
  const auto add_parameter = [&](const std::string& name, const Json& value) {
    const std::string text = value.is_array()
                                 ? value.dump(-1, ' ', false, Json::error_handler_t::replace)
                                 : written(value);
    if (!text.empty() && text.size() <= kMostLetters)
      parameters.formulas.push_back(name + " = " + text);
    else
      is_whole = false;
  };
  const Json system = members(experiment, "system");
  for (const auto& [key, value] : system.items()) {
    if (std::ranges::count(no_formulas, key) > 0) continue;
    const bool is_text =
        value.is_string() || (value.is_array() && !value.empty() && value.front().is_string());
    const bool is_object =
        value.is_object() || (value.is_array() && !value.empty() && value.front().is_object());
    if (key == "nodes" && is_text && value.size() <= kMostEntries)
      entries.push_back({key, {word_list(formulas(value))}});
    else if (!is_text && !is_object)
      add_parameter(key, value);
    else if (auto lines = is_object ? told_in_words(value) : formulas(value); !lines.empty())
      entries.push_back({key, std::move(lines)});
    else
      is_whole = is_whole && key == "parameters";
  }
  for (const Json& given : {members(experiment, "parameters"), members(system, "parameters")})
    for (const auto& [name, value] : given.items()) add_parameter(name, value);
  if (parameters.formulas.size() > kMostEntries) parameters.formulas.clear(), is_whole = false;
  if (entries.size() > kMostEntries) entries.resize(kMostEntries), is_whole = false;
  if (!parameters.formulas.empty()) entries.push_back(std::move(parameters));
  if (!is_whole) entries.push_back({"and more", {}});
  return entries;
}

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

Markup report_head(std::span<const Run> runs) {
  std::vector<std::string> systems;
  for (const Run& run : runs)
    if (std::ranges::count(systems, run.summary.system) == 0) systems.push_back(run.summary.system);
  std::string text = word_list(systems);
  text += runs.size() == 1 ? " — one run" : " — " + std::to_string(runs.size()) + " runs";

  Markup entries = status(runs);
  const Json& first = runs.front().experiment;
  const auto is_the_same = [&](const Run& run) {
    for (const char* key : {"system", "parameters"})
      if (members(run.experiment, key) != members(first, key)) return false;
    return true;
  };
  if (std::ranges::all_of(runs, is_the_same))
    for (const auto& [name, lines] : model_entries(first)) {
      Markup content;
      for (const std::string& line : lines) content += displayed_prose(model_line(name, line));
      if (lines.empty()) content = "in the experiment at the end of this page";
      entries += entry(name, content);
    }
  return element("p", {{"class", "lead"}}, typeset_manifolds(text)) +
         element("dl", {{"class", "model"}}, entries);
}

}  // namespace courant
