// The declared symmetries of an experiment, measured.
#pragma once

#include <string>
#include <vector>

#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/reading/experiment.hpp"

namespace courant {

// A symmetry as it was found to be, and what follows for its momentum.
struct SymmetryFinding {
  std::string name;
  SymmetryReport report;

  // Why the momentum is not expected to be conserved: a sentence; empty where it is.
  std::string why_not_conserved() const;
};

// Measures all symmetries at the consistent start and near it; nothing of an inconsistent system.
// Throws ExperimentError for the first that is none, with its place and by how much it fails.
std::vector<SymmetryFinding> check_symmetries(const Experiment& experiment,
                                              const ConstraintLadder& ladder);

}  // namespace courant
