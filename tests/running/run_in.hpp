// A run of an experiment in a folder of the test.
#pragma once

#include "../core/files/temporary_folder.hpp"
#include "courant/running/runner.hpp"

namespace courant {

// In folder/run, by the interpreter.
inline RunOutcome run_in(const TemporaryFolder& folder, const Json& experiment,
                         RunOptions options = {}) {
  options.folder = folder / "run";
  options.backend = Backend::interpreter;
  return run(read_experiment(experiment.dump()), options);
}

// What is wrong with the experiment, as its run tells; empty if nothing is.
inline std::string problem_of_run(const Json& experiment) {
  try {
    const TemporaryFolder folder;
    run_in(folder, experiment);
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "";
}

// The last value of a coordinate.
inline double final_value(const RunOutcome& outcome, std::string_view name) {
  for (const auto& [coordinate, value] : outcome.summary.final)
    if (coordinate == name) return value;
  return RunSummary::kUnknown;
}

}  // namespace courant
