#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>
#include <stdexcept>

#include "courant/cli/command.hpp"
#include "courant/cli/force.hpp"
#include "courant/cli/text.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/core/words/message.hpp"
#include "courant/core/words/spelling.hpp"
#include "courant/core/words/word_list.hpp"
#include "courant/reporting/ensemble_figure.hpp"
#include "courant/reporting/figure_file.hpp"
#include "courant/reporting/figure_look.hpp"
#include "courant/reporting/report_figures.hpp"
#include "courant/reporting/study_figure.hpp"
#include "courant/reporting/sweep_figure.hpp"
#include "courant/running/run_files.hpp"

namespace courant::cli {
namespace {

struct PlotArguments {
  std::vector<std::filesystem::path> folders;
  std::string figure;
  std::vector<std::string> columns;  // in place of `figure`
  bool overlay = false;
  std::optional<double> width, font_size;
  std::string x, y, title;
  std::filesystem::path output;
  bool force = false;
};

// The figure of a sweep, a study or an ensemble, from its table.
std::optional<Figure> figure_of_table(const std::filesystem::path& folder) {
  const auto read = [&](const char* file) {
    return file_exists(folder / file) ? read_json(folder / file) : Json();
  };
  const auto refuse = [&] {
    throw RunFileError(folder.string() +
                       ": its table is not one of a sweep, a study or an ensemble.");
  };
  try {
    if (is_ensemble_folder(folder)) return ensemble_figure(read_ensemble_tables(folder));
    if (const Json sweep = read("sweep.json"); !sweep.is_null()) return sweep_figure(sweep);
    if (const Json study = read("study.json"); !study.is_null())
      return study_figure(read_study_report(study));
  } catch (const Json::exception&) {
    refuse();
  } catch (const std::invalid_argument&) {  // a column is missing
    refuse();
  }
  return std::nullopt;
}

// All figures that there are of the folders.
std::vector<Figure> figures_of(const std::vector<std::filesystem::path>& folders) {
  std::vector<Figure> figures;
  if (folders.size() == 1)
    if (auto figure = figure_of_table(folders.front())) figures.push_back(std::move(*figure));
  const bool is_whole = !figures.empty() && figures.front().name != "sweep";
  if (is_whole) return figures;
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

// `LOWER:UPPER`. Throws std::invalid_argument.
std::optional<plot::Interval> limits(const std::string& option, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t colon = text.find(':');
  const auto read = [&](std::string_view part) {
    double value = 0.0;
    const char* const end = part.data() + part.size();
    if (const auto [last, error] = std::from_chars(part.data(), end, value);
        part.empty() || error != std::errc() || last != end)
      throw std::invalid_argument(option + ": is " + text +
                                  "; expected two numbers with a colon between");
    return value;
  };
  if (colon == std::string::npos) read("");
  const std::string_view all = text;
  return plot::Interval{read(all.substr(0, colon)), read(all.substr(colon + 1))};
}

std::vector<Run> runs_of(const std::vector<std::filesystem::path>& folders) {
  std::vector<Run> runs;
  for (const auto& folder : folders)
    for (const auto& run : run_folders_in(folder)) runs.push_back(read_run(run));
  return runs;
}

int plot_figure(const Console& console, const PlotArguments& arguments) {
  std::vector<Figure> figures =
      arguments.columns.empty() ? figures_of(arguments.folders)
                                : std::vector{chosen_figure(runs_of(arguments.folders),
                                                            arguments.columns, arguments.overlay)};
  std::vector<std::string> names;
  for (const Figure& figure : figures) names.push_back(figure.name);
  const auto found =
      arguments.columns.empty() ? std::ranges::find(names, arguments.figure) : names.begin();
  if (found == names.end()) {
    print_error(console, "--figure " + arguments.figure + ": there is no such figure of " +
                             arguments.folders.front().string() +
                             (arguments.folders.size() > 1 ? ", …" : "") +
                             did_you_mean(arguments.figure, names) +
                             "; expected one of: " + word_list(names));
    return wrong;
  }
  const Figure figure =
      with_look(std::move(figures[static_cast<std::size_t>(found - names.begin())]),
                {.width = arguments.width,
                 .font_size = arguments.font_size,
                 .x = limits("--x", arguments.x),
                 .y = limits("--y", arguments.y),
                 .title = arguments.title});
  write_figure(figure, arguments.output, arguments.force);
  std::filesystem::path numbers = arguments.output;
  console.out << printable(figure.caption) << '\n'
              << shown_name(arguments.output) << ", its numbers in "
              << shown_name(numbers.replace_extension(".csv")) << '\n';
  return done;
}

}  // namespace

void add_plot(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<PlotArguments>();
  CLI::App* plot = app.add_subcommand(
      "plot", "Write one figure of runs, a sweep, a study or an ensemble, for a paper");
  plot->add_option("DIR", arguments->folders,
                   "the folder of a run, or several; or that of a sweep, a study or an ensemble")
      ->required();
  CLI::Option* figure =
      plot->add_option("--figure", arguments->figure, "which figure; not every run has all of them")
          ->type_name(
              "phase|coordinates|axes|sphere|space|paths|section|energy-balance|energy|energy-"
              "detail|"
              "constraints|"
              "observables|sweep|study|ensemble");
  CLI::Option* columns =
      plot->add_option("--columns", arguments->columns,
                       "in place of a figure: these columns of the runs over time, each in a panel")
          ->delimiter(',')
          ->type_name("NAME,...")
          ->excludes(figure);
  plot->add_flag("--overlay", arguments->overlay, "the columns in one panel")->needs(columns);
  plot->add_option("--width", arguments->width, "of the picture, in centimetres")->type_name("CM");
  plot->add_option("--font-size", arguments->font_size, "of its letters, in points; by default 9")
      ->type_name("PT");
  plot->add_option("--x", arguments->x, "the limits of the axis across; of --x=-1:1 with =")
      ->type_name("LOWER:UPPER");
  plot->add_option("--y", arguments->y, "the limits of the axis upward")->type_name("LOWER:UPPER");
  plot->add_option("--title", arguments->title, "a line above it")->type_name("TEXT");
  plot->add_option(
          "-o", arguments->output,
          "where it goes: a name that ends in .svg, .pdf, .png or, for LaTeX, .pgf; the numbers "
          "go beside "
          "it, with the ending .csv")
      ->type_name("FILE")
      ->required();
  add_force(*plot, arguments->force);
  plot->callback([&session, arguments] {
    if (arguments->figure.empty() && arguments->columns.empty())
      throw CLI::ValidationError("--figure", "is missing; expected it, or --columns");
    session.action = [arguments](const Console& console) -> int {
      try {
        return plot_figure(console, *arguments);
      } catch (const std::invalid_argument& error) {
        print_error(console, without_place(error.what()));
        return wrong;
      }
    };
  });
}

}  // namespace courant::cli
