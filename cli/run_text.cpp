#include "courant/cli/run_text.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "courant/core/words/message.hpp"
#include "courant/plotting/terminal_plot.hpp"
#include "courant/reporting/ladder_diagram.hpp"
#include "courant/reporting/ladder_explanation.hpp"
#include "courant/reporting/report_figures.hpp"
#include "courant/running/boundary_run.hpp"
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

void print_observables(const Console& console, const RunSummary& summary) {
  TextTable table({"", "initial", "final", "max drift", "slope"});
  for (const auto& [name, record] : summary.observables)
    table.add({name, shown(record.initial), shown(record.final), shown(record.max_drift, 4),
               shown(record.slope, 3)});
  if (summary.max_violation)
    table.add({"constraints", "", "", shown(*summary.max_violation, 3), ""});
  if (!table.empty()) {
    console.out << '\n';
    table.print(console.out, "  ", console.columns);
  }
}

void print_final(const Console& console, const RunSummary& summary) {
  if (summary.final.empty()) return;
  TextTable table({"t = " + shown(summary.time ? summary.time->end : 0.0), ""});
  const std::size_t count = std::min(summary.final.size(), kMostCoordinates);
  for (std::size_t i = 0; i < count; ++i)
    table.add({summary.final[i].first, shown(summary.final[i].second, 12)});
  console.out << '\n';
  table.print(console.out, "  ", console.columns);
  if (count < summary.final.size())
    console.out << "  … " << summary.final.size() - count << " more in summary.json\n";
}

void print_expectations(const Console& console, const RunOutcome& outcome) {
  if (outcome.expectations.empty()) return;
  TextTable table({"expected", "value", "bound", ""});
  for (const ExpectationResult& result : outcome.expectations)
    table.add({result.description, shown(result.value, 4), shown(result.bound, 4),
               result.passed ? "passed" : "FAILED"});
  console.out << '\n';
  table.print(console.out, "  ", console.columns);
}

std::string steps_in_words(const TimeSpan& time) {
  return time.is_transformed()
             ? "steps of " + shown(time.step) + " in tau until t = " + shown(time.until)
             : std::to_string(time.steps) + " steps of " + shown(time.step);
}

}  // namespace

std::string from_and_to(const Movement& move) {
  // What is left of a sum that is zero.
  const double to = std::abs(move.to) < 1e-13 * std::abs(move.from) ? 0.0 : move.to;
  int digits = 6;
  while (digits < 17 && shown(move.from, digits) == shown(to, digits)) ++digits;
  return "from " + shown(move.from, digits) + " to " + shown(to, digits);
}

void print_opening(const Console& console, const Experiment& experiment,
                   const LadderReport& ladder) {
  std::ostream& out = console.out;
  if (!experiment.title.empty()) out << printable(experiment.title) << '\n';
  print_wrapped(console, experiment.model.description, "  ");
  if (experiment.method)
    print_wrapped(console, experiment.method->description + ", " + steps_in_words(*experiment.time),
                  "  ");
  out << '\n';
  if (experiment.solution && !is_unsolved(experiment)) {
    for (const std::string& line : boundary_in_words(*experiment.solution))
      print_wrapped(console, line, "  ");
    out << '\n';
  }
  for (const Movement& move : ladder.moves)
    print_wrapped(console, move.name + " had to move " + from_and_to(move) + " to be consistent.",
                  "  ");
  if (ladder.is_impulse)
    print_wrapped(console, "That is what an impulse does: what the equations conserve is kept.",
                  "  ");
  if (!ladder.moves.empty()) out << '\n';
  print_wrapped(console, "(dim S, dim M): " + ladder_line(ladder), "  ");
  print_wrapped(console, verdict_in_words(ladder), "  ");
  for (const std::string& doubt : doubts_in_words(ladder)) print_wrapped(console, doubt, "  ");
  for (const std::string& line : choices_in_words(ladder)) print_wrapped(console, line, "  ");
  if (ladder.family && !ladder.family->is_morse())
    print_wrapped(console, family_in_words(ladder), "  ");
  out << std::flush;
}

void print_resumption(const Console& console, long k, double t) {
  console.out << "\n  goes on after step " << k << ", at t = " << shown(t) << '\n' << std::flush;
}

void print_explanation(const Console& console, const Integrator& method) {
  const std::vector<StepFormulas> formulas = method.formulas();
  if (formulas.empty())
    console.out << method.name() << " solves no equations of its own in a step.\n\n";
  for (const StepFormulas& equations : formulas) console.out << explanation(equations) << '\n';
}

void print_outcome(const Console& console, const Experiment& experiment, const RunOutcome& outcome,
                   const std::filesystem::path& folder) {
  const RunSummary& summary = outcome.summary;
  // One that failed before its first step may have no rows at all.
  if (summary.steps > 0 && summary.steps <= kMostRowsPlotted) print_paths(console, folder);
  print_observables(console, summary);
  print_final(console, summary);
  const RunSummary::Solver& solver = summary.solver;
  if (summary.steps > 0) {
    console.out << '\n';
    print_wrapped(console,
                  shown(solver.iterations_per_step, 3) + " iterations and " +
                      shown(solver.factorizations_per_step, 3) + " factorizations a step, " +
                      shown(summary.steps_per_second, 3) + " steps/s (" + summary.backend + ")",
                  "  ");
  }
  if (const long again = solver.second_attempts.value_or(0); again > 0)
    console.out << "  " << again << (again == 1 ? " step" : " steps")
                << " needed a second attempt.\n";
  if (const long looked_at = solver.confirmations.value_or(0); looked_at > 0)
    console.out << "  " << looked_at << (looked_at == 1 ? " step was" : " steps were")
                << " confirmed by continuation in h.\n";
  if (const long divided = solver.divisions.value_or(0); divided > 0)
    console.out << "  " << divided << (divided == 1 ? " step was" : " steps were")
                << " made in halves.\n";
  if (summary.sensitivities.contains("lyapunov_exponents")) {
    std::string text = "Lyapunov exponents of the run:";
    for (const Json& exponent : summary.sensitivities["lyapunov_exponents"])
      text += (text.back() == ':' ? " " : ", ") + shown(exponent.get<double>());
    print_wrapped(console, text + ".", "  ");
  }
  for (const auto& [name, symmetry] : summary.symmetries)
    if (!symmetry.remark.empty()) print_wrapped(console, symmetry.remark, "  ");
  // What was said when the experiment was read comes first.
  for (std::size_t i = experiment.remarks.size(); i < summary.warnings.size(); ++i) {
    console.out << '\n';
    print_wrapped(console, "Warning: " + summary.warnings[i], "  ");
  }
  print_expectations(console, outcome);
  if (!summary.stopped_by.empty())
    console.out << "\n  ended by the event " << printable(summary.stopped_by)
                << " at t = " << shown(summary.time ? summary.time->end : 0.0) << '\n';
  console.out << "\n  " << to_string(summary.status) << "; files in " << shown_name(folder) << '\n'
              << std::flush;
}

void print_ensemble(const Console& console, const EnsembleOutcome& outcome,
                    const std::filesystem::path& folder) {
  const Json& summary = outcome.summary;
  const Json spreads = summary.is_object() ? summary.value("statistics", Json()) : Json();
  TextTable table({"at the end", "mean", "deviation", "least", "median", "greatest"});
  const auto add = [&](const std::string& name, const Json& spread) {
    table.add({name, shown(spread["mean"]), shown(spread["standard_deviation"], 4),
               shown(spread["min"]), shown(spread["quantiles"]["0.5"]), shown(spread["max"])});
  };
  std::size_t count = 0;
  for (const auto& [name, spread] : spreads.items())
    if (!name.starts_with("constraint[") && ++count <= kMostCoordinates) add(name, spread);
  if (summary.is_object() && !summary["drift"]["H"].is_null())
    add("max |H - H(0)|", summary["drift"]["H"]);
  if (!table.empty()) {
    console.out << '\n';
    table.print(console.out, "  ", console.columns);
  }
  if (count > kMostCoordinates)
    console.out << "  … and " << count - kMostCoordinates << " more, in summary.json\n";
  if (summary.is_object())
    console.out << "\n  " << summary["done"] << " of " << summary["members"] << " members, "
                << shown(summary["member_steps_per_cpu_second"], 3)
                << " steps of members a second of the processor\n";
  print_expectations(console, {outcome.status, outcome.message, {}, outcome.expectations});
  console.out << "\n  " << to_string(outcome.status) << "; files in " << shown_name(folder) << '\n'
              << std::flush;
}

}  // namespace courant::cli
