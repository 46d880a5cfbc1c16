#include "courant/running/sweep.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <mutex>
#include <new>

#include "courant/core/numbers/parallel.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/running/comma_separated.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/ladder_report.hpp"
#include "courant/running/runner.hpp"

namespace courant {
namespace {

using Clock = std::chrono::steady_clock;

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// "theta=0.2" of "/method/theta": what a folder may be called.
std::string name_of(const Setting& setting) {
  std::string name =
      setting.pointer.substr(setting.pointer.rfind('/') + 1) + "=" + text_of(setting.value);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 &&
        std::string_view(".=+-_").find(c) == std::string_view::npos)
      c = '_';
  return name;
}

std::string name_of(std::size_t number, std::size_t count, const std::vector<Setting>& settings) {
  constexpr std::size_t longest = 80;
  std::string name = std::to_string(number);
  name.insert(0, std::to_string(count).size() - name.size(), '0');
  const char* separator = "-";
  for (const Setting& setting : settings) {
    name += separator + name_of(setting);
    separator = ",";
  }
  return name.substr(0, longest);
}

Json settings_json(const SweepCase& one) {
  Json json = Json::object();
  for (const Setting& setting : one.settings) json[setting.pointer] = setting.value;
  return json;
}

// What the action gives, or what it throws.
Json outcome(const SweepCase& one, const std::function<Json(const SweepCase&)>& action) {
  const auto ended = [](const char* status, std::string message) {
    return Json{{"status", status}, {"message", std::move(message)}, {"values", Json::object()}};
  };
  try {
    return action(one);
  } catch (const ExperimentError& error) {
    const Problem& first = error.problems().front();
    const std::size_t more = error.problems().size() - 1;
    return ended("wrong", first.where + (first.where.empty() ? "" : ": ") + first.what +
                              (more == 0 ? "" : " (and " + std::to_string(more) + " more)"));
  } catch (const std::bad_alloc&) {
    return ended("failed", "takes more memory than there is");
  } catch (const std::exception& error) {
    return ended("failed", without_place(error.what()));
  }
}

}  // namespace

std::vector<SweepCase> sweep_cases(const Json& document, std::span<const ValueRange> ranges) {
  std::vector<SweepCase> cases;
  const auto all = combinations(ranges);
  for (const auto& settings : all) {
    SweepCase one{settings, name_of(cases.size() + 1, all.size(), settings), document};
    for (const Setting& setting : settings) apply_setting(setting, one.document, "--sweep");
    cases.push_back(std::move(one));
  }
  return cases;
}

Json sweep(std::span<const ValueRange> ranges, std::span<const SweepCase> cases,
           const std::function<Json(const SweepCase&)>& action, const SweepOptions& options) {
  Json table{{"status", "running"}, {"sweep", Json::array()}, {"runs", Json::array()}};
  for (const ValueRange& range : ranges)
    table["sweep"].push_back({{"pointer", range.pointer}, {"values", range.values}});
  for (const SweepCase& one : cases)
    table["runs"].push_back({{"folder", one.name},
                             {"settings", settings_json(one)},
                             {"status", "interrupted"},
                             {"message", "did not begin"},
                             {"values", Json::object()}});
  std::mutex mutex;
  std::size_t ended = 0;
  auto written = Clock::now();
  const auto write = [&] {
    if (options.folder) options.folder->write(table, sweep_csv(table));
    written = Clock::now();
  };
  write();
  in_parallel(cases.size(), options.threads, [&](std::size_t i) {
    if (options.stop && *options.stop) return;
    Json entry = outcome(cases[i], action);
    const std::scoped_lock lock(mutex);
    Json& row = table["runs"][i];
    row["folder"] = "";
    row.update(entry);
    ++ended;
    // The table grows with the number of its cases, and is written as a whole.
    constexpr auto often = std::chrono::seconds(2);
    if (Clock::now() - written > often) write();
    if (options.on_progress) options.on_progress(ended, cases.size());
  });
  for (Json& row : table["runs"])
    if (row["message"] == "did not begin") row["folder"] = "";
  const bool interrupted = std::ranges::any_of(
      table["runs"], [](const Json& row) { return row["status"] == "interrupted"; });
  table["status"] = interrupted ? "interrupted" : "completed";
  write();
  return table;
}

std::string sweep_csv(const Json& table) {
  std::vector<std::string> values;
  for (const Json& row : table.at("runs"))
    for (const auto& [name, value] : row.at("values").items())
      if (std::ranges::find(values, name) == values.end()) values.push_back(name);
  std::string csv = "folder";
  for (const Json& range : table.at("sweep")) csv += "," + csv_cell(range.at("pointer"));
  csv += ",status";
  for (const std::string& name : values) csv += "," + csv_cell(name);
  csv += ",message\n";
  for (const Json& row : table.at("runs")) {
    csv += csv_cell(row.at("folder"));
    for (const auto& [pointer, value] : row.at("settings").items()) csv += "," + csv_cell(value);
    csv += "," + csv_cell(row.at("status"));
    for (const std::string& name : values)
      csv += "," + csv_cell(row.at("values").value(name, Json()));
    csv += "," + csv_cell(row.at("message")) + "\n";
  }
  return csv;
}

Json run_of_case(const SweepCase& one, const std::filesystem::path& folder, Backend backend,
                 const std::atomic<bool>* stop) {
  const Experiment experiment = read_experiment_document(one.document);
  const RunOutcome outcome = run(experiment, {.folder = folder / one.name,
                                              .backend = backend,
                                              .stop = stop,
                                              .on_ladder = {},
                                              .on_progress = {},
                                              .ahead = false});  // other cases run meanwhile
  const RunSummary& summary = outcome.summary;
  std::string message = outcome.message;
  const auto failures = std::ranges::count_if(
      outcome.expectations, [](const ExpectationResult& result) { return !result.passed; });
  if (message.empty())
    for (const ExpectationResult& result : outcome.expectations)
      if (!result.passed && message.empty())
        message = result.pointer + ": " + result.description + ": " + result.finding;
  const auto expected = static_cast<long>(outcome.expectations.size());
  Json values{{"verdict", summary.ladder ? Json(to_string(summary.ladder->verdict)) : Json()},
              {"ambiguous", summary.ladder ? Json(summary.ladder->is_ambiguous) : Json()},
              {"steps", summary.steps}};
  if (expected > 0) {
    values["expectations"] = expected;
    values["passed"] = expected - static_cast<long>(failures);
  }
  for (const auto& [name, o] : summary.observables) {
    values[name + ".initial"] = o.initial;
    values[name + ".final"] = o.final;
    values[name + ".min"] = o.min;
    values[name + ".max"] = o.max;
    values[name + ".max_drift"] = o.max_drift;
    values[name + ".slope"] = o.slope;
  }
  if (summary.max_violation) values["max_violation"] = *summary.max_violation;
  for (const auto& [name, value] : summary.final) values[name + ".final"] = value;
  values["iterations_per_step"] = summary.solver.iterations_per_step;
  values["wall_seconds"] = summary.wall_seconds;
  values["cpu_seconds"] = summary.cpu_seconds;
  return {{"folder", one.name},
          {"status", to_string(summary.status)},
          {"message", message},
          {"as_expected", failures == 0},
          {"values", values}};
}

Json ladder_of_case(const SweepCase& one) {
  const Experiment experiment = read_experiment_document(one.document);
  const LadderReport ladder = ladder_report(consistent_start(experiment), *experiment.model.system);
  const auto known = [](const std::optional<Index>& count) {
    return count ? Json(*count) : Json();
  };
  double gap = LadderReport::kUnknown;
  for (const LadderReport::Level& level : ladder.levels) gap = std::fmin(gap, level.gap);
  const std::string dimensions = word_list(
      ladder.dimensions(),
      [&](const LadderReport::Dimensions& of) {
        return "(" + known(of.first).dump() + " " + known(of.second).dump() + ")";
      },
      " ");
  return {{"status", "completed"},
          {"message", ladder.reason},
          {"values",
           {{"verdict", to_string(ladder.verdict)},
            {"ambiguous", ladder.is_ambiguous},
            {"index", known(ladder.index)},
            {"degrees_of_freedom", known(ladder.degrees_of_freedom)},
            {"gauge_dimension", ladder.gauge_dimension},
            {"ladder", dimensions},
            {"gap", std::isfinite(gap) ? Json(gap) : Json()},
            {"moved", ladder.moved}}}};
}

}  // namespace courant
