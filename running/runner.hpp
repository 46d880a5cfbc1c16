// Running an experiment.
#pragma once

#include "courant/reading/experiment.hpp"
#include "courant/running/run_keeper.hpp"
#include "courant/running/run_underway.hpp"

namespace courant {

// Starts at a consistent point, makes the method, steps, and writes trajectory, summary and
// experiment to the folder (the contract has the files). What the numerics cannot do is an outcome;
// everything up to then is on disk.
//
// Every `epoch` steps method and observer forget the steps before, and the folder gets a checkpoint.
// A run that goes on does so from the last of them, and leaves the files that it would have left if
// it had never been stopped: the trajectory to the last byte, the summary but for times. Only
// options.watchers are told no more of the steps before.
//
// The same where a keeper in the place of a folder keeps the run, in memory say; of options those that are about
// folders are not looked at.
//
// Throws ExperimentError for initial values that cannot be used, for a method that solves nothing which an engine
// could take, and for changes of an experiment
// whose run is to go on; UnusableFolder for a folder that cannot be used: then nothing was written.
// Throws OutputError when the disk is full later on.
RunOutcome run(const Experiment& experiment, const RunOptions& options);
RunOutcome run(const Experiment& experiment, RunKeeper& keeper, const RunOptions& options = {});

}  // namespace courant
