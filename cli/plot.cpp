#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/cli/force.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/reporting/figure_file.hpp"
#include "courant/reporting/study_figure.hpp"
#include "courant/reporting/sweep_figure.hpp"
#include "courant/running/run_files.hpp"

namespace courant::cli {
namespace {

struct PlotArguments {
  std::vector<std::filesystem::path> folders;
  std::string figure;
  std::filesystem::path output;
  bool force = false;
};

// The figure of a sweep or a study, from its table.
std::optional<Figure> figure_of_table(const std::filesystem::path& folder) {
  const auto read = [&](const char* file) {
    return file_exists(folder / file) ? read_json(folder / file) : Json();
  };
  try {
    if (const Json sweep = read("sweep.json"); !sweep.is_null()) return sweep_figure(sweep);
    if (const Json study = read("study.json"); !study.is_null())
      return study_figure(read_study_report(study));
  } catch (const Json::exception&) {
    throw RunFileError(folder.string() + ": its table is not one of a sweep or a study.");
  }
  return std::nullopt;
}

// All figures that there are of the folders.
std::vector<Figure> figures_of(const std::vector<std::filesystem::path>& folders) {
  std::vector<Figure> figures;
  if (folders.size() == 1)
    if (auto figure = figure_of_table(folders.front())) figures.push_back(std::move(*figure));
  const bool is_study = !figures.empty() && figures.front().name == "study";
  if (is_study) return figures;
  std::vector<Run> runs;
  try {
    for (const auto& folder : folders)
      for (const auto& run : run_folders_in(folder)) runs.push_back(read_run(run));
  } catch (const RunFileError&) {  // a sweep without runs, as one of ladders, has its figure alone
    if (figures.empty()) throw;
    return figures;
  }
  for (Figure& figure : all_figures(runs)) figures.push_back(std::move(figure));
  return figures;
}

int plot_figure(const Console& console, const PlotArguments& arguments) {
  std::vector<Figure> figures = figures_of(arguments.folders);
  std::vector<std::string> names;
  for (const Figure& figure : figures) names.push_back(figure.name);
  const auto found = std::ranges::find(names, arguments.figure);
  if (found == names.end()) {
    print_error(console, "--figure " + arguments.figure + ": there is no such figure of " +
                             arguments.folders.front().string() +
                             (arguments.folders.size() > 1 ? ", …" : "") +
                             did_you_mean(arguments.figure, names) +
                             "; expected one of: " + word_list(names));
    return wrong;
  }
  const Figure& figure = figures[static_cast<std::size_t>(found - names.begin())];
  try {
    write_figure(figure, arguments.output, arguments.force);
  } catch (const std::invalid_argument& error) {
    print_error(console, error.what());
    return wrong;
  }
  std::filesystem::path numbers = arguments.output;
  console.out << figure.caption << '\n'
              << arguments.output.string() << ", its numbers in "
              << numbers.replace_extension(".csv").string() << '\n';
  return done;
}

}  // namespace

void add_plot(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<PlotArguments>();
  CLI::App* plot =
      app.add_subcommand("plot", "Write one figure of runs, a sweep or a study, for a paper");
  plot->add_option("DIR", arguments->folders,
                   "the folder of a run, or several; or that of a sweep or a study")
      ->required();
  plot->add_option("--figure", arguments->figure, "which figure; not every run has all of them")
      ->type_name(
          "phase|coordinates|axes|sphere|space|paths|section|energy-balance|energy|energy-detail|"
          "constraints|"
          "observables|sweep|study")
      ->required();
  plot->add_option("-o", arguments->output,
                   "where it goes: a name that ends in .svg, .pdf or .png; the numbers go beside "
                   "it, with the ending .csv")
      ->type_name("FILE")
      ->required();
  add_force(*plot, arguments->force);
  plot->callback([&session, arguments] {
    session.action = [arguments](const Console& console) {
      return plot_figure(console, *arguments);
    };
  });
}

}  // namespace courant::cli
