// What `courant run` prints.
#pragma once

#include <filesystem>
#include <string>

#include "courant/cli/command.hpp"
#include "courant/cli/text.hpp"
#include "courant/integrators/step/integrator.hpp"
#include "courant/running/ensemble_run.hpp"
#include "courant/running/runner.hpp"

namespace courant::cli {

// What is run, and what the constraint algorithm found.
void print_opening(const Console& console, const Experiment& experiment,
                   const LadderReport& ladder);

// How a value moved, with as many digits as show it.
std::string from_and_to(const Movement& move);

// Where a run goes on.
void print_resumption(const Console& console, long k, double t);

// The equations that a step solves, which unknowns they give explicitly, and which are left.
void print_explanation(const Console& console, const Integrator& method);

// How it went: paths in the plane, observables, solver, expectations, where the files are.
void print_outcome(const Console& console, const Experiment& experiment, const RunOutcome& outcome,
                   const std::filesystem::path& folder);

// How the members are spread at the end, expectations, where the files are.
void print_ensemble(const Console& console, const EnsembleOutcome& outcome,
                    const std::filesystem::path& folder);

}  // namespace courant::cli
