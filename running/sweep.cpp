#include "courant/running/sweep.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cmath>
#include <mutex>
#include <new>
#include <stdexcept>

#include "courant/core/numbers/parallel.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/reading/experiment.hpp"
#include "courant/reading/unused_parameters.hpp"
#include "courant/running/comma_separated.hpp"
#include "courant/running/consistent_start.hpp"
#include "courant/running/experiment_changes.hpp"
#include "courant/running/ladder_report.hpp"
#include "courant/running/overdue.hpp"
#include "courant/running/run_files.hpp"
#include "courant/running/runner.hpp"
#include "courant/running/unfinished_run.hpp"

namespace courant {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kDidNotBegin = "did not begin";

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// "theta=0.2" of "/method/theta", whose place is called theta: what a folder may be called.
std::string name_of(const std::string& place, const Json& value) {
  std::string name = place + "=" + text_of(value);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 &&
        std::string_view(".=+-_").find(c) == std::string_view::npos)
      c = '_';
  return name;
}

std::string name_of(std::size_t number, std::size_t count, const std::vector<Setting>& settings,
                    const std::vector<std::string>& places) {
  constexpr std::size_t longest = 80;
  std::string name = std::to_string(number);
  name.insert(0, std::to_string(count).size() - name.size(), '0');
  const char* separator = "-";
  for (std::size_t i = 0; i < settings.size(); ++i) {
    name += separator + name_of(places[i], settings[i].value);
    separator = ",";
  }
  return name.substr(0, longest);
}

Json settings_json(const SweepCase& one) {
  Json json = Json::object();
  for (const Setting& setting : one.settings) json[setting.pointer] = setting.value;
  return json;
}

// What the action gives, or what it throws: as an interrupt makes it do, behind which --resume makes the case again.
Json outcome(const SweepCase& one, const std::function<Json(const SweepCase&)>& action,
             const std::atomic<bool>* stop) {
  const auto ended = [](const char* status, std::string message) {
    return Json{{"status", status}, {"message", std::move(message)}, {"values", Json::object()}};
  };
  try {
    return action(one);
  } catch (const ExperimentError& error) {
    const Problem& first = error.problems().front();
    const std::size_t more = error.problems().size() - 1;
    return ended("wrong",
                 first.line() + (more == 0 ? "" : " (and " + std::to_string(more) + " more)"));
  } catch (const std::bad_alloc&) {
    return ended("failed", "takes more memory than there is");
  } catch (const std::exception& error) {
    return ended(stop && *stop ? "interrupted" : "failed", without_place(error.what()));
  }
}

// What a run of the experiment has left in a folder; nothing where there is none that could go on.
std::optional<RunSummary> run_in_folder(const std::filesystem::path& folder,
                                        const Experiment& experiment) {
  if (!std::filesystem::exists(folder / "summary.json") ||
      !std::filesystem::exists(folder / "experiment.json"))
    return std::nullopt;
  const Json begun = read_json(folder / "experiment.json");
  const RunSummary summary = read_summary(folder / "summary.json");
  if (!begun.is_object() || begun.value("$run", "") != summary.id ||
      !experiment_changes(begun, experiment.document).empty())
    return std::nullopt;
  return summary;
}

// The entry of a table, from what a run says of itself.
Json entry_of(const SweepCase& one, const RunSummary& summary) {
  std::string message = summary.message;
  const auto failures = std::ranges::count_if(
      summary.expectations, [](const ExpectationResult& result) { return !result.passed; });
  for (const ExpectationResult& result : summary.expectations)
    if (!result.passed && message.empty())
      message = result.pointer + ": " + result.description + ": " + result.finding;
  const auto expected = static_cast<long>(summary.expectations.size());
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
  return {{"folder", one.name},
          {"status", to_string(summary.status)},
          {"message", message},
          {"as_expected", failures == 0},
          {"values", values}};
}

// Whether cases that differ in this alone differ in numbers of formulas. Whole numbers may be sizes.
bool is_of_numbers(const ValueRange& range) {
  const auto is_fraction = [](const Json& value) {
    return value.is_number() && std::floor(value.get<double>()) != value.get<double>();
  };
  return (range.pointer.starts_with("/initial/") ||
          range.pointer.starts_with("/system/parameters/")) &&
         std::ranges::any_of(range.values, is_fraction);
}

// How many cases differ in numbers alone.
std::size_t alike(std::span<const ValueRange> ranges) {
  std::size_t count = 1;
  for (std::size_t first = 0, end = 0; first < ranges.size(); first = end) {
    for (end = first + 1; end < ranges.size() && ranges[end].is_tied;) ++end;
    const auto together = ranges.subspan(first, end - first);
    if (std::ranges::all_of(together, is_of_numbers)) count *= together.front().values.size();
  }
  return count;
}

}  // namespace

std::vector<SweepCase> sweep_cases(const Json& document, std::span<const ValueRange> ranges) {
  std::vector<SweepCase> cases;
  const auto all = combinations(ranges);
  const std::size_t of_one_code = alike(ranges);
  const std::vector<std::string> places = swept_names(sweep_head(document, ranges));
  for (const auto& settings : all) {
    SweepCase one{settings, name_of(cases.size() + 1, all.size(), settings, places), document,
                  of_one_code};
    for (const Setting& setting : settings) apply_setting(setting, one.document, "--sweep");
    if (cases.empty()) require_used(one.document, settings, "--sweep");
    cases.push_back(std::move(one));
  }
  return cases;
}

Shard Shard::read(const std::string& text) {
  Shard shard{0, 0};
  const char* const end = text.data() + text.size();
  const auto [slash, error] = std::from_chars(text.data(), end, shard.number);
  const bool has_slash = error == std::errc() && slash != end && *slash == '/';
  const bool right = has_slash && std::from_chars(slash + 1, end, shard.of).ptr == end &&
                     shard.number >= 1 && shard.number <= shard.of;
  if (!right)
    throw ExperimentError("--shard " + text, "is no part; expected k/n, the k-th of n parts");
  return shard;
}

std::vector<SweepCase> Shard::take(const std::vector<SweepCase>& all) const {
  std::vector<SweepCase> part;
  for (std::size_t i = number - 1; i < all.size(); i += of) part.push_back(all[i]);
  return part;
}

Json sweep_head(const Json& document, std::span<const ValueRange> ranges, const Shard& shard) {
  Json head{{"sweep", Json::array()}, {"experiment", document}};
  for (const ValueRange& range : ranges) {
    head["sweep"].push_back({{"pointer", range.pointer}, {"values", range.values}});
    if (range.is_tied) head["sweep"].back()["tied"] = true;
  }
  if (shard.of > 1) head["shard"] = shard.text();
  return head;
}

std::vector<std::string> swept_names(const Json& table) {
  std::vector<std::string> pointers;
  for (const Json& range : table.at("sweep")) pointers.push_back(range.at("pointer"));
  return short_names(pointers, table.value("experiment", Json()));
}

Json sweep(const Json& head, std::span<const SweepCase> cases,
           const std::function<Json(const SweepCase&)>& action, const SweepOptions& options) {
  Json table{{"status", "running"}};
  table.update(head);
  table["runs"] = Json::array();
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const SweepCase& one = cases[i];
    Json row{{"folder", one.name},
             {"settings", settings_json(one)},
             {"status", "interrupted"},
             {"message", kDidNotBegin},
             {"values", Json::object()}};
    if (options.earlier.is_object()) {
      const Json& known = options.earlier.at("runs").at(i);
      if (known.at("settings") == row["settings"] && known.at("status") != "interrupted")
        row = known;
    }
    if (row["status"] == "interrupted") left.push_back(i);
    table["runs"].push_back(std::move(row));
  }
  std::mutex mutex;
  std::size_t ended = cases.size() - left.size();
  auto written = Clock::now();
  const auto write = [&] {
    if (options.folder) options.folder->write(without_seconds(table), sweep_csv(table));
    written = Clock::now();
  };
  write();
  const auto close = [&] {
    for (Json& row : table["runs"])
      if (row["status"] == "interrupted" && row["values"].empty()) row["folder"] = "";
    const bool interrupted = std::ranges::any_of(
        table["runs"], [](const Json& row) { return row["status"] == "interrupted"; });
    table["status"] = interrupted ? "interrupted" : "completed";
  };
  const Overdue overdue(options.on_overdue ? options.stop : nullptr, [&] {
    const std::scoped_lock lock(mutex);
    close();
    options.on_overdue(table);
  });
  in_parallel(left.size(), options.threads, [&](std::size_t k) {
    if (options.stop && *options.stop) return;
    const std::size_t i = left[k];
    {
      const std::scoped_lock lock(mutex);
      table["runs"][i]["message"] = "interrupted";  // until it has ended
    }
    Json entry = outcome(cases[i], action, options.stop);
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
  close();
  write();
  return table;
}

Json without_seconds(Json table) {
  for (Json& row : table["runs"]) row.erase("seconds");
  return table;
}

Json merged_sweep(std::span<const Json> parts) {
  const auto refuse = [](const std::string& what) {
    throw std::invalid_argument("merged_sweep: " + what);
  };
  if (parts.empty()) refuse("there are no parts, expected at least one.");
  std::vector<const Json*> in_order(Shard::read(parts[0].value("shard", "1/1")).of, nullptr);
  for (const Json& part : parts) {
    const Shard shard = Shard::read(part.value("shard", "1/1"));
    const std::string name = "shard " + shard.text();
    for (const char* key : {"sweep", "experiment"})
      if (part.at(key) != parts[0].at(key)) refuse(name + " is of another sweep.");
    if (shard.of != in_order.size())
      refuse(name + " is one of " + std::to_string(shard.of) + " parts, another one of " +
             std::to_string(in_order.size()) + ".");
    if (in_order[shard.number - 1]) refuse(name + " is there twice.");
    if (part.at("status") != "completed")
      refuse(name + " is " + part.at("status").get<std::string>() +
             "; expected it to be finished, with --resume.");
    in_order[shard.number - 1] = &part;
  }
  std::size_t count = 0;
  for (std::size_t k = 0; k < in_order.size(); ++k) {
    if (!in_order[k])
      refuse("shard " + std::to_string(k + 1) + "/" + std::to_string(in_order.size()) +
             " is missing.");
    count += in_order[k]->at("runs").size();
  }
  Json table{{"status", "completed"},
             {"sweep", parts[0].at("sweep")},
             {"experiment", parts[0].at("experiment")},
             {"runs", Json::array()}};
  for (std::size_t i = 0; i < count; ++i)
    table["runs"].push_back(in_order[i % in_order.size()]->at("runs").at(i / in_order.size()));
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
                 const std::atomic<bool>* stop, bool resume) {
  const std::filesystem::path place = folder / one.name;
  const Experiment experiment = read_experiment_document(one.document);
  const auto known = resume ? run_in_folder(place, experiment) : std::nullopt;
  const bool has_ended =
      known && known->status != RunStatus::running && known->status != RunStatus::interrupted;
  // A summary does not have why an expectation failed.
  const bool is_told =
      has_ended && std::ranges::all_of(known->expectations, &ExpectationResult::passed);
  if (is_told) return entry_of(one, *known);
  const RunOutcome outcome =
      run(experiment, {.folder = place,
                       .backend = backend,
                       .existing = !resume               ? ExistingRun::refuse
                                   : known && !has_ended ? ExistingRun::resume
                                                         : ExistingRun::replace,
                       .stop = stop,
                       .on_ladder = {},
                       .on_progress = {},
                       .ahead = false,  // other cases run meanwhile
                       .alike = static_cast<long>(one.alike)});
  RunSummary summary = outcome.summary;
  summary.expectations = outcome.expectations;
  Json entry = entry_of(one, summary);
  entry["seconds"] = outcome.summary.wall_seconds;
  return entry;
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
