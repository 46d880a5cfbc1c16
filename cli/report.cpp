#include "courant/reporting/report.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <ostream>

#include "courant/cli/command.hpp"
#include "courant/cli/force.hpp"
#include "courant/cli/text.hpp"
#include "courant/core/files/own_file.hpp"
#include "courant/core/words/message.hpp"
#include "courant/plotting/terminal_plot.hpp"
#include "courant/reporting/energy_figures.hpp"
#include "courant/reporting/report_figures.hpp"

namespace courant::cli {
namespace {

struct ReportArguments {
  std::vector<std::filesystem::path> folders;
  std::filesystem::path output;
  bool force = false;
};

// Beside the files of one run; above the folders of several.
std::filesystem::path page_of(const ReportArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  const std::filesystem::path& first = arguments.folders.front();
  if (arguments.folders.size() == 1) return first / "report.html";
  const auto whole = std::filesystem::absolute(first).lexically_normal();
  return (whole.has_filename() ? whole : whole.parent_path())
             .parent_path()
             .lexically_proximate(std::filesystem::current_path()) /
         "report.html";
}

// Of all steps where nothing comes in or goes out, of all rows otherwise.
double greatest_energy_error(const Run& run) {
  const auto error = energy_error(run);
  if (error && error->is_balance) return greatest_size(error->values);
  const QuantityRecord* H = run.summary.observable("H");
  return H ? H->max_drift : RunSummary::kUnknown;
}

void print_comparison(const Console& console, const std::vector<Run>& runs) {
  TextTable table({"run", "method", "energy error", "", "steps", "steps/s", "expected"});
  for (const Run& run : runs) {
    const RunSummary& summary = run.summary;
    const auto trend = energy_trend(run);
    const auto passed =
        std::count_if(summary.expectations.begin(), summary.expectations.end(),
                      [](const ExpectationResult& expectation) { return expectation.passed; });
    table.add({run.name, summary.method, shown_if_known(greatest_energy_error(run), 4),
               trend ? word(trend->growth) : "", std::to_string(summary.steps),
               shown_if_known(summary.steps_per_second, 3),
               std::to_string(passed) + " of " + std::to_string(summary.expectations.size())});
  }
  table.print(console.out, "", console.columns);
  for (const Run& run : runs)
    if (run.summary.status == RunStatus::running)
      console.out << printable(run.name) << ": " << printable(run.summary.message) << '\n';
}

// The energy errors of the runs that have an energy.
void print_energies(const Console& console, const std::vector<Run>& runs) {
  const std::vector<std::string> labels = run_labels(runs);
  std::vector<plot::Series> series;
  std::string name = "H - H(0)";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    auto error = energy_error(runs[i]);
    if (!error || error->values.size() < 2) continue;
    const auto t = runs[i].trajectory.column("t");
    if (error->is_balance) name = "H - H(0) - supplied + dissipated";
    series.push_back({printable(labels[i]), {t.begin(), t.end()}, std::move(error->values), i});
  }
  if (series.empty()) return;
  console.out << '\n'
              << plot::terminal_log_plot("|" + name + "|", series,
                                         {.unicode = console.unicode, .colour = console.colour});
}

}  // namespace

void add_report(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* report =
      app.add_subcommand("report", "Compare finished runs, and make a page of HTML of them");
  report->add_option("DIR", arguments->folders, "the folder of a run or of a sweep, or several")
      ->required();
  report
      ->add_option("-o", arguments->output,
                   "where the page goes (default: report.html in DIR, or above the folders)")
      ->type_name("FILE");
  add_force(*report, arguments->force);
  report->callback([&session, arguments] {
    session.action = [arguments](const Console& console) -> int {
      const auto page = page_of(*arguments);
      OwnFiles("report", arguments->force).check(page);
      // A page of more curves than that is large, and they cannot be told apart.
      constexpr std::size_t most = 24;
      std::vector<std::filesystem::path> folders;
      for (const auto& folder : arguments->folders)
        for (auto& run : run_folders_in(folder)) folders.push_back(std::move(run));
      if (folders.size() > most) {
        print_error(console, "note: the page has the first " + std::to_string(most) + " of " +
                                 std::to_string(folders.size()) + " runs");
        folders.resize(most);
      }
      std::vector<Run> runs;
      for (const auto& folder : folders) runs.push_back(read_run(folder));
      print_comparison(console, runs);
      print_energies(console, runs);
      write_report(runs, page, arguments->force);
      console.out << "\nThe report is " << shown_name(page) << '\n';
      return done;
    };
  });
}

}  // namespace courant::cli
