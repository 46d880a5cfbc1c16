#include "courant/running/runner.hpp"

#include "courant/running/boundary_run.hpp"
#include "courant/running/chosen_step.hpp"
#include "courant/running/folder_keeper.hpp"
#include "courant/running/run_backend.hpp"

namespace courant {

RunOutcome run(const Experiment& experiment, RunKeeper& keeper, const RunOptions& options) {
  if (experiment.ensemble)
    throw ExperimentError("/ensemble",
                          "makes many runs, and one is asked for; expected run_ensemble in C++, "
                          "courant.ensemble in Python, or no \"ensemble\"");
  if (experiment.time && !experiment.time->is_chosen) {
    const ChosenStep chosen = chosen_step(
        experiment, worthwhile(options.backend, experiment, options.alike), options.stop);
    return run(*with_chosen_step(experiment, chosen), keeper, options);
  }
  if (experiment.boundary && !experiment.solution)
    return run(*with_boundary_solved(experiment, options.stop), keeper, options);
  return carry_out(experiment, keeper, options);
}

RunOutcome run(const Experiment& experiment, const RunOptions& options) {
  FolderKeeper folder(options.folder, options.existing, options.checkpoint_interval);
  return run(experiment, folder, options);
}

}  // namespace courant
