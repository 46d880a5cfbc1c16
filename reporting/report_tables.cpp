#include "courant/reporting/report_tables.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "courant/plotting/scale.hpp"
#include "courant/reporting/energy_figures.hpp"

namespace courant {

namespace {

using Json = nlohmann::ordered_json;
using plot::element;
using plot::Markup;

constexpr const char* missing = "–";

// A number to some digits; a dash where it is not known.
std::string shown(double value, int digits) {
  return std::isnan(value) ? missing : plot::readable(value, digits);
}
std::string shown(std::optional<long> value, int /*digits*/) {
  return value ? std::to_string(*value) : missing;
}
// What an expectation is about: a number, a text as it is, a list as JSON.
std::string shown(const Json& value, int digits) {
  if (value.is_null()) return missing;
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  if (value.is_number_integer() || value.is_structured()) return value.dump();
  return shown(value.get<double>(), digits);
}

template <class Value>
Markup number(const Value& value, int digits) {
  return element("td", {{"class", "number"}}, shown(value, digits));
}

Markup words(const Markup& content) { return element("td", {}, content); }

Markup column_heads(std::initializer_list<const char*> texts) {
  Markup heads;
  for (const char* text : texts) heads += element("th", {{"scope", "col"}}, text);
  return heads;
}

// Which run a row is of is told where there are several.
Markup heads_by_run(const char* first, std::span<const Run> runs) {
  return runs.size() > 1 ? column_heads({first, "Run"}) : column_heads({first});
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
  const auto numbers = [&](std::string_view head, const auto& value, int digits) {
    row(head, [&](const Run& run) { return number(value(run.summary), digits); });
  };
  row("folder", [](const Run& run) { return words(run.name); });
  row("status", [](const Run& run) {
    const RunStatus status = run.summary.status;
    return element("td", {{"class", status == RunStatus::completed ? "good" : "bad"}},
                   to_string(status));
  });
  using Of = const RunSummary&;
  static constexpr double unknown = RunSummary::kUnknown;
  numbers(
      "steps", [](Of run) { return std::optional(run.steps); }, 6);
  numbers(
      "step h", [](Of run) { return run.time ? run.time->step : unknown; }, 6);
  numbers(
      "greatest |H − H(0)|",
      [](Of run) {
        const QuantityRecord* H = run.observable("H");
        return H ? H->max_drift : unknown;
      },
      4);
  if (std::ranges::any_of(runs, [](const Run& run) { return energy_trend(run).has_value(); }))
    row("energy error", [](const Run& run) {
      const auto trend = energy_trend(run);
      return words(trend ? word(trend->growth) : missing);
    });
  numbers(
      "greatest constraint violation", [](Of run) { return run.max_violation.value_or(unknown); },
      3);
  numbers(
      "iterations a step", [](Of run) { return run.solver.iterations_per_step; }, 3);
  numbers(
      "factorisations a step", [](Of run) { return run.solver.factorizations_per_step; }, 3);
  numbers(
      "solver failures", [](Of run) { return run.solver.failures; }, 6);
  numbers(
      "steps with a second attempt", [](Of run) { return run.solver.second_attempts; }, 6);
  numbers(
      "steps confirmed by continuation", [](Of run) { return run.solver.confirmations; }, 6);
  if (std::ranges::any_of(
          runs, [](const Run& run) { return run.summary.solver.divisions.value_or(0) > 0; }))
    numbers(
        "steps made in halves", [](Of run) { return run.solver.divisions; }, 6);
  row("backend", [](const Run& run) {
    return words(run.summary.backend.empty() ? missing : run.summary.backend);
  });
  numbers(
      "wall time in seconds", [](Of run) { return run.wall_seconds; }, 3);
  numbers(
      "processor time in seconds", [](Of run) { return run.cpu_seconds; }, 3);
  numbers(
      "steps a second", [](Of run) { return run.steps_per_second; }, 3);
  return table("Runs and solver statistics", heads, rows);
}

Markup observables_table(std::span<const Run> runs, std::span<const std::string> labels) {
  std::vector<std::string> names;
  for (const Run& run : runs)
    for (const auto& [name, record] : run.summary.observables)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  Markup rows;
  for (const std::string& name : names) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const QuantityRecord* record = runs[i].summary.observable(name);
      if (!record) continue;
      Markup cells = row_head(name);
      if (runs.size() > 1) cells += words(labels[i]);
      for (const double value : {record->initial, record->final, record->min, record->max})
        cells += number(value, 7);
      cells += number(record->max_drift, 4);
      rows += element("tr", {}, cells);
    }
  }
  if (rows.str().empty()) return {};
  const Markup heads = heads_by_run("Observable", runs) +
                       column_heads({"Initial", "Final", "Least", "Greatest", "Greatest drift"});
  return table("Observables", heads, rows);
}

Markup expectations_table(std::span<const Run> runs, std::span<const std::string> labels) {
  Markup failures, passes;
  std::size_t failed = 0, all = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (const ExpectationResult& expectation : runs[i].summary.expectations) {
      const bool passed = expectation.passed;
      Markup cells = row_head(expectation.description);
      if (runs.size() > 1) cells += words(labels[i]);
      cells += number(expectation.value, 6) + number(expectation.bound, 6);
      cells +=
          element("td", {{"class", passed ? "good" : "bad"}}, passed ? "✓ passed" : "✗ failed");
      (passed ? passes : failures) += element("tr", {}, cells);
      ++all;
      failed += passed ? 0 : 1;
    }
  }
  if (all == 0) return {};
  const auto listed = [&](std::string_view caption, const Markup& rows) {
    return table(caption,
                 heads_by_run("Expectation", runs) + column_heads({"Value", "Bound", "Result"}),
                 rows);
  };
  const std::string count = std::to_string(all - failed) + " of " + std::to_string(all);
  Markup section = element("p", {},
                           element("span", {{"class", failed == 0 ? "good" : "bad"}}, count) +
                               (all == 1 ? " expectation passed." : " expectations passed."));
  if (failed > 0) section += listed("What failed", failures);
  if (failed < all)
    section +=
        element("details", {},
                element("summary", {}, "What passed") + listed("Expectations that passed", passes));
  return section;
}

Markup ladder_table(const LadderReport& ladder) {
  Markup rows;
  for (const LadderReport::Level& level : ladder.levels) {
    Markup cells = number(std::optional(level.k), 6);
    for (const auto& dimension : {level.dim_S, level.dim_M, level.fibre})
      cells += number(dimension, 6);
    cells += number(level.gap, 2) + number(level.residual, 2);
    rows += element("tr", {}, cells);
  }
  return table("Levels",
               column_heads({"k", "dim S", "dim M", "Fibre", "Gap of the rank", "Residual"}), rows);
}

}  // namespace courant
