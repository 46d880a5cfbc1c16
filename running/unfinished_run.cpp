#include "courant/running/unfinished_run.hpp"

#include <system_error>

#include "courant/core/files/own_file.hpp"
#include "courant/core/words/message.hpp"
#include "courant/running/damage_of_lines.hpp"
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
  if (!summary.stopped_by.empty())
    refuse_folder(folder, "the run is complete: the event " + summary.stopped_by + " ended it");
  const TimeSpan& time = *experiment.time;
  const double reached =
      time.is_transformed() && summary.time ? summary.time->end : time.time(summary.steps);
  if (is_over(time, summary.steps, reached))
    refuse_folder(folder, "the run is complete up to t = " + exact_text(reached) +
                              "; expected a later /time/end to go on to");
}

// Refuses a file with `damage`.
void require_whole(const fs::path& file, const std::optional<std::string>& damage) {
  if (!file_exists(file)) refuse_folder(file, "is not there; expected the file that the run wrote");
  if (fs::is_symlink(file)) refuse_folder(file, "is a link; expected the file that the run wrote");
  if (damage) refuse_folder(file, *damage + "; expected it whole, or --force to begin anew");
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
  const Output::Format format = experiment.output.format;
  require_whole(folder / trajectory_name(format), damage(format, folder, checkpoint.trajectory));
  if (const auto& events = checkpoint.event_watch)
    require_whole(folder / "events.csv", damage_of_lines(folder / "events.csv", events->file));
}

}  // namespace

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
