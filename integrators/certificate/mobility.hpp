// Mobility: which unknowns a search for a zero moves, and at what cost.
#pragma once

#include <functional>

#include "courant/core/linear/equilibration.hpp"

namespace courant {

// A search for a zero of F may have many to choose from. It goes to the one that it reaches at the least cost.
struct Mobility {
  // What it costs to move each unknown by one of its natural units. Of all steps δ that do as well, the search makes
  // the one with the least ‖cost ∘ δ‖.
  VectorXd cost;
  // So many leading unknowns do not move at all.
  Index frozen = 0;
  // Sizes of the unknowns. A change of y_j that is round-off next to its size is round-off in F. May be 0.
  VectorXd nominal = VectorXd();
  // F adds leading unknowns, those of a chart, to something as large as this: the coordinates of its origin.
  VectorXd offset = VectorXd();
  // What is left of an unknown below so many of its natural units is noise.
  double noise = 1e-11;
  // The sizes of the derivatives at points around the start (generic_magnitude); empty: the search finds them.
  SparseMatrixXd magnitude = SparseMatrixXd();
  // Whether derivatives grow as those of exp (v/25 mV) do. Their sizes are then taken at each point, not around it, and
  // steps are so short that derivatives keep their size. The latter is for up to 200 unknowns.
  bool has_exponentials = false;
  // Whether the search may go to y, as the domain of a chart allows. Empty: it may go anywhere.
  std::function<bool(const VectorXd& y)> admits = {};
};

}  // namespace courant
