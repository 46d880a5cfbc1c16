#include "courant/cli/sweep.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <optional>
#include <ostream>

#include "courant/cli/experiment_file.hpp"
#include "courant/cli/text.hpp"
#include "courant/core/numbers/parallel.hpp"
#include "courant/reporting/figure_file.hpp"
#include "courant/reporting/sweep_figure.hpp"

namespace courant::cli {
namespace {

// Throws what is wrong with the first case if none can be read.
void require_readable(const std::vector<SweepCase>& cases) {
  std::optional<ExperimentError> first;
  for (const SweepCase& one : cases) try {
      read_experiment_document(one.document);
      return;
    } catch (const ExperimentError& error) {
      if (!first) first = error;
    }
  if (first) throw *first;
}

// How far it is, on a terminal, in one line that goes away.
std::function<void(std::size_t, std::size_t)> progress(const Console& console, bool quiet) {
  if (quiet || !console.is_terminal) return {};
  return [&out = console.err](std::size_t ended, std::size_t count) {
    out << "\r\x1b[K";
    if (ended < count) out << ended << " of " << count;
    out << std::flush;
  };
}

bool is_as_wanted(const Json& row) {
  return row.at("status") == "completed" && row.value("as_expected", true);
}

void print_table(const Console& console, const SweepTask& task, const Json& table) {
  std::vector<std::string> head, names;
  for (const Json& range : table.at("sweep")) {
    const std::string pointer = range.at("pointer");
    head.push_back(pointer.substr(pointer.rfind('/') + 1));
  }
  head.emplace_back("status");
  const Json& rows = table.at("runs");
  for (const auto& column : task.columns) {
    const std::string &name = column.first, &title = column.second;
    if (std::ranges::none_of(rows, [&](const Json& row) { return row["values"].contains(name); }))
      continue;
    names.push_back(name);
    head.push_back(title);
  }
  TextTable text(head);
  for (const Json& row : rows) {
    std::vector<std::string> cells;
    for (const auto& [pointer, value] : row.at("settings").items()) cells.push_back(shown(value));
    const std::string status = row.at("status");
    cells.push_back(status == "completed" && !is_as_wanted(row) ? "not as expected" : status);
    for (const std::string& name : names)
      cells.push_back(row["values"].contains(name) ? shown(row["values"][name], 4) : "");
    text.add(cells);
  }
  text.print(console.out);
}

void print_messages(const Console& console, const SweepTask& task, const Json& table) {
  for (const Json& row : table.at("runs")) {
    if (is_as_wanted(row) || row.at("message") == "did not begin") continue;
    std::string settings;
    for (const auto& [pointer, value] : row.at("settings").items())
      settings +=
          " " + pointer + "=" + (value.is_string() ? value.get<std::string>() : value.dump());
    print_error(console, task.file + ":" + settings + ": " + row.at("message").get<std::string>());
  }
}

int status_of_sweep(const Json& table) {
  if (table.at("status") == "interrupted") return interrupted;
  return std::ranges::all_of(table.at("runs"), is_as_wanted) ? done : failed;
}

int sweep_of(const Console& console, const SweepTask& task, const Json& document) {
  std::vector<ValueRange> ranges;
  for (const std::string& text : task.sweep.ranges) ranges.push_back(read_range(text));
  const std::vector<SweepCase> cases = sweep_cases(document, ranges);
  require_readable(cases);
  std::optional<ResultFolder> folder;
  if (!task.folder.empty()) folder.emplace(task.folder, "sweep", task.replace);
  if (console.heeds_stop) *console.heeds_stop = true;
  const Json table =
      sweep(ranges, cases, [&](const SweepCase& one) { return task.action(one, task.folder); },
            {.threads = task.sweep.jobs > 0 ? task.sweep.jobs : core_count(),
             .stop = console.stop,
             .on_progress = progress(console, task.quiet),
             .folder = folder ? &*folder : nullptr});
  if (console.heeds_stop) *console.heeds_stop = false;
  const auto figure = folder ? sweep_figure(table) : std::nullopt;
  if (figure) folder->write(table, sweep_csv(table), figure_svg(*figure));
  if (task.json)
    console.out << table.dump(2) << '\n';
  else if (!task.quiet)
    print_table(console, task, table);
  if (folder && !task.quiet && !task.json)
    console.out << "\n  " << cases.size() << (cases.size() == 1 ? " case" : " cases") << "; "
                << folder->file("csv").string() << (figure ? ", and a figure: " : "")
                << (figure ? folder->file("svg").filename().string() : "") << '\n';
  print_messages(console, task, table);
  return status_of_sweep(table);
}

}  // namespace

void add_sweep(CLI::App& command, SweepArguments& arguments) {
  CLI::Option* sweep =
      command
          .add_option("--sweep", arguments.ranges,
                      "do it for several values: n numbers from a to b, or a list v,w,… of values; "
                      "may be repeated, for all combinations")
          ->type_name("/POINTER=a:b:n")
          ->expected(1)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option("--jobs", arguments.jobs,
                  "how many at once in a sweep (default: as many as there are cores)")
      ->check(CLI::Range(1, 1000).description(""))
      ->type_name("N")
      ->needs(sweep);
}

int run_sweep(const Console& console, const SweepTask& task) {
  if (!task.folder.empty()) ResultFolder::check(task.folder, "sweep", task.replace);
  return with_document(
      console, task.file, [&](const Json& document) { return sweep_of(console, task, document); },
      task.settings);
}

std::filesystem::path default_folder(const std::string& file, const std::string& suffix) {
  const std::string name = std::filesystem::path(file).stem().string();
  return std::filesystem::path("runs") / ((file == "-" ? "stdin" : name) + suffix);
}

}  // namespace courant::cli
