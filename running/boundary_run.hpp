// Runs that begin where conditions at both ends ask for.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "courant/reading/experiment.hpp"

namespace courant {

// Solves the boundary problem of an experiment that has one, by its method, from its initial values and its time as a
// guess; what is not given of these is 0. With a continuation, experiments are read with the values of the parameter on
// the way. The result is the experiment that begins at the solution and takes as long, with the solution, or with the
// end of the search where that is unsolved: its run says so and fails.
//
// Throws ExperimentError at /boundary where there are more conditions than unknowns, or the method knows no
// differential; as consistent_start does.
std::shared_ptr<const Experiment> with_boundary_solved(const Experiment& experiment,
                                                       const std::atomic<bool>* stop = nullptr);

bool is_unsolved(const Experiment& experiment);

// The points from which its run goes on after these steps, where round-off at its start keeps it from the end.
std::map<long, VectorXd> nodes_of_run(const Experiment& experiment);

// What summary.json has of it: verdict, duration, residuals, rank, conjugate times, multipliers.
Json boundary_summary(const BoundarySolution& solution);
// The same as sentences.
std::vector<std::string> boundary_in_words(const BoundarySolution& solution);

}  // namespace courant
