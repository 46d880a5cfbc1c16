#include "courant/reporting/report_tables.hpp"

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "courant/plotting/scale.hpp"

namespace courant {

namespace {

using Json = nlohmann::ordered_json;
using plot::element;
using plot::Markup;

constexpr const char* missing = "–";

// A value of a summary: a number to some digits, a text as it is, a list as JSON, a dash for what
// is not there.
std::string shown(const Json* value, int digits) {
  if (value == nullptr || value->is_null()) return missing;
  if (value->is_string()) return value->get<std::string>();
  if (value->is_boolean()) return value->get<bool>() ? "true" : "false";
  if (value->is_number_integer() || value->is_structured()) return value->dump();
  return plot::readable(value->get<double>(), digits);
}

const Json* find(const Json& object, std::initializer_list<const char*> path) {
  const Json* at = &object;
  for (const char* key : path) {
    if (!at->is_object()) return nullptr;
    const auto found = at->find(key);
    if (found == at->end()) return nullptr;
    at = &*found;
  }
  return at;
}

Markup number(const Json& object, std::initializer_list<const char*> path, int digits) {
  return element("td", {{"class", "number"}}, shown(find(object, path), digits));
}

Markup words(const Markup& content) { return element("td", {}, content); }

Markup column_heads(std::initializer_list<const char*> texts) {
  Markup heads;
  for (const char* text : texts) heads += element("th", {{"scope", "col"}}, text);
  return heads;
}

Markup row_head(const Markup& content) { return element("th", {{"scope", "row"}}, content); }

Markup table(std::string_view caption, const Markup& head, const Markup& rows) {
  return element(
      "div", {{"class", "scroll"}},
      element("table", {},
              element("caption", {}, caption) + element("thead", {}, element("tr", {}, head)) +
                  element("tbody", {}, rows)));
}

}  // namespace

Markup runs_table(std::span<const Run> runs, std::span<const std::string> labels) {
  Markup heads = element("th", {{"scope", "col"}}, "");
  for (const std::string& label : labels) heads += element("th", {{"scope", "col"}}, label);
  Markup rows;
  const auto row = [&](std::string_view head, const auto& cell) {
    Markup cells = row_head(head);
    for (const Run& run : runs) cells += cell(run);
    rows += element("tr", {}, cells);
  };
  const auto numbers = [&](std::string_view head, std::initializer_list<const char*> path,
                           int digits) {
    row(head, [&](const Run& run) { return number(run.summary, path, digits); });
  };
  row("folder", [](const Run& run) { return words(run.name); });
  row("status", [](const Run& run) {
    const std::string status = run.summary.at("status");
    return element("td", {{"class", status == "completed" ? "good" : "bad"}}, status);
  });
  numbers("steps", {"steps"}, 6);
  numbers("step h", {"time", "step"}, 6);
  numbers("greatest |H − H(0)|", {"observables", "H", "max_drift"}, 4);
  numbers("greatest constraint violation", {"constraints", "max_violation"}, 3);
  numbers("iterations a step", {"solver", "iterations_per_step"}, 3);
  numbers("factorisations a step", {"solver", "factorizations_per_step"}, 3);
  numbers("solver failures", {"solver", "failures"}, 6);
  numbers("steps with a second attempt", {"solver", "second_attempts"}, 6);
  numbers("steps confirmed by continuation", {"solver", "confirmations"}, 6);
  row("backend", [](const Run& run) { return words(shown(find(run.summary, {"backend"}), 6)); });
  numbers("wall time in seconds", {"wall_seconds"}, 3);
  numbers("steps a second", {"steps_per_second"}, 3);
  return table("Runs and solver statistics", heads, rows);
}

Markup observables_table(std::span<const Run> runs, std::span<const std::string> labels) {
  std::vector<std::string> names;
  for (const Run& run : runs) {
    const Json* observables = find(run.summary, {"observables"});
    if (observables == nullptr) continue;
    for (const auto& [name, values] : observables->items()) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  Markup rows;
  for (const std::string& name : names) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const Json* values = find(runs[i].summary, {"observables", name.c_str()});
      if (values == nullptr) continue;
      Markup cells = row_head(name) + words(labels[i]);
      for (const char* key : {"initial", "final", "min", "max"}) cells += number(*values, {key}, 7);
      cells += number(*values, {"max_drift"}, 4);
      rows += element("tr", {}, cells);
    }
  }
  if (rows.str().empty()) return {};
  return table("Observables",
               column_heads({"Observable", "Run", "Initial", "Final", "Least", "Greatest",
                             "Greatest drift"}),
               rows);
}

Markup expectations_table(std::span<const Run> runs, std::span<const std::string> labels) {
  Markup rows;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Json* expectations = find(runs[i].summary, {"expectations"});
    if (expectations == nullptr) continue;
    for (const Json& expectation : *expectations) {
      const bool passed = expectation.at("passed");
      const std::string description = expectation.at("description");
      Markup cells = row_head(description) + words(labels[i]);
      cells += number(expectation, {"value"}, 6) + number(expectation, {"bound"}, 6);
      cells +=
          element("td", {{"class", passed ? "good" : "bad"}}, passed ? "✓ passed" : "✗ failed");
      rows += element("tr", {}, cells);
    }
  }
  if (rows.str().empty()) return {};
  return table("Expectations of the experiment",
               column_heads({"Expectation", "Run", "Value", "Bound", "Result"}), rows);
}

Markup ladder_table(const Json& ladder) {
  Markup rows;
  for (const Json& level : ladder.at("levels")) {
    Markup cells;
    for (const char* key : {"k", "dim_S", "dim_M", "fibre"}) cells += number(level, {key}, 6);
    cells += number(level, {"gap"}, 2) + number(level, {"residual"}, 2);
    rows += element("tr", {}, cells);
  }
  return table("Levels",
               column_heads({"k", "dim S", "dim M", "Fibre", "Gap of the rank", "Residual"}), rows);
}

}  // namespace courant
