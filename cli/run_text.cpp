#include "courant/cli/run_text.hpp"

#include <algorithm>
#include <ostream>

#include "courant/core/message.hpp"
#include "courant/plotting/terminal_plot.hpp"
#include "courant/reporting/ladder_diagram.hpp"
#include "courant/reporting/report_figures.hpp"
#include "courant/running/run_files.hpp"

namespace courant::cli {
namespace {

constexpr long kMostRowsPlotted = 20000;  // what is read back in a moment
constexpr std::size_t kMostCoordinates = 12;

// The paths of the bodies of a run in the plane, if it has any.
void print_paths(const Console& console, const std::filesystem::path& folder) {
  const Run run = read_run(folder);
  const std::vector<std::string> coordinates = run.coordinates();
  const auto bodies = planar_bodies(coordinates);
  const TrajectoryTable& table = run.trajectory;
  if (bodies.empty() || table.rows() < 2) return;
  const auto rows = static_cast<std::ptrdiff_t>(legible_rows(table, bodies));
  std::vector<plot::Series> paths;
  for (const auto& [x, y] : bodies) {
    const auto xs = table.column(x), ys = table.column(y);
    paths.push_back({"(" + x + ", " + y + ")",
                     {xs.begin(), xs.begin() + rows},
                     {ys.begin(), ys.begin() + rows},
                     paths.size()});
  }
  const std::string title = "t from " + shown(table.column("t").front()) + " to " +
                            shown(table.column("t")[static_cast<std::size_t>(rows) - 1]);
  console.out << '\n'
              << plot::terminal_paths(title, paths,
                                      {.unicode = console.unicode, .colour = console.colour});
}

void print_observables(const Console& console, const Json& summary) {
  TextTable table({"", "initial", "final", "max drift", "slope"});
  for (const auto& [name, o] : summary.at("observables").items())
    table.add({name, shown(o.at("initial")), shown(o.at("final")), shown(o.at("max_drift"), 4),
               shown(o.at("slope"), 3)});
  if (const Json violation = summary.at("constraints").value("max_violation", Json());
      !violation.is_null())
    table.add({"constraints", "", "", shown(violation, 3), ""});
  if (!table.empty()) {
    console.out << '\n';
    table.print(console.out);
  }
}

void print_final(const Console& console, const Json& summary) {
  const Json& final_state = summary.at("final");
  if (final_state.empty()) return;
  TextTable table({"t = " + shown(summary.at("time").value("end", Json(0.0))), ""});
  std::size_t count = 0;
  for (const auto& [name, value] : final_state.items()) {
    if (++count > kMostCoordinates) break;
    table.add({name, shown(value, 12)});
  }
  console.out << '\n';
  table.print(console.out);
  if (count > kMostCoordinates)
    console.out << "  … " << final_state.size() - kMostCoordinates << " more in summary.json\n";
}

void print_expectations(const Console& console, const RunOutcome& outcome) {
  if (outcome.expectations.empty()) return;
  TextTable table({"expected", "value", "bound", ""});
  for (const ExpectationResult& result : outcome.expectations)
    table.add({result.description, shown(result.value, 4), shown(result.bound, 4),
               result.passed ? "passed" : "FAILED"});
  console.out << '\n';
  table.print(console.out);
}

}  // namespace

void print_opening(const Console& console, const Experiment& experiment, const Json& ladder) {
  std::ostream& out = console.out;
  if (!experiment.title.empty()) out << printable(experiment.title) << '\n';
  out << "  " << experiment.model.description << '\n';
  if (experiment.method)
    out << "  " << experiment.method->description << ", " << experiment.time->steps << " steps of "
        << shown(experiment.time->step) << '\n';
  out << "\n  (dim S, dim M): " << ladder_line(ladder) << "\n  " << verdict_in_words(ladder)
      << '\n';
  for (const Json& move : ladder.at("moves"))
    out << "  " << move.at("name").get<std::string>() << " had to move from "
        << shown(move.at("from")) << " to " << shown(move.at("to")) << " to be consistent.\n";
  out << std::flush;
}

void print_outcome(const Console& console, const RunOutcome& outcome,
                   const std::filesystem::path& folder) {
  const Json& summary = outcome.summary;
  if (summary.at("steps").get<long>() <= kMostRowsPlotted) print_paths(console, folder);
  print_observables(console, summary);
  print_final(console, summary);
  const Json& solver = summary.at("solver");
  if (summary.at("steps").get<long>() > 0)
    console.out << "\n  " << shown(solver.at("iterations_per_step"), 3) << " iterations and "
                << shown(solver.at("factorizations_per_step"), 3) << " factorizations a step, "
                << shown(summary.at("steps_per_second"), 3) << " steps/s ("
                << summary.at("backend").get<std::string>() << ")\n";
  print_expectations(console, outcome);
  console.out << "\n  " << summary.at("status").get<std::string>() << "; files in "
              << folder.string() << '\n'
              << std::flush;
}

}  // namespace courant::cli
