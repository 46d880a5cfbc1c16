#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <ostream>
#include <string>
#include <system_error>
#include <vector>

#include "courant/cli/command.hpp"
#include "courant/cli/text.hpp"
#include "courant/core/words/message.hpp"
#include "courant/reporting/figure_file.hpp"
#include "courant/reporting/sweep_figure.hpp"
#include "courant/running/result_folder.hpp"
#include "courant/running/run_files.hpp"
#include "courant/running/sweep.hpp"

namespace courant::cli {
namespace {

namespace fs = std::filesystem;

struct MergeArguments {
  std::vector<fs::path> folders;
  std::string output;
  bool force = false;
};

// The runs of a part, beside those of the others.
void copy_runs(const fs::path& from, const Json& part, const fs::path& to) {
  for (const fs::path& name : ResultFolder::runs_of(part)) {
    std::error_code error;
    fs::copy(from / name, to / name, fs::copy_options::recursive, error);
    if (error)
      throw OutputError((to / name).string() + ": cannot be copied from " + (from / name).string() +
                        ": " + error.message());
  }
}

// Throws RunFileError if a table names a folder that is not one of its own.
void require_own_runs(const fs::path& folder, const Json& part) {
  const auto names = std::ranges::count_if(part.at("runs"),
                                           [](const Json& row) { return row.at("folder") != ""; });
  if (names != std::ssize(ResultFolder::runs_of(part)))
    throw RunFileError(folder.string() + ": its table names a run that is in no folder of it.");
}

// Throws UnusableFolder if the whole would be written over a part of it, or into one.
void require_beside(const fs::path& part, const fs::path& whole) {
  std::error_code error;
  const fs::path below =
      fs::weakly_canonical(whole, error).lexically_relative(fs::weakly_canonical(part, error));
  if (!below.empty() && *below.begin() != "..")
    refuse_folder(whole, "is " + std::string(below == "." ? "" : "in ") +
                             "a part that is to be joined; expected another folder (-o)");
}

int merge(const Console& console, const MergeArguments& arguments) {
  std::vector<Json> parts;
  for (const fs::path& folder : arguments.folders) {
    require_beside(folder, arguments.output);
    parts.push_back(ResultFolder::result_in(folder, "sweep"));
    if (parts.back().is_null())
      throw RunFileError(folder.string() +
                         ": there is no sweep in this folder; expected a part of one");
  }
  Json table;
  std::string csv, svg;
  try {
    table = merged_sweep(parts);
    for (std::size_t i = 0; i < parts.size(); ++i) require_own_runs(arguments.folders[i], parts[i]);
    csv = sweep_csv(table);
    if (const auto figure = sweep_figure(table)) svg = figure_svg(*figure);
  } catch (const std::invalid_argument& error) {
    throw RunFileError(arguments.folders.front().string() + ", …: " + without_place(error.what()));
  } catch (const Json::exception&) {
    throw RunFileError(arguments.folders.front().string() + ", …: a table is not one of a sweep.");
  }
  const ResultFolder folder(arguments.output, "sweep", arguments.force);
  for (std::size_t i = 0; i < parts.size(); ++i)
    copy_runs(arguments.folders[i], parts[i], folder.path());
  folder.write(table, csv, svg);
  console.out << table.at("runs").size() << " cases of " << parts.size() << " parts; "
              << shown_name(folder.file("csv")) << '\n';
  return done;
}

}  // namespace

void add_sweep_command(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<MergeArguments>();
  CLI::App* sweep = app.add_subcommand("sweep", "Join the parts of a sweep that --shard made");
  sweep
      ->add_option("--merge", arguments->folders,
                   "the folders of all parts, each finished; they stay as they are")
      ->type_name("DIR")
      ->required();
  sweep
      ->add_option("-o", arguments->output,
                   "where the whole sweep goes, with the bytes that one process would have written")
      ->type_name("DIR")
      ->required();
  sweep->add_flag("--force", arguments->force, "replace a sweep that is in the folder already");
  sweep->callback([&session, arguments] {
    session.action = [arguments](const Console& console) { return merge(console, *arguments); };
  });
}

}  // namespace courant::cli
