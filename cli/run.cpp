#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <ostream>

#include "courant/cli/backend.hpp"
#include "courant/cli/command.hpp"
#include "courant/cli/confinement.hpp"
#include "courant/cli/ensemble.hpp"
#include "courant/cli/experiment_file.hpp"
#include "courant/cli/progress_bar.hpp"
#include "courant/cli/run_text.hpp"
#include "courant/cli/sweep.hpp"
#include "courant/cli/waiting.hpp"
#include "courant/core/expressions/native.hpp"
#include "courant/extensions/petsc/petsc_session.hpp"
#include "courant/running/boundary_run.hpp"
#include "courant/running/chosen_step.hpp"
#include "courant/running/run_backend.hpp"
#include "courant/running/runner.hpp"

namespace courant::cli {
namespace {

struct RunArguments {
  std::string file;
  std::string folder;
  Backend::Kind backend = Backend::Kind::automatic;
  bool force = false;
  bool resume = false;
  bool explain = false;
  bool quiet = false;
  bool untrusted = false;
  std::vector<std::string> settings;
  std::string engine;                       // empty: this process
  std::vector<std::string> engine_options;  // of PETSc
  std::shared_ptr<const EquationEngine> solver;
  SweepArguments sweep;

  std::filesystem::path output() const {
    return folder.empty() ? default_folder(file) : std::filesystem::path(folder);
  }
  ExistingRun existing() const {
    return resume ? ExistingRun::resume : force ? ExistingRun::replace : ExistingRun::refuse;
  }
};

// Expectations that did not hold, as errors of their entries.
void report_failures(const Console& console, const std::string& file, const RunOutcome& outcome) {
  for (const ExpectationResult& result : outcome.expectations)
    if (!result.passed)
      print_error(console,
                  file + ": " + result.pointer + ": " + result.description + ": " + result.finding);
}

int run_experiment(const Console& console, const RunArguments& arguments,
                   const Experiment& experiment) {
  if (!experiment.ensemble && arguments.sweep.jobs > 0) {
    print_error(console,
                "--jobs is of a sweep or an ensemble; expected --sweep, or an experiment "
                "with \"ensemble\"");
    return wrong;
  }
  if (experiment.ensemble) {
    if (arguments.explain) {
      print_error(console, "--explain is of one run; expected an experiment without \"ensemble\"");
      return wrong;
    }
    return run_members(console,
                       {.file = arguments.file,
                        .folder = arguments.output(),
                        .existing = arguments.existing(),
                        .backend = arguments.backend,
                        .jobs = arguments.sweep.jobs,
                        .quiet = arguments.quiet},
                       experiment);
  }
  if (experiment.time && !experiment.time->is_chosen) {
    std::optional<Waiting> waiting;
    if (!arguments.quiet) waiting.emplace(console, "choosing the step");
    const ChosenStep chosen =
        chosen_step(experiment, worthwhile(arguments.backend, experiment), console.stop);
    waiting.reset();
    if (!arguments.quiet)
      print_wrapped(console,
                    "The step " + shown(chosen.step) +
                        " was chosen: with a half of it coordinates differ by " +
                        shown(chosen.estimate, 2) + " of their ways" +
                        (chosen.observed > 0.0
                             ? ", and what is observed by " + shown(chosen.observed, 2) + " of its."
                             : "."),
                    "  ");
    const auto whole = with_chosen_step(experiment, chosen);
    for (std::size_t i = experiment.remarks.size(); i < whole->remarks.size(); ++i)
      print_error(console, arguments.file + ": " + whole->remarks[i].where +
                               ": warning: " + whole->remarks[i].what);
    return run_experiment(console, arguments, *whole);
  }
  if (experiment.boundary && !experiment.solution) {
    std::optional<Waiting> waiting;
    if (!arguments.quiet) waiting.emplace(console, "boundary values");
    const auto whole = with_boundary_solved(experiment, console.stop);
    waiting.reset();
    return run_experiment(console, arguments, *whole);
  }
  RunOptions options{.folder = arguments.output(),
                     .backend = arguments.backend,
                     .engine = arguments.solver,
                     .existing = arguments.existing(),
                     .stop = console.stop,
                     .on_ladder = {},
                     .on_method = {},
                     .on_progress = {}};
  if (arguments.explain)
    options.on_method = [&](const Integrator& method) { print_explanation(console, method); };
  std::optional<ProgressBar> bar;
  std::optional<Waiting> waiting;
  if (!arguments.quiet) waiting.emplace(console, "constraint algorithm");
  options.on_ladder = [&](const LadderReport& ladder) {
    waiting.reset();
    if (!arguments.quiet) print_opening(console, experiment, ladder);
  };
  if (console.heeds_stop) options.on_begin = [&] { *console.heeds_stop = true; };
  if (!arguments.quiet) {
    options.on_resume = [&](long k, double t) { print_resumption(console, k, t); };
    if (console.is_terminal) {
      bar.emplace(console.err);
      options.on_progress = [&](const Progress& progress) { bar->show(progress); };
    }
  }
  if (worthwhile(arguments.backend, experiment).kind() == Backend::Kind::automatic &&
      !arguments.quiet)
    if (const std::string defect = machine_compiler()->defect(); !defect.empty())
      print_error(console, "formulas are interpreted, which is slower: " + defect);
  const RunOutcome outcome = run(experiment, options);
  bar.reset();
  if (console.heeds_stop) *console.heeds_stop = false;
  if (!arguments.quiet) print_outcome(console, experiment, outcome, options.folder);
  if (arguments.untrusted && Confinement::is_out_of_time()) {
    print_error(console, arguments.file + ": " + Confinement::time_in_words());
    return failed;
  }
  if (outcome.status != RunStatus::completed)
    print_error(console, arguments.file + ": " + outcome.message);
  if (outcome.status == RunStatus::interrupted) return interrupted;
  if (outcome.status == RunStatus::failed || outcome.status == RunStatus::not_finite) return failed;
  report_failures(console, arguments.file, outcome);
  return outcome.as_expected() ? done : failed;
}

int run_file(const Console& console, const RunArguments& arguments) {
  return with_experiment(
      console, arguments.file,
      [&](const Experiment& experiment) {
        if (arguments.solver && experiment.ensemble) {
          print_error(console,
                      arguments.file +
                          ": /ensemble: makes many runs, and --engine divides the steps of one; "
                          "expected no \"ensemble\", or no --engine");
          return static_cast<int>(wrong);
        }
        try {
          return run_experiment(console, arguments, experiment);
        } catch (const EngineStopped& stop) {  // before anything was written
          print_error(console, arguments.file + ": " + stop.what());
          return static_cast<int>(interrupted);
        }
      },
      arguments.settings, arguments.untrusted ? TableFiles::beside : TableFiles::anywhere);
}

// Of `mpirun` the first process runs the experiment, the others solve steps with it.
int run_by_engine(const Console& console, RunArguments arguments) {
  if (const std::string missing = PetscSession::missing(); !missing.empty()) {
    print_error(console, "--engine petsc: " + missing);
    return wrong;
  }
  PetscSession session(arguments.engine_options, console.stop);
  if (!session.is_first()) {
    if (console.heeds_stop) *console.heeds_stop = true;  // the first one decides when to end
    session.serve();
    return done;
  }
  arguments.solver = session.engine();
  const int status = run_file(console, arguments);
  if (session.is_lost()) {
    console.out.flush();
    console.err.flush();
    std::_Exit(status);
  }
  return status;
}

int run_cases(const Console& console, const RunArguments& arguments) {
  SweepArguments sweep = arguments.sweep;
  sweep.resume = arguments.resume;
  return run_sweep(console,
                   {.file = arguments.file,
                    .settings = arguments.settings,
                    .sweep = sweep,
                    .folder = arguments.folder.empty() ? default_folder(arguments.file, "-sweep")
                                                       : std::filesystem::path(arguments.folder),
                    .replace = arguments.force,
                    .quiet = arguments.quiet,
                    .action =
                        [&](const SweepCase& one, const std::filesystem::path& folder) {
                          return run_of_case(one, folder, arguments.backend, console.stop,
                                             arguments.resume);
                        },
                    .columns = {{"steps", "steps"},
                                {"H.max_drift", "max |H - H(0)|"},
                                {"max_violation", "constraints"},
                                {"passed", "passed"},
                                {"expectations", "of"},
                                {"seconds", "seconds"}}});
}

}  // namespace

void add_run(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* run =
      app.add_subcommand("run", "Run an experiment and write its trajectory and summary");
  run->add_option("FILE", arguments->file, "the experiment, or - for standard input")->required();
  run->add_option("-o", arguments->folder,
                  "where the files go (default: runs/<name of FILE>, of a sweep runs/<name of "
                  "FILE>-sweep)")
      ->type_name("DIR");
  add_backend(*run, arguments->backend);
  add_settings(*run, arguments->settings);
  add_sweep(*run, arguments->sweep, true);
  CLI::Option* force =
      run->add_flag("--force", arguments->force, "replace a run that is in the folder already");
  run->add_flag(
         "--resume", arguments->resume,
         "go on with the run that is in the folder: one that was killed, interrupted or "
         "failed, or one that is complete after /time/end has grown; its files become "
         "those of a run that was never stopped; of a sweep or an ensemble, make what is missing")
      ->excludes(force);
  run->add_flag("--explain", arguments->explain,
                "say which equations a step solves, and which unknowns they give explicitly")
      ->excludes("--sweep");
  run->add_flag(
         "--untrusted", arguments->untrusted,
         "run an experiment of a stranger: without a C compiler, with files beside it alone, "
         "and with at most 60 s of the processor, 2 GB of memory and 256 MB in a file")
      ->excludes("--sweep");
  run->add_flag("--quiet", arguments->quiet, "print errors only");
  run->add_option_function<std::string>(
         "--engine",
         [arguments](const std::string& word) {
           if (word != "petsc")
             throw CLI::ValidationError("--engine", "is \"" + word + "\"; expected petsc");
           arguments->engine = word;
         },
         "what solves the equations of steps, under mpirun on all its processes: PETSc, where "
         "courant was built with it; without the option this process does")
      ->type_name("petsc")
      ->excludes("--sweep")
      ->excludes("--untrusted");
  run->add_option("ENGINE_OPTION", arguments->engine_options,
                  "behind --, options of the engine, as in -- -ksp_type gmres -pc_type asm");
  run->callback([&session, arguments] {
    session.action = [arguments](const Console& console) -> int {
      if (!arguments->engine.empty()) return run_by_engine(console, *arguments);
      if (!arguments->engine_options.empty()) {
        print_error(console,
                    "\"" + arguments->engine_options.front() +
                        "\" is not expected behind FILE without --engine; see `courant run "
                        "--help`");
        return wrong;
      }
      if (!arguments->sweep.ranges.empty()) return run_cases(console, *arguments);
      if (arguments->untrusted) {
        if (arguments->backend == Backend::Kind::native) {
          print_error(console, "--untrusted runs no C compiler; expected no --backend native");
          return wrong;
        }
        arguments->backend = Backend::Kind::interpreter;
        Confinement::begin(console.heeds_stop);
      }
      return run_file(console, *arguments);
    };
  });
}

}  // namespace courant::cli
