#include "courant/cli/sweep.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <ostream>

#include "courant/cli/experiment_file.hpp"
#include "courant/cli/text.hpp"
#include "courant/core/numbers/parallel.hpp"
#include "courant/reporting/figure_file.hpp"
#include "courant/reporting/sweep_figure.hpp"
#include "courant/running/unfinished_run.hpp"

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

// One of the values of a case, or what is told of it beside them.
Json value_of(const Json& row, const std::string& name) {
  return row.at("values").contains(name) ? row.at("values").at(name) : row.value(name, Json());
}

void print_table(const Console& console, const SweepTask& task, const Json& table) {
  std::vector<std::string> head = swept_names(table), names;
  head.emplace_back("status");
  const Json& rows = table.at("runs");
  for (const auto& column : task.columns) {
    const std::string &name = column.first, &title = column.second;
    if (std::ranges::none_of(rows, [&](const Json& row) { return !value_of(row, name).is_null(); }))
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
      cells.push_back(value_of(row, name).is_null() ? "" : shown(value_of(row, name), 4));
    text.add(cells);
  }
  text.print(console.out, "  ", console.columns);
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

// Places with their values, or a table of cases, which is a file.
std::vector<ValueRange> ranges_of(const SweepArguments& arguments) {
  std::vector<ValueRange> ranges;
  for (const std::string& text : arguments.ranges) {
    if (text.starts_with("/") && text.find('=') != std::string::npos) {
      ranges.push_back(read_range(text));
      continue;
    }
    std::error_code error;
    if (!std::filesystem::is_regular_file(text, error)) {
      if (text.find('=') == std::string::npos)
        throw ExperimentError(
            "--sweep " + text,
            "is no file; expected /json/pointer=a:b:n, or a file of cases (.csv)");
      ranges.push_back(read_range(text));  // which says what is wrong
      continue;
    }
    std::ifstream file(text, std::ios::binary);
    const std::string content(std::istreambuf_iterator<char>(file), {});
    for (ValueRange& range : read_cases(content, text)) ranges.push_back(std::move(range));
  }
  return ranges;
}

// The table of the sweep in the folder, which is to go on; null where there is none.
Json earlier_table(const SweepTask& task, const Json& head) {
  if (!task.sweep.resume || task.folder.empty()) return {};
  const Json table = ResultFolder::result_in(task.folder, "sweep");
  if (table.is_null()) return table;
  for (const char* key : {"sweep", "experiment", "shard"})
    if (table.value(key, Json()) != head.value(key, Json()))
      throw UnusableFolder(task.folder.string() +
                           ": the sweep in this folder is another one, by its \"" + key +
                           "\"; expected the same experiment, --set, --sweep and --shard");
  return table;
}

// What became of a sweep, on the screen and as a figure; `folder`: that of its files, null where there are none.
void tell(const Console& console, const SweepTask& task, const Json& table,
          const ResultFolder* folder) {
  const auto figure = folder ? sweep_figure(table) : std::nullopt;
  if (folder)
    folder->write(without_seconds(table), sweep_csv(table), figure ? figure_svg(*figure) : "");
  if (task.json)
    console.out << table.dump(2) << '\n';
  else if (!task.quiet)
    print_table(console, task, table);
  if (folder && !task.quiet && !task.json) {
    const std::size_t count = table.at("runs").size();
    console.out << "\n  " << count << (count == 1 ? " case" : " cases") << "; "
                << shown_name(folder->file("csv")) << (figure ? ", and a figure: " : "")
                << (figure ? shown_name(folder->file("svg").filename()) : "") << '\n';
  }
  print_messages(console, task, table);
}

int sweep_of(const Console& console, const SweepTask& task, const Json& document) {
  if (document.contains("ensemble"))
    throw ExperimentError("/ensemble",
                          "has many starts already; expected no --sweep beside it, or a column of "
                          "the ensemble for what is swept");
  const std::vector<ValueRange> ranges = ranges_of(task.sweep);
  const Shard shard = task.sweep.shard.empty() ? Shard() : Shard::read(task.sweep.shard);
  const std::vector<SweepCase> cases = shard.take(sweep_cases(document, ranges));
  require_readable(cases);
  const Json head = sweep_head(document, ranges, shard);
  const Json earlier = earlier_table(task, head);
  std::optional<ResultFolder> folder;
  if (!task.folder.empty()) folder.emplace(task.folder, "sweep", task.replace, task.sweep.resume);
  const ResultFolder* const files = folder ? &*folder : nullptr;
  SweepOptions options{.threads = task.sweep.jobs > 0 ? task.sweep.jobs : core_count(),
                       .stop = console.stop,
                       .on_progress = progress(console, task.quiet),
                       .folder = files,
                       .earlier = earlier};
  if (console.heeds_stop) {
    options.on_overdue = [&](const Json& table) {
      end_overdue(console, [&] {
        tell(console, task, table, files);
        return interrupted;
      });
    };
    *console.heeds_stop = true;
  }
  const Json table = sweep(
      head, cases, [&](const SweepCase& one) { return task.action(one, task.folder); }, options);
  if (console.heeds_stop) *console.heeds_stop = false;
  tell(console, task, table, files);
  return status_of_sweep(table);
}

}  // namespace

void add_sweep(CLI::App& command, SweepArguments& arguments, bool has_resume) {
  CLI::Option* sweep =
      command
          .add_option("--sweep", arguments.ranges,
                      "do it for several values: n numbers from a to b, or a list v,w,… of values; "
                      "may be repeated, for all combinations; or for each row of a table of cases, "
                      "FILE.csv with a column for each pointer")
          ->type_name("/POINTER=a:b:n")
          ->expected(1)
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  CLI::Option* jobs =
      command
          .add_option("--jobs", arguments.jobs,
                      has_resume ? "how many at once in a sweep or an ensemble (default: as many "
                                   "as there are cores)"
                                 : "how many at once in a sweep (default: as many as there are "
                                   "cores)")
          ->check(CLI::Range(1, 1000).description(""))
          ->type_name("N");
  if (!has_resume) jobs->needs(sweep);
  command
      .add_option("--shard", arguments.shard,
                  "only the k-th of n parts of a sweep; `courant sweep --merge` joins them")
      ->type_name("K/N")
      ->needs(sweep);
  if (!has_resume)
    command
        .add_flag("--resume", arguments.resume, "make what is missing in the sweep in the folder")
        ->needs(sweep);
}

int run_sweep(const Console& console, const SweepTask& task) {
  if (!task.folder.empty())
    ResultFolder::check(task.folder, "sweep", task.replace, task.sweep.resume);
  return with_document(
      console, task.file, [&](const Json& document) { return sweep_of(console, task, document); },
      task.settings);
}

std::filesystem::path default_folder(const std::string& file, const std::string& suffix) {
  const std::string name = std::filesystem::path(file).stem().string();
  return std::filesystem::path("runs") / ((file == "-" ? "stdin" : name) + suffix);
}

}  // namespace courant::cli
