#include "courant/running/unfinished_run.hpp"

#include <system_error>

#include "courant/core/words/message.hpp"
#include "courant/running/experiment_changes.hpp"
#include "courant/running/run_files.hpp"
#include "courant/running/trajectory_writer.hpp"

namespace courant {
namespace {

namespace fs = std::filesystem;

// Whether a run ends after so many steps, at a time that is asked in transformed time alone.
bool is_over(const TimeSpan& time, long steps, double t) {
  return time.is_transformed() ? t >= time.until : steps >= time.steps;
}

void check_unfinished(const fs::path& folder, const std::string& id, const Experiment& experiment) {
  const fs::path file = folder / "summary.json";
  if (!file_exists(file)) return;  // killed before there was one
  const RunSummary summary = read_summary(file);
  if (!summary.id.empty() && summary.id != id)
    refuse_folder(file, "is of another run than experiment.json");
  if (summary.status != RunStatus::completed && summary.status != RunStatus::not_finite) return;
  if (!experiment.time) refuse_folder(folder, "the run is complete");
  const TimeSpan& time = *experiment.time;
  const double reached =
      time.is_transformed() && summary.time ? summary.time->end : time.time(summary.steps);
  if (is_over(time, summary.steps, reached))
    refuse_folder(folder, "the run is complete up to t = " + exact_text(reached) +
                              "; expected a later /time/end to go on to");
}

void check_size(const fs::path& file, std::uintmax_t expected) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) refuse_folder(file, "cannot be read: " + error.message());
  if (size < expected)
    refuse_folder(file, "has " + std::to_string(size) + " bytes, expected at least the " +
                            std::to_string(expected) + " that the run wrote");
}

void check_checkpoint(const fs::path& folder, const std::string& id, const Experiment& experiment,
                      const Checkpoint& checkpoint) {
  if (checkpoint.run != id)
    refuse_folder(folder / "checkpoint.json", "is of another run than experiment.json");
  const TimeSpan& time = *experiment.time;
  const double reached = time.is_transformed() ? checkpoint.state.t : time.time(checkpoint.k);
  if (is_over(time, checkpoint.k, reached))
    throw ExperimentError("/time/end", "is " + exact_text(time.end()) +
                                           "; the run would go on from t = " + exact_text(reached) +
                                           ", expected a later one");
  check_size(folder / trajectory_name(experiment.output.format), checkpoint.trajectory_size);
  if (checkpoint.event_watch) check_size(folder / "events.csv", checkpoint.event_watch->file_size);
}

}  // namespace

void refuse_folder(const fs::path& path, const std::string& what) {
  throw UnusableFolder(path.string() + ": " + what);
}

bool file_exists(const fs::path& file) {
  std::error_code error;
  return fs::exists(file, error);
}

UnfinishedRun unfinished_run(const fs::path& folder, const Experiment& experiment) {
  const fs::path begun_with = folder / "experiment.json", file = folder / "checkpoint.json";
  try {
    const Json begun = file_exists(begun_with) ? read_json(begun_with) : Json();
    const Json id = begun.is_object() ? begun.value("$run", Json()) : Json();
    if (!id.is_string()) refuse_folder(folder, "there is no run in this folder that could go on");
    UnfinishedRun run{.id = id.get<std::string>(), .checkpoint = {}};
    if (auto changes = experiment_changes(begun, experiment.document); !changes.empty())
      throw ExperimentError(std::move(changes));
    check_unfinished(folder, run.id, experiment);
    if (experiment.time && file_exists(file)) {
      run.checkpoint = read_checkpoint(file);
      check_checkpoint(folder, run.id, experiment, *run.checkpoint);
    }
    return run;
  } catch (const RunFileError& error) {
    throw UnusableFolder(error.what());
  }
}

}  // namespace courant
